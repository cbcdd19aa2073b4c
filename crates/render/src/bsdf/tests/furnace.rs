//! White furnaces: where nothing absorbs, light from all around comes back whole.

use super::*;
use crate::bsdf::standard::view::{View, WAYS, Way};
use rayon::prelude::*;

/// Nodes of the integral over the draws of each way, along either number.
const NODES: usize = 96;

/// The light that a furnace sends to a viewer: the integral over all draws of their weights, way by way.
fn furnace(bsdf: &StandardBsdf, wo: Vec3) -> Rgb {
    let view = View::new(bsdf, wo);
    let mut sum = glam::DVec3::ZERO;
    for way in WAYS.into_iter().filter(|way| view.share(*way) > 0.0) {
        for k in 0..NODES * NODES {
            let (x, y) = (k / NODES, k % NODES);
            let ((x, across), (y, along)) = (crowded(x), crowded(y));
            let at = Vec2::new(x, y);
            for (rest, share) in rests(&view, way, at) {
                if let Some(sample) = view.draw(way, rest, at) {
                    let area = across * along * f64::from(share * view.share(way));
                    sum += area * sample.weight.as_dvec3();
                }
            }
        }
    }
    (sum / (NODES * NODES) as f64).as_vec3()
}

/// All that the third number decides, with its share: whether facets reflect, or which one of three rays goes through; whether
/// what goes anywhere goes towards the horizon.
fn rests(view: &View<'_>, way: Way, at: Vec2) -> Vec<(f32, f32)> {
    if way != Way::Facets {
        let low = view.low_chance(way);
        return [(0.5 * low, low), (0.5 + 0.5 * low, 1.0 - low)].into_iter().filter(|r| r.1 > 0.0).collect();
    }
    let chance = view.reflect_chance(at);
    let rays = [1.0, 3.0, 5.0].map(|k| (chance + (1.0 - chance) * k / 6.0, (1.0 - chance) / 3.0));
    [(0.5 * chance, chance)].into_iter().chain(rays).filter(|(_, share)| *share > 0.0).collect()
}

/// A node in `(0, 1)` and its weight; nodes crowd at both ends, where directions are grazing.
fn crowded(k: usize) -> (f32, f64) {
    let s = (k as f64 + 0.5) / NODES as f64;
    let place = s * s * s * (10.0 - s * (15.0 - 6.0 * s));
    (place.min(0.999_999_9) as f32, 30.0 * (s * (1.0 - s)).powi(2))
}

/// The largest excess and the largest lack over viewers and channels.
fn worst(bsdf: &StandardBsdf) -> (f32, f32) {
    let (mut above, mut below) = (0.0_f32, 0.0_f32);
    for cos in COSINES.into_iter().step_by(fewer(1, 3)) {
        let error = furnace(bsdf, viewer(cos)) - Rgb::ONE;
        above = above.max(error.max_element());
        below = below.min(error.min_element());
    }
    (above, below)
}

/// The worst of a surface over its roughness: excess, lack, and where.
fn survey(change: Change, is_outside: bool) -> [(f32, f32); 2] {
    let mut worst_of = [(0.0, 0.0); 2];
    for roughness in ROUGHNESS.into_iter().skip(fewer(0, 1)).step_by(fewer(1, 3)) {
        let (above, below) = worst(&StandardBsdf::new(&rough(change, roughness), is_outside, Vec3::Z));
        for (worst, error) in worst_of.iter_mut().zip([above, -below]) {
            if error > worst.0 {
                *worst = (error, roughness);
            }
        }
    }
    worst_of.map(|(error, roughness)| (1e3 * error, roughness))
}

/// Thousandths of the light that a lobe may make, and lose, where it is not 1: what a deep run finds, a little rounded.
///
/// What is more than 1 is known for what it is: films whose colours change faster over the angle than curves tell, highlights
/// drawn out of a nearly smooth surface or under a cover, drawn-out glass whose facets lean askew, and nearly smooth glass from inside, at the most
/// grazing angles.
fn bound(name: &str, is_outside: bool) -> [f32; 2] {
    match (name, is_outside) {
        ("glass, anisotropic", true) => [5.0, 3.9],
        ("glass, anisotropic", false) => [12.0, 3.1],
        ("glass, ior 1.05", true) => [0.8, 1.3],
        ("glass, ior 1.05", false) => [4.4, 4.1],
        ("glass, ior 2.4", true) => [0.8, 4.8],
        ("glass, ior 2.4", false) => [1.6, 14.0],
        ("glass, ior 0.7", true) => [2.7, 4.8],
        ("glass, ior 0.7", false) => [1.0, 1.7],
        ("glass, half", false) => [1.4, 1.8],
        ("glass, half specular", true) => [0.9, 1.4],
        ("glass, half specular", false) => [7.6, 11.5],
        ("glass" | "glass, dispersed" | "glass, film", false) => [4.8, 8.6],
        ("glass, dispersed" | "glass, film", true) => [1.0, 1.0],
        ("plastic, anisotropic", _) => [2.7, 0.9],
        ("plastic, film", _) => [0.9, 1.6],
        ("coat over metal, anisotropic", _) => [9.5, 3.0],
        ("metal" | "plastic, ior 0" | "thin glass" | "sheen over plastic" | "sheen over metal", _) => {
            [1.4, 0.9]
        }
        _ => [0.9, 0.9],
    }
}

#[test]
fn bsdf_furnace_is_white() {
    let cases: Vec<_> = LOSSLESS
        .iter()
        .flat_map(|case| [(case, true), (case, false)])
        .filter(|((name, _), is_outside)| *is_outside || name.starts_with("glass"))
        .collect();
    let failures: Vec<String> = cases
        .par_iter()
        .filter_map(|((name, change), is_outside)| {
            let (found, bound) = (survey(*change, *is_outside), bound(name, *is_outside));
            let is_within = found.iter().zip(bound).all(|((error, _), bound)| *error < bound);
            let [(above, at), (below, there)] = found;
            (!is_within).then(|| format!("{name}, {is_outside}: +{above:.1} at {at}, -{below:.1} at {there}"))
        })
        .collect();
    assert!(failures.is_empty(), "{failures:#?}");
}
