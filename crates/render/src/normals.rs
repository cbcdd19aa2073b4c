//! The normals of a hit, turned to the viewer and kept from what they must not do.

use crate::material_eval::MaterialEval;
use crate::phong::reflect;
use crate::shading::towards;
use glam::Vec3;
use heliostat_geometry::Hit;
use heliostat_scene::material::Relief;

/// A mirror direction rises above the surface by at least this share of the viewer's height, and this sine at most.
const LEAST_RISE: (f32, f32) = (0.9, 0.025);

/// Unit normals on the viewer's side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Normals {
    /// Unit direction to the viewer.
    pub(crate) view: Vec3,
    /// Whether the ray comes from outside, by the side of the geometric normal that it comes from.
    pub(crate) enters: bool,
    /// Geometric normal.
    pub(crate) ng: Vec3,
    /// Interpolated normal on the side of `ng`.
    pub(crate) smooth: Vec3,
    /// `smooth` bent by the relief; the mirror direction around it lies above the surface.
    pub(crate) ns: Vec3,
}

impl Normals {
    /// Those of a hit of a ray in direction `dir`, bent by a relief.
    #[inline]
    pub(crate) fn new(eval: &MaterialEval<'_>, relief: Option<Relief>, hit: &Hit, dir: Vec3) -> Self {
        let view = -dir.normalize();
        let enters = view.dot(hit.at.ng) >= 0.0;
        let side = if enters { 1.0 } else { -1.0 };
        let (ng, smooth) = (side * hit.at.ng, side * hit.ns);
        let bent = side * eval.bent_normal(relief, hit, hit.ns);
        let ns = if bent == ng { ng } else { lifted(ng, towards(bent, view), view) };
        Self { view, enters, ng, smooth, ns }
    }
}

/// The normal nearest to `n` around which the mirror direction of `view` keeps above the surface: below it there is nothing to
/// be seen, and a black pixel would stand for it.
///
/// # Source
/// `ensure_valid_specular_reflection` in Blender Cycles (`kernel/closure/bsdf_util.h`): in the plane of both normals, the mirror
/// direction at the least height gives a quadratic equation for the squared height of the normal.
fn lifted(ng: Vec3, n: Vec3, view: Vec3) -> Vec3 {
    let height = view.dot(ng);
    let least = (LEAST_RISE.0 * height).min(LEAST_RISE.1);
    if -reflect(view, n).dot(ng) >= least {
        return n;
    }
    let Some(across) = (n - n.dot(ng) * ng).try_normalize() else { return ng };
    let side = view.dot(across);
    let a = side * side + height * height;
    let b = a + height * least;
    let c = (least + height) * (least + height);
    let root = (b * b - a * c).max(0.0).sqrt();
    let height_squared = 0.5 * (if side < 0.0 { b + root } else { b - root }) / a;
    (1.0 - height_squared).max(0.0).sqrt() * across + height_squared.max(0.0).sqrt() * ng
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrors_show_nothing_from_below() {
        for tilt in 1..15 {
            for angle in 1..30 {
                for turn in 0..12 {
                    let tilt = 0.1 * tilt as f32;
                    let n = Vec3::new(tilt.sin(), 0.0, tilt.cos());
                    let (sin, cos) = (0.05 * angle as f32).sin_cos();
                    let around = glam::Vec2::from_angle(0.5 * turn as f32);
                    let view = Vec3::new(sin * around.x, sin * around.y, cos);
                    let n = towards(n, view);
                    let bent = lifted(Vec3::Z, n, view);
                    let rise = -reflect(view, bent).z;
                    assert!(rise > 0.5 * LEAST_RISE.1.min(LEAST_RISE.0 * cos), "{n} {view} {bent} {rise}");
                    assert!((bent.length() - 1.0).abs() < 1e-5);
                }
            }
        }
    }
}
