//! Points on a sphere, uniform by the solid angle under which it is seen.
//!
//! # Source
//! Shirley, Wang, Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", TOG 1996; the point on the sphere
//! as in Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 6.2.4.

use crate::world_sphere::WorldSphere;
use glam::{DVec3, Vec2, Vec3};
use heliostat_geometry::OrthonormalFrame;
use heliostat_geometry::error_bound::gamma;
use heliostat_geometry::warp::square_to_disk;
use std::f64::consts::TAU;

/// A direction to a sphere.
#[derive(Clone, Copy, Debug)]
pub(super) struct SphereSample {
    /// Unit direction to the point.
    pub(super) dir: Vec3,
    /// Outward unit normal at the nearer of the two points of the sphere in that direction.
    pub(super) normal: DVec3,
    /// The solid angle of the sphere: one over the density of directions.
    pub(super) solid_angle: f32,
}

impl WorldSphere {
    /// The solid angle of the sphere as seen from `p`; `None` from inside.
    #[inline]
    pub(super) fn solid_angle(&self, p: Vec3) -> Option<f32> {
        let sin2_max = self.squared_sine((self.centre - p.as_dvec3()).length_squared(), p)?;
        Some((TAU * sin2_max / (1.0 + (1.0 - sin2_max).sqrt())) as f32)
    }

    /// The squared sine of the angle between the directions from `p` to the centre and to the rim; `None` from inside, and from
    /// so near that rounding could decide.
    #[inline]
    fn squared_sine(&self, distance_squared: f64, p: Vec3) -> Option<f64> {
        let reach = f64::from(p.abs().max_element()) + self.radius;
        let least = self.radius + f64::from(gamma(16)) * reach;
        (distance_squared > least * least).then(|| self.radius * self.radius / distance_squared)
    }

    /// A direction from `p` uniform over the sphere as seen from there; `None` from inside.
    pub(super) fn sample(&self, p: Vec3, u: Vec2) -> Option<SphereSample> {
        let to_centre = self.centre - p.as_dvec3();
        let distance_squared = to_centre.length_squared();
        let sin2_max = self.squared_sine(distance_squared, p)?;
        let distance = distance_squared.sqrt();
        // Height of the cap of directions, 1 - cos, without cancellation.
        let cap = sin2_max / (1.0 + (1.0 - sin2_max).sqrt());
        let on_disk = square_to_disk(u);
        let height = f64::from(on_disk.length_squared().min(1.0)) * cap;
        let ring = (cap * (2.0 - height)).sqrt();
        let cos = 1.0 - height;

        // The nearer point in that direction, from the triangle of p, the centre and the point.
        let sin2 = height * (2.0 - height);
        let along = distance * cos - (self.radius * self.radius - distance_squared * sin2).max(0.0).sqrt();
        let frame = OrthonormalFrame::around((to_centre / distance).as_vec3());
        let dir = (ring * f64::from(on_disk.x) * frame.x.as_dvec3()
            + ring * f64::from(on_disk.y) * frame.y.as_dvec3()
            + cos * (to_centre / distance))
            .normalize();
        Some(SphereSample {
            dir: dir.as_vec3(),
            normal: (along * dir - to_centre).normalize_or(-to_centre / distance),
            solid_angle: (TAU * cap) as f32,
        })
    }
}
