//! White furnaces: where nothing absorbs, light from all around comes back whole.

use super::*;
use crate::bsdf::standard::view::{View, WAYS};
use std::fmt::Write;

/// Nodes of the integral over the draws of each way, along either number.
const NODES: usize = 160;

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
    for cos in COSINES {
        let error = furnace(bsdf, viewer(cos)) - Rgb::ONE;
        above = above.max(error.max_element());
        below = below.min(error.min_element());
    }
    (above, below)
}

#[test]
fn bsdf_furnace_table() {
    let mut report = String::new();
    let start = std::time::Instant::now();
    crate::bsdf::table::Interface::of(0.5, 1.5).loss_mean();
    println!("interface {:?}", start.elapsed());
    let start = std::time::Instant::now();
    crate::bsdf::table::Reflection::of(None).lost_mean();
    println!("reflection {:?}", start.elapsed());
    for (name, change) in LOSSLESS {
        let _ = write!(report, "{name:26}");
        if std::env::var("ONLY").is_ok_and(|only| !name.contains(&only)) {
            continue;
        }
        for roughness in ROUGHNESS {
            if std::env::var("ONLY").is_ok() {
                let bsdf = outside(&rough(*change, roughness));
                println!(
                    "{name} {roughness}: {:?}",
                    COSINES.map(|c| ((furnace(&bsdf, viewer(c)) - 1.0) * 1e4).round().to_array())
                );
            }
            let (above, below) = worst(&outside(&rough(*change, roughness)));
            let error = if above > -below { above } else { below };
            let _ = write!(report, " {:7.2}", 1e3 * error);
        }
        report.push('\n');
    }
    println!("{report}");
}
