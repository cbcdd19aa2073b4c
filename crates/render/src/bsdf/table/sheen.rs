//! How much light standing fibres send back.

use super::axis::Place;
use crate::bsdf::quadrature::gauss_legendre;
use crate::bsdf::sheen::Sheen;
use glam::Vec3;
use std::f32::consts::PI;
use std::sync::LazyLock;

/// Nodes of the cosine of the viewer, even in its root, and of the roughness.
const COS: usize = 48;
const ROUGHNESS: usize = 33;
/// Nodes of the integral over directions, around the normal (half of them, by symmetry) and away from it.
const TURNS: usize = 64;
const HEIGHTS: usize = 48;

/// Share of the light that white fibres of a roughness in `[0, 1]` send to a viewer at an angle of cosine `cos`.
pub(crate) fn sheen_albedo(roughness: f32, cos: f32) -> f32 {
    let (row, column) = (Place::even(roughness, ROUGHNESS), Place::even(cos.max(0.0).sqrt(), COS));
    let mut sum = 0.0;
    for (r, at_roughness) in row.pair() {
        for (c, at_cos) in column.pair() {
            sum += at_roughness * at_cos * TABLE[r][c];
        }
    }
    sum
}

/// By which the fibres of a roughness are made darker, so that they send back no more than all light from any angle.
pub(crate) fn sheen_scale(roughness: f32) -> f32 {
    let brightest = |row: &[f32; COS]| row.iter().fold(1.0, |a: f32, b| a.max(*b));
    let row = Place::even(roughness, ROUGHNESS);
    1.0 / row.pair().into_iter().map(|(r, share)| share * brightest(&TABLE[r])).sum::<f32>()
}

static TABLE: LazyLock<Vec<[f32; COS]>> = LazyLock::new(|| {
    let row = |r: usize| {
        let sheen = Sheen::new(r as f32 / (ROUGHNESS - 1) as f32);
        std::array::from_fn(|c| albedo(&sheen, (c as f32 / (COS - 1) as f32).powi(2)))
    };
    (0..ROUGHNESS).map(row).collect()
});

fn albedo(sheen: &Sheen, cos: f32) -> f32 {
    let wo = Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
    let mut sum = 0.0;
    for (x, weight) in gauss_legendre::<HEIGHTS>() {
        // Nodes crowd where the angle is grazing: the cosine is the square.
        let (z, weight) = (x * x, weight * 2.0 * x);
        let ring = (1.0 - z * z).max(0.0).sqrt();
        for turn in 0..TURNS {
            let (sin, cos) = (PI * (turn as f32 + 0.5) / TURNS as f32).sin_cos();
            let wi = Vec3::new(ring * cos, ring * sin, z);
            sum += 2.0 * PI * weight / TURNS as f32 * sheen.single(wo, wi);
        }
    }
    sum
}
