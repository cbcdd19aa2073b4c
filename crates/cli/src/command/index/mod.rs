//! `heliostat index`: how trees divide a scene, whether they find what brute force finds, and what they cost.

mod trees;
mod verify;

use crate::args::value::{Boxes, Tree};
use crate::args::{IndexArgs, Preset};
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::output::check_writable;
use crate::table::{self, Table};
use crate::{open, out};
use heliostat_index::{BuildParams, ExportWhat, TreeStats, export_obj};
use heliostat_io::atomic::write_atomically;
use heliostat_scene::Scene;
use serde_json::{Value, json};
use std::path::Path;
use trees::SceneTree;

/// Shows statistics; exports, verifies and draws what was asked for.
pub(crate) fn run(args: &IndexArgs) -> Result<Exit, Failure> {
    for path in args.export.iter().chain(&args.heatmap) {
        check_writable(path)?;
    }
    let shot = open::first_shot(&args.scene)?;
    let presets = args.preset.map_or(vec![Preset::Midpoint, Preset::Balanced], |preset| vec![preset]);
    let built: Vec<_> = presets
        .iter()
        .map(|&preset| Ok((preset, trees::build(&shot.scene, &params(preset))?)))
        .collect::<Result<_, Failure>>()?;

    let mut json = json!({ "path": args.scene.to_string_lossy(), "trees": statistics_json(&built) });
    if !args.json {
        out::line(format_args!("{}", statistics_text(&built).trim_end()));
    }
    if let Some(path) = &args.export {
        // The tree that renders use, where no preset was asked for.
        let (_, trees) = &built[built.len() - 1];
        export(&shot.scene, trees, args, path)?;
    }
    if let Some(path) = &args.heatmap {
        super::render::heatmap(&shot, path)?;
    }
    let mut exit = Exit::Done;
    if let Some(rays) = args.verify {
        let verified = verify::run(&shot.scene, &presets, rays)?;
        if !args.json {
            out::line(format_args!("{}", verified.text.trim_end()));
        }
        json["verify"] = verified.json;
        exit = if verified.agrees { Exit::Done } else { Exit::Failed };
    }
    if args.json {
        out::line(format_args!("{json:#}"));
    }
    Ok(exit)
}

/// The build that a preset stands for.
fn params(preset: Preset) -> BuildParams {
    match preset {
        Preset::Midpoint => BuildParams::MIDPOINT,
        Preset::Fast => BuildParams::FAST,
        Preset::Balanced => BuildParams::BALANCED,
        Preset::Best => BuildParams::BEST,
    }
}

fn name(preset: Preset) -> &'static str {
    match preset {
        Preset::Midpoint => "midpoint",
        Preset::Fast => "fast",
        Preset::Balanced => "balanced",
        Preset::Best => "best",
    }
}

fn export(scene: &Scene, trees: &[SceneTree], args: &IndexArgs, path: &Path) -> Result<(), Failure> {
    let wanted = args.tree.unwrap_or(if scene.meshes.len() == 1 { Tree::Mesh(0) } else { Tree::Objects });
    let Some(tree) = trees.iter().find(|t| t.which == wanted) else {
        let (meshes, groups) = (scene.meshes.len(), scene.groups.len());
        return Err(Failure::usage(format!(
            "the scene has no such tree; write `--tree objects`, the number of one of its {meshes} meshes, from 0, or \
             `group=` or `copies=` and the number of one of its {groups} groups"
        )));
    };
    let what = match args.what {
        Boxes::Leaves => ExportWhat::Leaves,
        Boxes::All => ExportWhat::All,
        Boxes::Depth(depth) => ExportWhat::Depth(depth),
    };
    write_atomically(path, |mut out| export_obj(tree.tree(), what, &mut out))?;
    out::line(format_args!("Saved: '{}'", path.display()));
    Ok(())
}

fn statistics_json(built: &[(Preset, Vec<SceneTree>)]) -> Vec<Value> {
    let each = |preset: Preset, tree: &SceneTree| {
        let mut entry = stats_json(&tree.stats());
        entry["tree"] = json!(tree.name);
        entry["preset"] = json!(name(preset));
        entry
    };
    built.iter().flat_map(|(preset, trees)| trees.iter().map(move |t| each(*preset, t))).collect()
}

/// The figures of a tree under their names in `--json` and `--stats`.
pub(crate) fn stats_json(stats: &TreeStats) -> Value {
    json!({
        "primitives": stats.primitives,
        "unbounded": stats.unbounded,
        "nodes": stats.nodes,
        "wide_nodes": stats.wide_nodes,
        "leaves": stats.leaves,
        "empty_leaves": stats.empty_leaves,
        "largest_leaf": stats.largest_leaf,
        "depth": stats.depth,
        "references": stats.references,
        "references_per_primitive": stats.references_per_primitive,
        "sah_cost": stats.sah_cost,
        "bytes": stats.bytes,
        "build_seconds": stats.build_seconds,
    })
}

fn statistics_text(built: &[(Preset, Vec<SceneTree>)]) -> String {
    let mut table = Table::new([
        "tree",
        "preset",
        "primitives",
        "nodes",
        "leaves",
        "empty",
        "depth",
        "refs/prim",
        "SAH cost",
        "memory",
        "build",
    ]);
    let rows = built.iter().flat_map(|(preset, trees)| trees.iter().map(move |t| (*preset, t)));
    for (preset, tree) in rows {
        let stats = tree.stats();
        table.row([
            tree.name.clone(),
            name(preset).to_owned(),
            table::count(stats.primitives),
            table::count(stats.nodes),
            table::count(stats.leaves),
            table::count(stats.empty_leaves),
            stats.depth.to_string(),
            format!("{:.2}", stats.references_per_primitive),
            format!("{:.1}", stats.sah_cost),
            crate::progress::bytes(stats.bytes as u64),
            format!("{:.2} s", stats.build_seconds),
        ]);
    }
    table.to_string()
}
