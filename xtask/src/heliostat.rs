//! The release build of the renderer, as the gallery and the benchmarks call it.

use crate::process::{capture, cargo, root, run};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The renderer's binary.
pub(crate) struct Heliostat(PathBuf);

impl Heliostat {
    /// Builds the release binary and finds it.
    pub(crate) fn build() -> Result<Self, String> {
        run(cargo(&["build", "--release", "--package", "heliostat"]))?;
        let text = capture(cargo(&["metadata", "--no-deps", "--format-version", "1"]))?;
        let metadata: Value = serde_json::from_str(&text).map_err(|e| format!("cargo metadata: {e}"))?;
        let target = metadata["target_directory"].as_str().ok_or("cargo metadata names no target folder")?;
        let name = format!("heliostat{}", std::env::consts::EXE_SUFFIX);
        Ok(Self(Path::new(target).join("release").join(name)))
    }

    /// The command with arguments, run from the workspace root.
    pub(crate) fn command(&self, args: &[&str]) -> Command {
        crate::process::command(&self.0.to_string_lossy(), args)
    }

    /// What `info --json` says of a file.
    pub(crate) fn info(&self, file: &str) -> Result<Value, String> {
        let text = capture(self.command(&["info", "--json", file]))?;
        serde_json::from_str(&text).map_err(|e| format!("info {file}: {e}"))
    }
}

/// Scene files in a folder below the root, sorted, as paths relative to the root.
pub(crate) fn scenes(folder: &str) -> Result<Vec<String>, String> {
    let entries = std::fs::read_dir(root().join(folder)).map_err(|e| format!("{folder}: {e}"))?;
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| name.ends_with(".toml"))
        .map(|name| format!("{folder}/{name}"))
        .collect();
    names.sort();
    Ok(names)
}

/// The name of a scene: its file name without the ending.
pub(crate) fn stem(scene: &str) -> &str {
    Path::new(scene).file_stem().and_then(|s| s.to_str()).unwrap_or(scene)
}
