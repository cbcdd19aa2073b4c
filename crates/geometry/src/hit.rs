//! A point on a surface with the bound of its error, and the rays that leave it.

use crate::error_bound::{offset_origin, segment_end};
use crate::ray::{Interval, Ray};
use glam::{Vec2, Vec3};

/// A point on a surface: enough to start a ray from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position.
    pub p: Vec3,
    /// Bound of the absolute error of `p`, per axis.
    pub p_err: Vec3,
    /// Unit geometric normal.
    pub ng: Vec3,
}

impl SurfacePoint {
    /// A ray in direction `dir` that does not meet the surface it leaves.
    ///
    /// The side is chosen by the sign of `dir . ng`: a refracted ray starts behind the surface.
    pub fn spawn(&self, dir: Vec3) -> Ray {
        Ray::new(offset_origin(self.p, self.p_err, self.ng, dir), dir)
    }

    /// A ray to `target`, a point in free space, with `t` in `[0, 1]`.
    pub fn spawn_to(&self, target: Vec3) -> Ray {
        let origin = offset_origin(self.p, self.p_err, self.ng, target - self.p);
        Ray { origin, dir: target - origin, range: Interval { min: 0.0, max: 1.0 } }
    }

    /// A ray to a point on another surface, with `t` in `[0, 1]`; it ends just before that surface.
    pub fn spawn_to_surface(&self, target: &Self) -> Ray {
        let back = self.p - target.p;
        self.spawn_to(offset_origin(target.p, target.p_err + segment_end(back), target.ng, back))
    }
}

/// A random point on a surface in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSample {
    /// Position with its error bound and the geometric normal (outward).
    pub at: SurfacePoint,
    /// Surface parameters.
    pub uv: Vec2,
    /// Probability per square metre of world space.
    pub pdf: f32,
}

/// Where and how a ray met a surface, in the space of the ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Ray parameter of the hit.
    pub t: f32,
    /// Position with its error bound and the geometric normal (outward; not turned to the ray).
    pub at: SurfacePoint,
    /// Unit shading normal, on the same side as the geometric normal.
    pub ns: Vec3,
    /// Surface parameters; in `[0, 1]` on analytic shapes, as given on meshes.
    pub uv: Vec2,
    /// Change of position per unit of `u`; may be zero at a pole or without texture coordinates.
    pub dpdu: Vec3,
    /// Change of position per unit of `v`.
    pub dpdv: Vec3,
}

impl Hit {
    /// See [`SurfacePoint::spawn`].
    pub fn spawn(&self, dir: Vec3) -> Ray {
        self.at.spawn(dir)
    }

    /// See [`SurfacePoint::spawn_to`].
    pub fn spawn_to(&self, target: Vec3) -> Ray {
        self.at.spawn_to(target)
    }

    /// See [`SurfacePoint::spawn_to_surface`].
    pub fn spawn_to_surface(&self, target: &SurfacePoint) -> Ray {
        self.at.spawn_to_surface(target)
    }
}
