//! The import graph: each package may depend on the packages that ARCHITECTURE.md lists, and on no others.

use crate::process::{capture, cargo};
use serde_json::Value;

/// A package, the workspace packages that it may import, and the outside packages that it may import.
struct Allowed {
    package: &'static str,
    inside: &'static [&'static str],
    outside: &'static [&'static str],
}

const GEOMETRY: &str = "heliostat-geometry";
const INDEX: &str = "heliostat-index";
const SCENE: &str = "heliostat-scene";
const RENDER: &str = "heliostat-render";
const IO: &str = "heliostat-io";
const OIDN: &str = "heliostat-oidn";

/// The graph. What is not listed here is forbidden.
const GRAPH: &[Allowed] = &[
    Allowed { package: GEOMETRY, inside: &[], outside: &["glam", "proptest"] },
    Allowed { package: INDEX, inside: &[GEOMETRY], outside: &["glam", "obvhs", "rayon"] },
    Allowed { package: SCENE, inside: &[GEOMETRY], outside: &["glam", "half"] },
    Allowed {
        package: RENDER,
        inside: &[GEOMETRY, INDEX, SCENE],
        outside: &["glam", "pulp", "rayon", "sobol_burley", "thiserror"],
    },
    Allowed {
        package: IO,
        inside: &[GEOMETRY, SCENE],
        outside: &[
            "bevy_mikktspace",
            "draco-core",
            "earcut",
            "exr",
            "gltf",
            "glam",
            "half",
            "image",
            "miniz_oxide",
            "png",
            "schemars",
            "serde",
            "serde_json",
            "strsim",
            "tempfile",
            "thiserror",
            "tobj",
            "toml",
        ],
    },
    Allowed { package: OIDN, inside: &[], outside: &["libloading", "thiserror"] },
    Allowed {
        package: "heliostat",
        inside: &[GEOMETRY, INDEX, SCENE, RENDER, IO, OIDN],
        outside: &[
            "clap",
            "clap_complete",
            "clap_mangen",
            "glam",
            "indicatif",
            "miette",
            "rayon",
            "serde",
            "serde_json",
            "signal-hook",
            "tempfile",
        ],
    },
    Allowed {
        package: "xtask",
        inside: &[],
        outside: &["clap", "delaunator", "font8x8", "glam", "image", "serde_json"],
    },
    Allowed {
        package: "xtask-bench",
        inside: &[GEOMETRY, INDEX, IO],
        outside: &["clap", "glam", "cpu-time", "libloading", "obvhs", "rayon", "serde_json"],
    },
    Allowed {
        package: "heliostat-tests",
        inside: &[GEOMETRY, INDEX, SCENE, RENDER, IO],
        outside: &["glam", "tempfile"],
    },
];

/// One line per dependency that the graph does not list.
pub(super) fn check() -> Result<Vec<String>, String> {
    let text = capture(cargo(&["metadata", "--no-deps", "--format-version", "1"]))?;
    let metadata: Value = serde_json::from_str(&text).map_err(|e| format!("cargo metadata: {e}"))?;
    let packages = metadata["packages"].as_array().ok_or("cargo metadata lists no packages")?;
    Ok(packages.iter().flat_map(check_package).collect())
}

fn check_package(package: &Value) -> Vec<String> {
    let name = package["name"].as_str().unwrap_or_default();
    let Some(allowed) = GRAPH.iter().find(|a| a.package == name) else {
        return vec![format!("{name}: not in the import graph of xtask/src/tidy/imports.rs")];
    };
    let dependencies = package["dependencies"].as_array().map_or(&[][..], Vec::as_slice);
    dependencies
        .iter()
        // Tests may look further; the graph is about what ships.
        .filter(|d| d["kind"].is_null())
        .filter_map(|d| d["name"].as_str())
        .filter(|d| !allowed.inside.contains(d) && !allowed.outside.contains(d))
        .map(|d| format!("{name}: may not import {d} (see the table in ARCHITECTURE.md)"))
        .collect()
}
