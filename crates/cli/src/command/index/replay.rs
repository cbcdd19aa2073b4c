//! The rays of a file, traced once more through every index and brute force.

use super::replay_file::{self, Saved};
use super::verify::{Judged, difference};
use super::{name, params, trees};
use crate::args::Preset;
use crate::diagnose::Failure;
use crate::progress;
use heliostat_index::verify::{Agreement, Verifier};
use heliostat_scene::Scene;
use rayon::prelude::{IntoParallelIterator, ParallelExtend, ParallelIterator};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

/// Traces the rays of the file at `path`, in the order of its lines.
pub(super) fn run(scene: &Scene, presets: &[Preset], path: &Path) -> Result<Judged, Failure> {
    let rays = replay_file::read(path, scene)?;
    let settings: Vec<_> = presets.iter().map(|&preset| (name(preset), params(preset))).collect();
    let mut again: Vec<(&Saved, Agreement)> = Vec::with_capacity(rays.len());
    for (number, mesh) in scene.meshes.iter().enumerate() {
        let of_mesh: Vec<&Saved> = rays.iter().filter(|saved| saved.mesh == number).collect();
        if of_mesh.is_empty() {
            continue;
        }
        let verifier = Verifier::new(mesh, &settings)
            .map_err(|e| trees::failure(&trees::mesh_name(scene, number), &e))?;
        let trace = |saved: &Saved| verifier.replay(saved.number, saved.ray);
        again.par_extend(of_mesh.into_par_iter().map(|saved| (saved, trace(saved))));
    }
    again.sort_by_key(|(saved, _)| saved.line);
    let file = progress::clean(&path.to_string_lossy());
    Ok(report(&again, &file, |mesh| trees::mesh_name(scene, mesh)))
}

/// One line for each ray, and the sum.
fn report(again: &[(&Saved, Agreement)], file: &str, mesh_name: impl Fn(usize) -> String) -> Judged {
    let mut text = String::new();
    let mut rays = Vec::new();
    for (saved, agreement) in again {
        let Saved { line, mesh, number, index, .. } = saved;
        let what = outcome(agreement);
        // Writing into a `String` cannot fail.
        let _ = writeln!(
            text,
            "replay: {file}:{line}: {}, ray {number}, saved for {index}: {what}",
            mesh_name(*mesh)
        );
        rays.push(entry(saved, agreement));
    }
    let differ = again.iter().filter(|(_, agreement)| !agreement.disagreements.is_empty()).count();
    let all = again.len();
    let _ = match differ {
        0 => writeln!(text, "replay: {all} rays, all agree with brute force"),
        _ => writeln!(text, "replay: {all} rays, {differ} STILL DIFFER from brute force"),
    };
    Judged { agrees: differ == 0, text, json: json!(rays) }
}

/// What came of one ray.
fn outcome(agreement: &Agreement) -> String {
    if agreement.disagreements.is_empty() {
        let what = if agreement.hits > 0 { "hit" } else { "no hit" };
        return format!("{what}, all agree with brute force");
    }
    let each: Vec<String> = agreement.disagreements.iter().map(difference).collect();
    format!("DIFFERS: {}", each.join("; "))
}

fn entry(saved: &Saved, agreement: &Agreement) -> Value {
    let differ: Vec<&str> = agreement.disagreements.iter().map(|wrong| wrong.index.as_str()).collect();
    json!({
        "line": saved.line,
        "mesh": saved.mesh,
        "number": saved.number,
        "saved_for": saved.index,
        "hit": agreement.hits > 0,
        "agrees": differ.is_empty(),
        "differ": differ,
    })
}

#[cfg(test)]
mod tests;
