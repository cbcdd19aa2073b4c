//! What the shapes around the y axis share: the angle, its parameter `u`, and the tangent along it.

use glam::{DVec2, DVec3, Vec3};
use std::f32::consts::TAU as TAU_F32;
use std::f64::consts::TAU;

/// A half plane from the y axis: the unit vector away from the axis, as (x, z).
#[derive(Clone, Copy, Debug)]
pub(super) struct Radial {
    pub(super) x: f64,
    pub(super) z: f64,
}

impl Radial {
    /// The half plane through `p`, and the distance of `p` from the axis; towards `+z` on the axis itself.
    pub(super) fn through(p: DVec3) -> (Self, f64) {
        let xz = DVec2::new(p.x, p.z);
        let distance = xz.length();
        let unit = xz.try_normalize().unwrap_or(DVec2::Y);
        (Self { x: unit.x, z: unit.y }, distance)
    }

    /// The half plane of the parameter `u` in `[0, 1]`.
    pub(super) fn at(u: f32) -> Self {
        let (sin, cos) = (TAU * (f64::from(u) - 0.5)).sin_cos();
        Self { x: sin, z: cos }
    }

    /// The parameter: 0.5 towards `+z`, growing towards `+x`, with its seam at `-z`.
    pub(super) fn u(self) -> f32 {
        (self.x as f32).atan2(self.z as f32) / TAU_F32 + 0.5
    }

    /// A point by its distance from the axis and its height; also a vector in the half plane.
    pub(super) fn point(self, distance: f64, y: f64) -> DVec3 {
        DVec3::new(distance * self.x, y, distance * self.z)
    }

    /// Change of position per unit of `u` at that distance from the axis.
    pub(super) fn dpdu(self, distance: f64) -> Vec3 {
        (TAU * distance * DVec3::new(self.z, 0.0, -self.x)).as_vec3()
    }
}
