//! Random rays through every tree, an independent bounding volume hierarchy and brute force: all must agree.

use super::{name, params, trees};
use crate::args::Preset;
use crate::diagnose::Failure;
use crate::table;
use heliostat_index::verify::{Agreement, Verifier};
use heliostat_scene::Scene;
use rayon::prelude::{IntoParallelIterator, ParallelIterator};
use serde_json::{Value, json};
use std::fmt::Write;

/// What came of it.
pub(super) struct Verified {
    pub(super) agrees: bool,
    pub(super) text: String,
    pub(super) json: Value,
}

/// Traces `rays` rays through each mesh of the scene.
pub(super) fn run(scene: &Scene, presets: &[Preset], rays: u32) -> Result<Verified, Failure> {
    let settings: Vec<_> = presets.iter().map(|&preset| (name(preset), params(preset))).collect();
    let mut text = String::new();
    let mut meshes = Vec::new();
    let mut agrees = true;
    for (number, mesh) in scene.meshes.iter().enumerate() {
        let mesh_name = trees::mesh_name(scene, number);
        let verifier = Verifier::new(mesh, &settings).map_err(|e| trees::failure(&mesh_name, &e))?;
        let verifier = verifier.judging_every(judge_every(u64::from(rays), mesh.triangles.len() as u64));
        let agreement = trace(&verifier, rays);
        agrees &= agreement.disagreements.is_empty();
        describe(&mesh_name, &agreement, &mut text);
        meshes.push(json!({
            "mesh": mesh_name,
            "rays": agreement.rays,
            "hits": agreement.hits,
            "judged_by_brute_force": agreement.judged,
            "disagreements": agreement.disagreements.len(),
        }));
    }
    if scene.meshes.is_empty() {
        text.push_str("verify: the scene has no mesh\n");
    }
    Ok(Verified { agrees, text, json: json!(meshes) })
}

/// One ray in how many brute force judges, so that it takes about a minute at most; the others are judged where the trees and the
/// bounding volume hierarchy differ.
fn judge_every(rays: u64, triangles: u64) -> u64 {
    const MOST_TESTS: u64 = 4_000_000_000;
    (rays.saturating_mul(triangles) / MOST_TESTS).max(1)
}

/// All rays, spread over the processors; the order of the pieces does not change the sum.
fn trace(verifier: &Verifier<'_>, rays: u32) -> Agreement {
    const PIECE: u32 = 256;
    const SEED: u64 = 0;
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
    let wrong = agreement.disagreements.len();
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
            writeln!(text, "verify: {mesh}: {rays} rays, {hits} hits, {wrong} DISAGREEMENTS with brute force")
        }
    };
    for found in agreement.disagreements.iter().take(SHOWN) {
        let _ = writeln!(
            text,
            "  ray {} from {} along {}: {} says {:?}, brute force {:?}",
            found.number, found.ray.origin, found.ray.dir, found.index, found.got, found.expected
        );
    }
}
