//! A cylinder on the plane `y = 0`, a pipe or a solid.

use super::flat::FlatPart;
use super::frustum::{Frustum, SIDE, TOP};
use super::round::Radial;
use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::error_bound::shape_point;
use crate::ray::LocalRay;
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::f64::consts::{PI, TAU};

/// A cylinder around the y axis from `y = 0` to `y = height`.
///
/// On the side `u` runs around and `v` upwards; the square around each cap is mapped straight. Without caps it is
/// an infinitely thin pipe, seen from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Radius in metres, above 0.
    pub radius: f32,
    /// Height in metres, above 0.
    pub height: f32,
    /// Whether disks close the two ends.
    pub capped: bool,
}

impl Cylinder {
    fn cap(&self, top: bool) -> FlatPart {
        let y = if top { f64::from(self.height) } else { 0.0 };
        FlatPart { y, up: top, size: DVec2::splat(2.0 * f64::from(self.radius)) }
    }

    fn side_area(&self) -> f64 {
        TAU * f64::from(self.radius) * f64::from(self.height)
    }

    fn cap_area(&self) -> f64 {
        if self.capped { PI * f64::from(self.radius).powi(2) } else { 0.0 }
    }

    fn extent(&self) -> f64 {
        f64::from(self.radius.max(self.height))
    }
}

impl Geometry for Cylinder {
    #[inline]
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        let (radius, height) = (f64::from(self.radius), f64::from(self.height));
        Frustum { radius, slope: 0.0, height, capped: self.capped }.hit(ray)
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let at = ray.at(root.t);
        let (r, height) = (f64::from(self.radius), f64::from(self.height));
        let (radial, distance) = Radial::through(at);
        if root.part != SIDE {
            let p = radial.point(distance.min(r), 0.0);
            return self.cap(root.part == TOP).surface(root.t, p.x, p.z, self.extent());
        }
        let y = at.y.clamp(0.0, height);
        let n = radial.point(1.0, 0.0);
        LocalHit {
            t: root.t,
            p: radial.point(r, y),
            p_err: shape_point(self.extent()),
            ng: n,
            ns: n,
            uv: Vec2::new(radial.u(), (y / height) as f32),
            dpdu: radial.dpdu(r),
            dpdv: Vec3::new(0.0, self.height, 0.0),
        }
    }

    fn bounds(&self) -> Aabb {
        let r = self.radius;
        Aabb { min: Vec3::new(-r, 0.0, -r), max: Vec3::new(r, self.height, r) }
    }

    fn area(&self) -> f64 {
        self.side_area() + 2.0 * self.cap_area()
    }

    fn sample(&self, u: Vec2) -> Option<AreaSample> {
        let area = self.area();
        if area <= 0.0 {
            return None;
        }
        let (r, height) = (f64::from(self.radius), f64::from(self.height));
        // Choose bottom, side or top by area, and use what is left of the number inside the part.
        let chosen = f64::from(u.y) * area;
        let in_cap = |left: f64| Vec2::new(u.x, (left / self.cap_area()) as f32);
        if chosen < self.cap_area() {
            return Some(self.cap(false).sample_ring(in_cap(chosen), 0.0, r, area));
        }
        let chosen = chosen - self.cap_area();
        if self.capped && chosen >= self.side_area() {
            return Some(self.cap(true).sample_ring(in_cap(chosen - self.side_area()), 0.0, r, area));
        }
        let along = (chosen / self.side_area()).clamp(0.0, 1.0);
        let radial = Radial::at(u.x);
        Some(AreaSample {
            p: radial.point(r, along * height),
            p_err: shape_point(self.extent()),
            ng: DVec3::new(radial.x, 0.0, radial.z),
            uv: Vec2::new(u.x, along as f32),
            pdf: 1.0 / area,
        })
    }
}
