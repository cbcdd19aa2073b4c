//! The width of a ray: how much of a surface one look stands for.
//!
//! A cone around the ray starts as wide as the pixel's share and grows with the way. Where it meets a surface, it cuts an
//! ellipse out of it; textures are averaged over that. Of many samples each stands for its part of the pixel alone, so that what
//! samples resolve is not blurred: the footprint shrinks with the square root of their number, to an eighth at most.
//!
//! A scattered ray was drawn with a density: it stands for the solid angle of one over it, less the same share.
//!
//! # Source
//! Akenine-Möller et al., "Improved Shader and Texture Level of Detail Using Ray Cones", JCGT 10(1), 2021 (cones, and the ellipse
//! on the surface); Suykens, Willems, "Path Differentials and Applications", EGWR 2001 (footprints by density and number
//! of samples); Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 10.1.3 (the least share).

use glam::{Vec2, Vec3};
use heliostat_geometry::Hit;
use std::f32::consts::PI;

/// The least share of a pixel that a sample stands for.
const LEAST_SHARE: f32 = 0.125;
/// The widest cone in radians: beyond, directions are no longer close.
const WIDEST: f32 = 1.0;
/// The longer axis of an ellipse is so many times the width of the cone at most.
const LONGEST: f32 = 64.0;

/// A cone around a ray. The narrowest has no width, and looks at points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayCone {
    /// Its width in metres where the ray starts.
    width: f32,
    /// Its angle in radians.
    spread: f32,
    /// The share of the width of a pixel that one sample stands for.
    share: f32,
}

impl RayCone {
    /// No width at all: textures are looked at in points.
    pub const POINT: Self = Self { width: 0.0, spread: 0.0, share: 0.0 };

    /// The cone of one of `samples` camera rays through a pixel that is `width` metres wide at the camera, and an angle of `spread`
    /// radians.
    pub fn of_pixel(width: f32, spread: f32, samples: u32) -> Self {
        let share = (1.0 / (samples.max(1) as f32).sqrt()).max(LEAST_SHARE);
        Self { width: share * width, spread: share * spread.min(WIDEST), share }
    }

    /// Whether it has no width.
    #[inline]
    pub(crate) fn is_point(&self) -> bool {
        self.share == 0.0
    }

    /// The cone of the same ray `way` metres further.
    #[inline]
    pub(crate) fn after(&self, way: f32) -> Self {
        Self { width: self.width + way * self.spread, ..*self }
    }

    /// The cone of a ray that was scattered here with a density per steradian.
    #[inline]
    pub(crate) fn scattered(&self, pdf: f32) -> Self {
        // A cap of solid angle 1/p has the half angle sqrt(1 / (pi p)), nearly.
        let own = 2.0 * self.share / (PI * pdf).sqrt();
        let spread = self.spread.hypot(own);
        Self { spread: if spread < WIDEST { spread } else { WIDEST }, ..*self }
    }

    /// What one look at a hit of a ray in direction `dir` stands for.
    #[inline]
    pub(crate) fn footprint(&self, hit: &Hit, dir: Vec3) -> [Vec2; 2] {
        if self.is_point() {
            return [Vec2::ZERO; 2];
        }
        let length = dir.length();
        let width = self.after(hit.t * length).width;
        footprint(hit, dir / length, width)
    }
}

/// The ellipse that a cone of a width cuts out of a surface: the change of the surface parameters along its whole axes. Zero where the
/// surface has no parameters.
///
/// # Source
/// Akenine-Möller et al. 2021, section 5: the axes, here by the cosine; the parameters by least squares.
#[inline]
fn footprint(hit: &Hit, dir: Vec3, width: f32) -> [Vec2; 2] {
    let (pu, pv) = (hit.dpdu, hit.dpdv);
    let (e, f, g) = (pu.dot(pu), pu.dot(pv), pv.dot(pv));
    let area = e * g - f * f;
    let n = hit.at.ng;
    let cos = dir.dot(n);
    let Some(along) = (dir - cos * n).try_normalize().or_else(|| pu.try_normalize()) else {
        return [Vec2::ZERO; 2];
    };
    let axes = [width * (1.0 / cos.abs()).min(LONGEST) * along, width * n.cross(along)];
    axes.map(|axis| {
        let (u, v) = (axis.dot(pu), axis.dot(pv));
        let uv = Vec2::new(g * u - f * v, e * v - f * u) / area;
        if uv.is_finite() { uv } else { Vec2::ZERO }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_geometry::SurfacePoint;

    fn floor() -> Hit {
        Hit {
            t: 1.0,
            at: SurfacePoint { p: Vec3::ZERO, p_err: Vec3::ZERO, ng: Vec3::Y },
            ns: Vec3::Y,
            uv: Vec2::ZERO,
            dpdu: 2.0 * Vec3::X,
            dpdv: 4.0 * Vec3::NEG_Z,
        }
    }

    #[test]
    fn ellipses_are_those_of_a_slanted_cylinder() {
        // Straight from above: a circle, in units of 2 and 4 metres.
        let [a, b] = footprint(&floor(), Vec3::NEG_Y, 0.1);
        let (u, v) = (a.x.abs().max(b.x.abs()), a.y.abs().max(b.y.abs()));
        assert!((u - 0.05).abs() < 1e-7 && (v - 0.025).abs() < 1e-7, "{a} {b}");
        // At 60 degrees off the normal, along -z: twice as long there.
        let dir = Vec3::new(0.0, -0.5, -0.75_f32.sqrt());
        let [along, across] = footprint(&floor(), dir, 0.1);
        assert!(along.distance(Vec2::new(0.0, 0.05)) < 1e-6, "{along}");
        assert!((across.x.abs() - 0.05).abs() < 1e-6 && across.y.abs() < 1e-6, "{across}");
        // Edge on it stays finite, and a surface without parameters has none.
        assert!(footprint(&floor(), Vec3::X, 0.1).iter().all(|axis| axis.is_finite()));
        let bare = Hit { dpdu: Vec3::ZERO, dpdv: Vec3::ZERO, ..floor() };
        assert_eq!(footprint(&bare, dir, 0.1), [Vec2::ZERO; 2]);
    }

    #[test]
    fn samples_share_a_pixel() {
        let cone = RayCone::of_pixel(0.0, 0.01, 16).after(10.0);
        assert!((cone.width - 0.1 / 4.0).abs() < 1e-7);
        assert_eq!(RayCone::of_pixel(1.0, 0.0, 1_000_000).width, LEAST_SHARE);
        let wide = cone.scattered(0.0);
        assert_eq!(wide.spread, WIDEST);
        assert_eq!(RayCone::POINT.after(5.0).scattered(1.0).width, 0.0);
    }
}
