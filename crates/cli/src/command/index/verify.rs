//! Random rays through every tree, an independent bounding volume hierarchy and brute force: all must agree.

use super::replay_file::Found;
use super::{name, params, trees};
use crate::args::Preset;
use crate::diagnose::Failure;
use crate::table;
use heliostat_index::MeshHit;
use heliostat_index::verify::{Agreement, Disagreement, Verifier};
use heliostat_scene::Scene;
use rayon::prelude::{IntoParallelIterator, ParallelIterator};
use serde_json::{Value, json};
use std::fmt::Write;

/// What came of it.
pub(super) struct Judged {
    pub(super) agrees: bool,
    pub(super) text: String,
    pub(super) json: Value,
}

/// Which rays are traced: the same ones in every run.
pub(super) const SEED: u64 = 0;

/// Traces `rays` rays through each mesh of the scene; returns the first disagreements, too.
pub(super) fn run(scene: &Scene, presets: &[Preset], rays: u32) -> Result<(Judged, Vec<Found>), Failure> {
    let settings: Vec<_> = presets.iter().map(|&preset| (name(preset), params(preset))).collect();
    let mut text = String::new();
    let mut meshes = Vec::new();
    let (mut differing, mut found) = (0, Vec::new());
    for (number, mesh) in scene.meshes.iter().enumerate() {
        let mesh_name = trees::mesh_name(scene, number);
        let verifier = Verifier::new(mesh, &settings).map_err(|e| trees::failure(&mesh_name, &e))?;
        let verifier = verifier.judging_every(judge_every(u64::from(rays), mesh.triangles.len() as u64));
        let agreement = trace(&verifier, rays);
        describe(&mesh_name, &agreement, &mut text);
        meshes.push(json!({
            "mesh": mesh_name,
            "rays": agreement.rays,
            "hits": agreement.hits,
            "judged_by_brute_force": agreement.judged,
            "disagreements": agreement.differing,
        }));
        differing += agreement.differing;
        keep(&mut found, number, agreement.disagreements);
    }
    if differing > found.len() as u64 {
        // Writing into a `String` cannot fail.
        let (kept, all) = (table::count(found.len()), table::count(differing as usize));
        let _ = writeln!(text, "verify: the first {kept} of {all} disagreements are kept");
    }
    if scene.meshes.is_empty() {
        text.push_str("verify: the scene has no mesh\n");
    }
    Ok((Judged { agrees: found.is_empty(), text, json: json!(meshes) }, found))
}

/// Adds the disagreements of one more mesh, as many as are kept of all meshes together.
fn keep(found: &mut Vec<Found>, mesh: usize, disagreements: Vec<Disagreement>) {
    let free = Agreement::KEPT.saturating_sub(found.len());
    found.extend(disagreements.into_iter().take(free).map(|wrong| (mesh, wrong)));
}

/// One ray in how many brute force judges, so that it takes about a minute at most; the others are judged where the trees and the
/// bounding volume hierarchy differ.
fn judge_every(rays: u64, triangles: u64) -> u64 {
    const MOST_TESTS: u64 = 4_000_000_000;
    (rays.saturating_mul(triangles) / MOST_TESTS).max(1)
}

/// All rays, spread over the processors; what came of the pieces is joined in their order.
fn trace(verifier: &Verifier<'_>, rays: u32) -> Agreement {
    const PIECE: u32 = 256;
    let pieces = rays.div_ceil(PIECE);
    let piece = |i: u32| u64::from(i * PIECE)..u64::from(rays.min(i.saturating_add(1).saturating_mul(PIECE)));
    let each = (0..pieces).into_par_iter().map(|i| verifier.run(piece(i), SEED));
    each.reduce(Agreement::default, |mut all, more| {
        all.merge(more);
        all
    })
}

fn describe(mesh: &str, agreement: &Agreement, text: &mut String) {
    const SHOWN: usize = 5;
    let rays = table::count(agreement.rays as usize);
    let hits = table::count(agreement.hits as usize);
    let wrong = agreement.differing as usize;
    // Writing into a `String` cannot fail.
    let _ = match wrong {
        0 if agreement.judged == agreement.rays => {
            writeln!(text, "verify: {mesh}: {rays} rays, {hits} hits, all agree with brute force")
        }
        0 => {
            let judged = table::count(agreement.judged as usize);
            writeln!(
                text,
                "verify: {mesh}: {rays} rays, {hits} hits, all agree with each other, and the {judged} that brute force judged with it"
            )
        }
        _ => {
            let wrong = table::count(wrong);
            writeln!(text, "verify: {mesh}: {rays} rays, {hits} hits, {wrong} DISAGREEMENTS with brute force")
        }
    };
    for found in agreement.disagreements.iter().take(SHOWN) {
        let (number, ray) = (found.number, found.ray);
        let _ = writeln!(text, "  ray {number} from {} along {}: {}", ray.origin, ray.dir, difference(found));
    }
    if wrong > SHOWN {
        let _ = writeln!(text, "  and {} more", table::count(wrong - SHOWN));
    }
}

/// What an index says, and what brute force.
pub(super) fn difference(found: &Disagreement) -> String {
    let says = |hit: Option<MeshHit>| match hit {
        Some(MeshHit { triangle, hit }) => {
            format!("triangle {triangle} at {} with weights {:?}", hit.t, hit.barycentric)
        }
        None => "no hit".to_owned(),
    };
    let any = match (found.got_any, found.got.is_some()) {
        (true, false) => " (but its any-hit query a hit)",
        (false, true) => " (but its any-hit query no hit)",
        _ => "",
    };
    format!("{} says {}{any}, brute force {}", found.index, says(found.got), says(found.expected))
}

#[cfg(test)]
mod tests;
