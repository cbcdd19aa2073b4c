//! A disk in the plane `y = 0`, with or without a hole, seen from both sides.

use super::flat::{FlatPart, plane_root};
use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::ray::LocalRay;
use glam::{DVec2, Vec2, Vec3};
use std::f64::consts::PI;

/// A disk around the origin with normal `+y`; the square around it is mapped as on a [`super::Rectangle`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    /// Outer radius in metres, above 0.
    pub radius: f32,
    /// Radius of the hole in metres, from 0 to `radius`.
    pub inner_radius: f32,
}

impl Disk {
    fn part(&self) -> FlatPart {
        FlatPart { y: 0.0, up: true, size: DVec2::splat(2.0 * f64::from(self.radius)) }
    }
}

impl Geometry for Disk {
    #[inline]
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        let t = plane_root(ray);
        if !ray.accepts(t) {
            return None;
        }
        let at = ray.at(t);
        let squared = at.x * at.x + at.z * at.z;
        let (inner, outer) = (f64::from(self.inner_radius), f64::from(self.radius));
        (squared <= outer * outer && squared >= inner * inner).then_some(Root { t, part: 0 })
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let at = ray.at(root.t);
        self.part().surface(root.t, at.x, at.z, f64::from(self.radius))
    }

    fn bounds(&self) -> Aabb {
        let corner = Vec3::new(self.radius, 0.0, self.radius);
        Aabb { min: -corner, max: corner }
    }

    fn area(&self) -> f64 {
        let (inner, outer) = (f64::from(self.inner_radius), f64::from(self.radius));
        PI * (outer - inner) * (outer + inner)
    }

    fn sample(&self, u: Vec2) -> Option<AreaSample> {
        let (inner, outer) = (f64::from(self.inner_radius), f64::from(self.radius));
        let area = self.area();
        (area > 0.0).then(|| self.part().sample_ring(u, inner, outer, area))
    }
}
