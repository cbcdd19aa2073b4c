//! White furnaces: where nothing absorbs, light from all around comes back whole.

use super::*;
use crate::bsdf::standard::view::{View, WAYS};

/// Nodes of the integral over the draws of each way, along either number.
const NODES: usize = 128;

/// The light that a furnace sends to a viewer: the integral over all draws of their weights, way by way.
fn furnace(bsdf: &StandardBsdf, wo: Vec3) -> Rgb {
    let view = View::new(bsdf, wo);
    let mut sum = glam::DVec3::ZERO;
    for way in WAYS.into_iter().filter(|way| view.share(*way) > 0.0) {
        for k in 0..NODES * NODES {
            // One of three rays where light is dispersed.
            let rest = ((k % 3) as f32 + 0.5) / 3.0;
            let (x, y) = (k / NODES, k % NODES);
            let ((x, across), (y, along)) = (crowded(x), crowded(y));
            let at = Vec2::new(x, y);
            if let Some(sample) = view.draw(way, rest, at) {
                sum += across * along * f64::from(view.share(way)) * sample.weight.as_dvec3();
            }
        }
    }
    (sum / (NODES * NODES) as f64).as_vec3()
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

/// How much of the light a lobe may lose, and make, in thousandths: what is known of it, a little rounded.
///
/// The goal is 1, and these are figures, not proof of it; at roughness 0.05 some are worse at grazing angles. What does not
/// reach it is told of by approximation: tables that are linear between their nodes, matte facets under a boundary, drawn-out
/// highlights of glass, films over rough glass, and layers between two rough ones.
fn bound(name: &str) -> (f32, f32) {
    match name {
        "metal" | "plastic, ior 0" | "thin glass" => (11.0, 2.0),
        "metal, anisotropic" => (8.0, 8.0),
        "plastic, rough matte" | "coat over rough matte" => (21.0, 7.0),
        "plastic, anisotropic" => (20.0, 4.0),
        "glass, anisotropic" => (125.0, 10.0),
        "glass, film" => (7.0, 29.0),
        "glass, ior 0.7" => (11.0, 11.0),
        "coat over plastic" | "coat over sheen" => (17.0, 2.5),
        "sheen over metal" => (2.0, 6.0),
        "coat over glass" | "all layers" => (6.0, 5.0),
        _ => (4.0, 4.5),
    }
}

#[test]
fn bsdf_furnace_is_white() {
    for (name, change) in LOSSLESS {
        let (less, more) = bound(name);
        for roughness in [0.3, 0.0, 0.1, 1.0, 0.6].into_iter().step_by(fewer(1, 3)) {
            let (above, below) = worst(&outside(&rough(*change, roughness)));
            assert!(1e3 * above < more && -1e3 * below < less, "{name}, {roughness}: {above} and {below}");
        }
    }
}

#[test]
fn bsdf_furnace_is_white_inside() {
    for (name, change) in LOSSLESS.iter().filter(|(name, _)| ["glass", "glass, ior 2.4"].contains(name)) {
        for roughness in [0.3, 0.0, 0.1, 1.0, 0.6].into_iter().step_by(fewer(1, 3)) {
            let point = rough(*change, roughness);
            let (above, below) = worst(&StandardBsdf::new(&point, false, Vec3::Z));
            assert!(above < 0.012 && below > -0.012, "{name}, {roughness}: {above} and {below}");
        }
    }
}
