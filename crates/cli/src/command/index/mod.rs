//! `heliostat index`: how trees divide a scene, whether they find what brute force finds, and what they cost.

mod replay;
mod replay_file;
#[cfg(test)]
mod test_scene;
mod trees;
mod verify;

use crate::args::value::{Boxes, Tree};
use crate::args::{IndexArgs, Preset};
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::output::{beside_cwd, check_writable};
use crate::table::{self, Table};
use crate::{open, out, progress};
use clap::ValueEnum;
use heliostat_index::{BuildParams, ExportWhat, TreeStats, export_obj};
use heliostat_io::atomic::write_atomically;
use heliostat_scene::Scene;
use replay_file::Found;
use serde_json::{Value, json};
use std::path::Path;
use trees::SceneTree;
use verify::Judged;

/// Shows statistics; exports, verifies and draws what was asked for.
pub(crate) fn run(args: &IndexArgs) -> Result<Exit, Failure> {
    for path in args.export.iter().chain(&args.heatmap).chain(&args.disagreements) {
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
        saved(path, args);
    }
    let mut agrees = true;
    if let Some(rays) = args.verify {
        agrees &= verify(&shot.scene, &presets, rays, args, &mut json)?;
    }
    if let Some(path) = &args.replay {
        // An index that was wrong is among all of them, whichever were verified.
        let presets = args.preset.map_or(Preset::value_variants().to_vec(), |preset| vec![preset]);
        let judged = replay::run(&shot.scene, &presets, path)?;
        agrees &= judged.agrees;
        report(judged, args, &mut json["replay"]);
    }
    if args.json {
        out::line(format_args!("{json:#}"));
    }
    Ok(if agrees { Exit::Done } else { Exit::Failed })
}

/// Whether all agree; where they do not, the rays are saved.
fn verify(
    scene: &Scene,
    presets: &[Preset],
    rays: u32,
    args: &IndexArgs,
    json: &mut Value,
) -> Result<bool, Failure> {
    let (judged, found) = verify::run(scene, presets, rays)?;
    report(judged, args, &mut json["verify"]);
    save_disagreements(scene, &found, args, json)?;
    Ok(found.is_empty())
}

/// Writes the file for `--replay`, where there is anything to replay.
fn save_disagreements(
    scene: &Scene,
    found: &[Found],
    args: &IndexArgs,
    json: &mut Value,
) -> Result<(), Failure> {
    if found.is_empty() {
        return Ok(());
    }
    let by_default = beside_cwd(&args.scene, "disagreements.jsonl");
    let path = args.disagreements.as_ref().unwrap_or(&by_default);
    replay_file::save(path, scene, found, verify::SEED)?;
    json["disagreements"] = json!(path.to_string_lossy());
    saved(path, args);
    Ok(())
}

/// Shows what came of a comparison, or keeps it for the JSON at the end.
fn report(judged: Judged, args: &IndexArgs, json: &mut Value) {
    if !args.json {
        out::line(format_args!("{}", judged.text.trim_end()));
    }
    *json = judged.json;
}

/// Tells of a file; standard output stays JSON where that was asked for.
fn saved(path: &Path, args: &IndexArgs) {
    let line = format!("Saved: '{}'", progress::clean(&path.to_string_lossy()));
    if args.json { out::note(format_args!("{line}")) } else { out::line(format_args!("{line}")) }
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
    saved(path, args);
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
            progress::bytes(stats.bytes as u64),
            format!("{:.2} s", stats.build_seconds),
        ]);
    }
    table.to_string()
}
