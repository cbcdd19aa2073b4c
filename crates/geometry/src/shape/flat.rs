//! What the shapes in the plane `y = 0` share: the root, and the straight mapping of a flat part.

use crate::error_bound::shape_point;
use crate::ray::LocalRay;
use crate::shape::{AreaSample, LocalHit};
use crate::warp::square_to_disk;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// The ray parameter at which the ray meets `y = 0`; infinite or NaN, which no range accepts, when parallel.
#[inline]
pub(super) fn plane_root(ray: &LocalRay) -> f64 {
    -ray.origin.y / ray.dir.y
}

/// A flat part at height `y`, facing up or down, with parameters that fill a rectangle around the axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatPart {
    /// Height of the part.
    pub(super) y: f64,
    /// Whether the normal is `+y`, else `-y`.
    pub(super) up: bool,
    /// Sides along x and z of the rectangle that the parameters fill.
    pub(super) size: DVec2,
}

impl FlatPart {
    /// The normal.
    fn normal(self) -> DVec3 {
        if self.up { DVec3::Y } else { DVec3::NEG_Y }
    }

    /// Parameters of a point: `u` along x, `v` along `-z` seen from above, along `z` seen from below.
    fn uv(self, x: f64, z: f64) -> Vec2 {
        let along_z = if self.up { -z } else { z };
        DVec2::new(0.5 + x / self.size.x, 0.5 + along_z / self.size.y).as_vec2().clamp(Vec2::ZERO, Vec2::ONE)
    }

    /// The surface at the point `(x, z)`; `extent` is the largest coordinate of the whole shape.
    pub(super) fn surface(self, t: f64, x: f64, z: f64, extent: f64) -> LocalHit {
        let along_z = if self.up { -self.size.y } else { self.size.y };
        LocalHit {
            t,
            p: DVec3::new(x, self.y, z),
            p_err: shape_point(extent),
            ng: self.normal(),
            ns: self.normal(),
            uv: self.uv(x, z),
            dpdu: Vec3::new(self.size.x as f32, 0.0, 0.0),
            dpdv: Vec3::new(0.0, 0.0, along_z as f32),
        }
    }

    /// A uniform point on the ring between two radii; the pdf is that of a shape of the given `area`.
    pub(super) fn sample_ring(self, u: Vec2, inner: f64, outer: f64, area: f64) -> AreaSample {
        // Stretch the unit disk so that equal areas stay equal when its middle is missing.
        let unit = square_to_disk(u).as_dvec2();
        let squared = unit.length_squared().min(1.0);
        let radius = (inner * inner + squared * (outer * outer - inner * inner)).sqrt();
        let at = radius * unit.try_normalize().unwrap_or(DVec2::X);
        self.sample(at.x, at.y, outer, area)
    }

    /// A sample at the point `(x, z)`.
    pub(super) fn sample(self, x: f64, z: f64, extent: f64, area: f64) -> AreaSample {
        AreaSample {
            p: DVec3::new(x, self.y, z),
            p_err: shape_point(extent),
            ng: self.normal(),
            uv: self.uv(x, z),
            pdf: 1.0 / area,
        }
    }
}
