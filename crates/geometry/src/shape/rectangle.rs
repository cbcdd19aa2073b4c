//! A rectangle in the plane `y = 0`, seen from both sides.

use super::flat::{FlatPart, plane_root};
use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::ray::LocalRay;
use glam::{DVec2, Vec2, Vec3};

/// A rectangle around the origin with normal `+y`; `u` runs along x, `v` along `-z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Full lengths along x and z in metres, above 0.
    pub size: Vec2,
}

impl Rectangle {
    fn half(&self) -> DVec2 {
        0.5 * self.size.as_dvec2()
    }

    fn part(&self) -> FlatPart {
        FlatPart { y: 0.0, up: true, size: self.size.as_dvec2() }
    }

    fn extent(&self) -> f64 {
        self.half().max_element()
    }
}

impl Geometry for Rectangle {
    #[inline]
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        let t = plane_root(ray);
        if !ray.accepts(t) {
            return None;
        }
        let (at, half) = (ray.at(t), self.half());
        (at.x.abs() <= half.x && at.z.abs() <= half.y).then_some(Root { t, part: 0 })
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let at = ray.at(root.t);
        self.part().surface(root.t, at.x, at.z, self.extent())
    }

    fn bounds(&self) -> Aabb {
        let half = 0.5 * Vec3::new(self.size.x, 0.0, self.size.y);
        Aabb { min: -half, max: half }
    }

    fn area(&self) -> f64 {
        f64::from(self.size.x) * f64::from(self.size.y)
    }

    fn sample(&self, u: Vec2) -> Option<AreaSample> {
        let at = (u.as_dvec2() - DVec2::splat(0.5)) * self.size.as_dvec2();
        let area = self.area();
        (area > 0.0).then(|| self.part().sample(at.x, -at.y, self.extent(), area))
    }
}
