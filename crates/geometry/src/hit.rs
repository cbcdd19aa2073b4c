//! A point on a surface with the bound of its error, and the rays that leave it.

use crate::error_bound::{offset_along, offset_origin, segment_end};
use crate::ray::{Interval, Ray};
use glam::{Vec2, Vec3};

/// A point on a surface: enough to start a ray from it.
///
/// The promise of the spawned rays holds for directions further from the tangent plane than the rounding of the normal
/// itself, about `1e-7`, and for surfaces that are larger than the spacing of numbers where they are.
///
/// ```
/// use glam::{DVec3, Vec3};
/// use heliostat_geometry::shape::{Geometry, Sphere};
/// use heliostat_geometry::{Ray, Transform};
///
/// // A pebble a kilometre away, where neighbouring numbers are 6e-5 apart.
/// let place = Transform::translation(Vec3::new(0.0, 0.0, 1000.0));
/// let sphere = Sphere { radius: 0.01 };
/// let ray = place.local_ray(&Ray::new(Vec3::new(0.001, 0.002, 0.0), Vec3::Z));
/// let hit = place.hit_to_world(&sphere.surface(&ray, sphere.hit(&ray).unwrap()));
/// // The reflected ray is free, the refracted one meets the far side.
/// assert!(sphere.hit(&place.local_ray(&hit.spawn(Vec3::NEG_Z))).is_none());
/// assert!(sphere.hit(&place.local_ray(&hit.spawn(Vec3::Z))).is_some());
/// ```
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

    /// Where all rays start that leave to the side of `ng`: worked out once for many of them.
    pub fn departure(&self) -> Departure {
        Departure { origin: offset_along(self.p, self.p_err, self.ng) }
    }

    /// A ray to `target`, a point in free space, with `t` in `[0, 1]`.
    pub fn spawn_to(&self, target: Vec3) -> Ray {
        let origin = offset_origin(self.p, self.p_err, self.ng, target - self.p);
        Ray { origin, dir: target - origin, range: Interval { min: 0.0, max: 1.0 } }
    }

    /// A ray to a point on another surface, with `t` in `[0, 1]`; it ends just before that surface.
    ///
    /// The end keeps clear of the target by the error bound of the target *and* of the ray's own length, which is the
    /// larger one when the ray comes from far away.
    pub fn spawn_to_surface(&self, target: &Self) -> Ray {
        let back = self.p - target.p;
        self.spawn_to(offset_origin(target.p, target.p_err + segment_end(back), target.ng, back))
    }
}

/// The common start of rays that leave a surface to the side of its normal; see [`SurfacePoint::departure`].
///
/// A direction to the other side gives a ray that meets the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    origin: Vec3,
}

impl Departure {
    /// Where the rays start.
    #[inline]
    pub fn origin(&self) -> Vec3 {
        self.origin
    }

    /// See [`SurfacePoint::spawn`].
    pub fn spawn(&self, dir: Vec3) -> Ray {
        Ray::new(self.origin, dir)
    }

    /// See [`SurfacePoint::spawn_to`].
    pub fn spawn_to(&self, target: Vec3) -> Ray {
        Ray { origin: self.origin, dir: target - self.origin, range: Interval { min: 0.0, max: 1.0 } }
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
    /// Surface parameters; in `[0, 1]` on analytic shapes (metres on the infinite plane), as given on meshes.
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
