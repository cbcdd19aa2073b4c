//! Points on flat lamps that stand still: rectangles and disks, with everything that is the same for all points worked
//! out once.

use super::spherical_rectangle::WorldRectangle;
use crate::lanes::{LANES, Lanes, Vec3Lanes};
use glam::{DVec2, DVec3, Vec2, Vec3};
use heliostat_geometry::error_bound::{gamma, is_square};
use heliostat_geometry::warp::square_to_disk;
use heliostat_geometry::{Shape, SurfacePoint, Transform};

/// A rectangle or a full disk in world space; a map may have stretched or sheared it.
#[derive(Clone, Copy, Debug)]
pub(super) struct WorldFlat {
    centre: Vec3,
    /// Image of the local x axis, half of the size long.
    x: Vec3,
    /// Image of the local z axis, half of the size long.
    z: Vec3,
    is_disk: bool,
    /// Unit normal.
    pub(super) normal: Vec3,
    pub(super) area: f32,
    /// Bound of the error of its points, per axis.
    p_err: Vec3,
}

impl WorldFlat {
    /// The image of a shape; `None` unless it is a rectangle or a full disk of area above 0.
    pub(super) fn new(shape: &Shape, transform: &Transform) -> Option<Self> {
        let (half, is_disk) = match shape {
            Shape::Rectangle(rectangle) => (0.5 * rectangle.size.as_dvec2(), false),
            Shape::Disk(disk) if disk.inner_radius == 0.0 => (DVec2::splat(f64::from(disk.radius)), true),
            _ => return None,
        };
        let matrix = transform.matrix();
        let (x, z) = (half.x * matrix.matrix3.x_axis, half.y * matrix.matrix3.z_axis);
        let local = shape.geometry().area();
        let area = (local * transform.area_stretch(DVec3::Y)) as f32;
        let reach = (matrix.translation.abs() + x.abs() + z.abs()).as_vec3();
        // What a ray will see of the shape itself, and the few operations by which points are made here.
        let seen = transform.surface_point(DVec3::new(half.x, 0.0, half.y), 0.0, DVec3::Y).p_err;
        (area > 0.0 && area.is_finite()).then(|| Self {
            centre: matrix.translation.as_vec3(),
            x: x.as_vec3(),
            z: z.as_vec3(),
            is_disk,
            normal: transform.normal(Vec3::Y),
            area,
            p_err: seen.max(transform.surface_point(DVec3::ZERO, 0.0, DVec3::Y).p_err) + gamma(16) * reach,
        })
    }

    /// The rectangle, if it is one with right angles.
    pub(super) fn rectangle(&self) -> Option<WorldRectangle> {
        let is_rectangle = !self.is_disk && is_square(self.x, self.z);
        is_rectangle.then(|| WorldRectangle::new(self.centre, self.x, self.z))
    }

    /// A point of it with its error bound.
    #[inline]
    pub(super) fn at(&self, p: Vec3) -> SurfacePoint {
        SurfacePoint { p, p_err: self.p_err, ng: self.normal }
    }

    /// How far its points lie from `p`, per axis, at most; to a few roundings.
    #[inline]
    pub(super) fn reach(&self, p: Vec3) -> Vec3 {
        (self.centre - p).abs() + self.x.abs() + self.z.abs()
    }

    /// A point for each lane; see [`WorldFlat::point`].
    #[inline(always)]
    pub(super) fn points(&self, u: &Lanes, v: &Lanes) -> Vec3Lanes {
        let mut points = Vec3Lanes::splat(self.centre);
        let (centre, x, z, is_disk) = (self.centre, self.x, self.z, self.is_disk);
        for i in 0..LANES {
            let u = Vec2::new(u[i], v[i]);
            let local = if is_disk { square_to_disk(u) } else { 2.0 * u - Vec2::ONE };
            points.set(i, centre + local.x * x + local.y * z);
        }
        points
    }

    /// A point uniform by area.
    #[inline]
    pub(super) fn point(&self, u: Vec2) -> Vec3 {
        let local = if self.is_disk { square_to_disk(u) } else { 2.0 * u - Vec2::ONE };
        self.centre + local.x * self.x + local.y * self.z
    }
}
