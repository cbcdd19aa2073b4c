//! White furnaces: where nothing absorbs, light from all around comes back whole.

use super::*;
use std::fmt::Write;

/// Samples of a sum over draws.
const DRAWS: u32 = 1 << 16;

/// The sum of the weights of draws, over their number.
fn by_draws(bsdf: &StandardBsdf, wo: Vec3, count: u32) -> Rgb {
    let weights = lattice(count).filter_map(|u| bsdf.sample(wo, u));
    weights.map(|sample| sample.weight.as_dvec3()).sum::<glam::DVec3>().as_vec3() / count as f32
}

/// The largest excess and the largest lack over viewers and channels.
fn worst(bsdf: &StandardBsdf, count: u32) -> (f32, f32) {
    let (mut above, mut below) = (0.0_f32, 0.0_f32);
    for cos in COSINES {
        let error = by_draws(bsdf, viewer(cos), count) - Rgb::ONE;
        above = above.max(error.max_element());
        below = below.min(error.min_element());
    }
    (above, below)
}

#[test]
fn bsdf_furnace_table() {
    let mut report = String::new();
    for (name, change) in LOSSLESS {
        let _ = write!(report, "{name:26}");
        for roughness in ROUGHNESS {
            let (above, below) = worst(&outside(&rough(*change, roughness)), DRAWS);
            let error = if above > -below { above } else { below };
            let _ = write!(report, " {:7.2}", 1e3 * error);
        }
        report.push('\n');
    }
    println!("{report}");
}
