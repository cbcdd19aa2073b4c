//! The one place that knows how wrong a float can be.
//!
//! Every tolerance of the project is derived here from the unit roundoff; no other file holds an epsilon.
//!
//! # Source
//! Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 6.8 (`gamma`, origin offsets);
//! Wächter and Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, 2019.

use crate::ray::Interval;
use glam::Vec3;

/// Half the distance between 1 and the next `f32`: the largest relative error of one rounded operation.
pub const UNIT_ROUNDOFF: f32 = f32::EPSILON * 0.5;

/// Bound of the relative error of `n` rounded operations in a row: `n u / (1 - n u)`.
pub const fn gamma(n: u32) -> f32 {
    let nu = n as f32 * UNIT_ROUNDOFF;
    nu / (1.0 - nu)
}

/// Grows the slab distances `near <= far` by the error of `(plane - origin) / dir`, outward on both sides.
///
/// A NaN from `0 / 0` cannot occur: the caller treats a zero direction by itself.
pub fn grow_slab(near: f32, far: f32) -> Interval {
    let slack = 2.0 * gamma(3);
    Interval { min: near - slack * near.abs(), max: far + slack * far.abs() }
}

/// Bound of the rounding of `p`, a point computed in `f64` and rounded once, that a ray will see again in the
/// space of its object.
///
/// `extent` is, per axis, the largest magnitude that takes part in that second rounding: the absolute value of
/// the linear map times the absolute value of the point in object space (0 where the spaces are the same).
pub fn rounded_point(p: Vec3, extent: Vec3) -> Vec3 {
    gamma(2) * (p.abs() + extent) + Vec3::splat(f32::MIN_POSITIVE)
}

/// Moves `p` along the unit normal `n`, to the side that `dir` points to, out of the box of error `p_err`.
///
/// The result is rounded away from `p`, so that even a bound below one ulp moves the point.
pub fn offset_origin(p: Vec3, p_err: Vec3, n: Vec3, dir: Vec3) -> Vec3 {
    let distance = n.abs().dot(p_err);
    let offset = if dir.dot(n) < 0.0 { -distance * n } else { distance * n };
    let moved = p + offset;
    let away = |moved: f32, offset: f32| {
        if offset > 0.0 {
            moved.next_up()
        } else if offset < 0.0 {
            moved.next_down()
        } else {
            moved
        }
    };
    Vec3::new(away(moved.x, offset.x), away(moved.y, offset.y), away(moved.z, offset.z))
}
