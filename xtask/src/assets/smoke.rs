//! Smoke that rises and curls, as densities on a grid in Mitsuba's volume format.

use super::noise::fractal;
use crate::Outcome;
use glam::DVec3;
use std::path::Path;

/// Cells along x, y and z, and the box that they fill, in metres.
const SIZE: [usize; 3] = [40, 64, 40];
const LOW: DVec3 = DVec3::new(-0.8, 0.0, -0.8);
const HIGH: DVec3 = DVec3::new(0.8, 2.56, 0.8);

/// Writes the grid.
pub(super) fn write(path: &Path) -> Outcome {
    let mut bytes = b"VOL\x03".to_vec();
    let [x, y, z] = SIZE;
    for n in [1, x, y, z, 1] {
        bytes.extend((n as i32).to_le_bytes());
    }
    for v in LOW.to_array().into_iter().chain(HIGH.to_array()) {
        bytes.extend((v as f32).to_le_bytes());
    }
    for k in 0..z {
        for j in 0..y {
            for i in 0..x {
                let share = (DVec3::new(i as f64, j as f64, k as f64) + 0.5)
                    / DVec3::new(x as f64, y as f64, z as f64);
                bytes.extend((density(share) as f32).to_le_bytes());
            }
        }
    }
    std::fs::write(path, bytes).map_err(|e| format!("{}: {e}", path.display()))
}

/// How dense it is at a share of the box: a column that widens and sways as it rises, torn by noise.
fn density(share: DVec3) -> f64 {
    let p = LOW + share * (HIGH - LOW);
    let height = share.y;
    let sway = 0.25 * height * DVec3::new((5.0 * height + 0.5).sin(), 0.0, (4.0 * height).cos());
    let swirl = |seed: f64| fractal(DVec3::new(2.2 * p.x + seed, 1.6 * p.y, 2.2 * p.z), 64, 3);
    let bent = p - sway + 0.35 * height.sqrt() * DVec3::new(swirl(3.3), 0.0, swirl(17.1));
    let across = bent.x.hypot(bent.z) / (0.1 + 0.38 * height.powf(0.8));
    let torn = 1.0 - across * across + 1.3 * fractal(3.0 * bent + DVec3::new(0.0, 1.5 * height, 0.0), 64, 4);
    // It begins and ends softly, and leaves the border of the box empty.
    let ends = (height / 0.04).min((1.0 - height) / 0.3).clamp(0.0, 1.0);
    let border = ((share - 0.5).abs().max_element() - 0.42).max(0.0) / 0.08;
    (1.6 * torn).clamp(0.0, 1.0) * ends * (1.0 - border).max(0.0)
}
