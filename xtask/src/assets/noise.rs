//! Smooth noise from a hash: the same on every machine.

use glam::{DVec3, IVec3};

/// A value in `[0, 1)` from integer coordinates.
///
/// # Source
/// The finaliser of `MurmurHash3` (Appleby, public domain) over a weighted sum of the coordinates.
pub(super) fn hash(at: IVec3) -> f64 {
    let [x, y, z] = at.to_array().map(|v| v as u32);
    let mut h = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ z.wrapping_mul(0xC2B2_AE3D);
    h = (h ^ (h >> 16)).wrapping_mul(0x85EB_CA6B);
    h = (h ^ (h >> 13)).wrapping_mul(0xC2B2_AE35);
    f64::from(h ^ (h >> 16)) / 4_294_967_296.0
}

/// Value noise in `[-1, 1]` with continuous second derivatives; repeats after `period` cells along each axis.
pub(super) fn value(p: DVec3, period: i32) -> f64 {
    let cell = p.floor();
    let f = p - cell;
    let smooth = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let base = cell.as_ivec3();
    let corner = |dx: i32, dy: i32, dz: i32| {
        let at = base + IVec3::new(dx, dy, dz);
        hash(at.rem_euclid(IVec3::splat(period)))
    };
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let edge = |dy: i32, dz: i32| mix(corner(0, dy, dz), corner(1, dy, dz), smooth.x);
    let face = |dz: i32| mix(edge(0, dz), edge(1, dz), smooth.y);
    2.0 * mix(face(0), face(1), smooth.z) - 1.0
}

/// Octaves of noise, each twice as fine and half as strong; about `[-1, 1]`.
pub(super) fn fractal(p: DVec3, period: i32, octaves: u32) -> f64 {
    (0..octaves).map(|o| 0.5_f64.powi(o as i32) * value(p * f64::from(1 << o), period << o)).sum::<f64>()
        * 0.5
}
