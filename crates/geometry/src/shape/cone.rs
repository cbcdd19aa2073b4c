//! A cone or truncated cone on the plane `y = 0`, a surface or a solid.

use super::flat::FlatPart;
use super::frustum::{Frustum, SIDE, TOP};
use super::round::Radial;
use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::error_bound::shape_point;
use crate::ray::LocalRay;
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::f64::consts::PI;

/// A cone around the y axis from `y = 0` to `y = height`.
///
/// On the side `u` runs around and `v` upwards; the square around each cap is mapped straight. Without caps it is
/// an infinitely thin funnel, seen from both sides. At an apex the normal points along the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Radius at `y = 0` in metres, 0 or more.
    pub radius: f32,
    /// Radius at `y = height` in metres, 0 or more; 0 makes an apex. Not both radii are 0.
    pub top_radius: f32,
    /// Height in metres, above 0.
    pub height: f32,
    /// Whether disks close the ends.
    pub capped: bool,
}

impl Cone {
    fn radii(&self) -> (f64, f64) {
        (f64::from(self.radius), f64::from(self.top_radius))
    }

    /// Change of the radius per unit of height.
    fn slope(&self) -> f64 {
        let (bottom, top) = self.radii();
        (top - bottom) / f64::from(self.height)
    }

    fn cap(&self, top: bool) -> FlatPart {
        let (y, radius) = if top { (f64::from(self.height), self.top_radius) } else { (0.0, self.radius) };
        FlatPart { y, up: top, size: DVec2::splat(2.0 * f64::from(radius)) }
    }

    fn side_area(&self) -> f64 {
        let (bottom, top) = self.radii();
        PI * (bottom + top) * (top - bottom).hypot(f64::from(self.height))
    }

    fn cap_area(&self, radius: f64) -> f64 {
        if self.capped { PI * radius * radius } else { 0.0 }
    }

    fn extent(&self) -> f64 {
        f64::from(self.radius.max(self.top_radius).max(self.height))
    }
}

impl Geometry for Cone {
    #[inline]
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        let (radius, height) = (f64::from(self.radius), f64::from(self.height));
        Frustum { radius, slope: self.slope(), height, capped: self.capped }.hit(ray)
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let at = ray.at(root.t);
        let ((bottom, top), height, slope) = (self.radii(), f64::from(self.height), self.slope());
        let (radial, distance) = Radial::through(at);
        if root.part != SIDE {
            let is_top = root.part == TOP;
            let p = radial.point(distance.min(if is_top { top } else { bottom }), 0.0);
            return self.cap(is_top).surface(root.t, p.x, p.z, self.extent());
        }
        let y = at.y.clamp(0.0, height);
        let r = (bottom + slope * y).max(0.0);
        // The gradient of the distance to the side; on the axis, at an apex, its mean over all directions.
        let n = radial.point(if distance > 0.0 { 1.0 } else { 0.0 }, -slope);
        LocalHit {
            t: root.t,
            p: radial.point(r, y),
            p_err: shape_point(self.extent()),
            ng: n,
            ns: n,
            uv: Vec2::new(radial.u(), (y / height) as f32),
            dpdu: radial.dpdu(r),
            dpdv: radial.point(top - bottom, height).as_vec3(),
        }
    }

    fn bounds(&self) -> Aabb {
        let r = self.radius.max(self.top_radius);
        Aabb { min: Vec3::new(-r, 0.0, -r), max: Vec3::new(r, self.height, r) }
    }

    fn area(&self) -> f64 {
        let (bottom, top) = self.radii();
        self.side_area() + self.cap_area(bottom) + self.cap_area(top)
    }

    fn sample(&self, u: Vec2) -> Option<AreaSample> {
        let area = self.area();
        if area <= 0.0 {
            return None;
        }
        let ((bottom, top), height) = (self.radii(), f64::from(self.height));
        // Choose bottom, side or top by area, and use what is left of the number inside the part.
        let chosen = f64::from(u.y) * area;
        let in_cap = |left: f64, radius: f64| Vec2::new(u.x, (left / self.cap_area(radius)) as f32);
        if chosen < self.cap_area(bottom) {
            return Some(self.cap(false).sample_ring(in_cap(chosen, bottom), 0.0, bottom, area));
        }
        let chosen = chosen - self.cap_area(bottom);
        if chosen >= self.side_area() && self.cap_area(top) > 0.0 {
            return Some(self.cap(true).sample_ring(in_cap(chosen - self.side_area(), top), 0.0, top, area));
        }
        // The square of the radius is uniform; the form of `along` keeps its digits when the radii are equal.
        let share = (chosen / self.side_area()).clamp(0.0, 1.0);
        let r = (bottom * bottom + share * (top * top - bottom * bottom)).max(0.0).sqrt();
        let along = (share * (bottom + top) / (bottom + r)).min(1.0);
        let radial = Radial::at(u.x);
        Some(AreaSample {
            p: radial.point(bottom + along * (top - bottom), along * height),
            p_err: shape_point(self.extent()),
            ng: DVec3::new(radial.x, -self.slope(), radial.z).normalize(),
            uv: Vec2::new(u.x, along as f32),
            pdf: 1.0 / area,
        })
    }
}
