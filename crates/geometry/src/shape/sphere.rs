//! A sphere around the origin.

use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::error_bound::gamma_f64;
use crate::ray::LocalRay;
use glam::{DVec3, Vec2, Vec3};
use std::f64::consts::{PI, TAU};

/// A sphere around the origin; `u` runs around the y axis, `v` from the south pole to the north pole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Radius in metres, above 0.
    pub radius: f32,
}

impl Sphere {
    /// The point with the outward unit normal `ng`, as [`Geometry::sample`] gives it.
    pub fn point(&self, ng: DVec3) -> AreaSample {
        let u = ng.x.atan2(ng.z).rem_euclid(TAU) / TAU;
        let v = ng.y.clamp(-1.0, 1.0).asin() / PI + 0.5;
        AreaSample {
            p: f64::from(self.radius) * ng,
            p_err: gamma_f64(16) * f64::from(self.radius),
            ng,
            uv: Vec2::new(u as f32, v as f32),
            pdf: 1.0 / self.area(),
        }
    }
}

impl Geometry for Sphere {
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        let r = f64::from(self.radius);
        // Solve about the point of closest approach, where nothing cancels (Hearn and Baker; Haines et al. 2019).
        let a = ray.dir.length_squared();
        let b = -ray.origin.dot(ray.dir);
        let closest = ray.origin + (b / a) * ray.dir;
        let discriminant = (r * r - closest.length_squared()) * a;
        if discriminant < 0.0 {
            return None;
        }
        let q = b + discriminant.sqrt().copysign(b);
        let c = ray.origin.length_squared() - r * r;
        let (t0, t1) = if b > 0.0 { (c / q, q / a) } else { (q / a, c / q) };
        [t0, t1].into_iter().find(|&t| ray.accepts(t)).map(|t| Root { t, part: 0 })
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let n = ray.at(root.t).normalize();
        let p = f64::from(self.radius) * n;
        let phi = p.x.atan2(p.z).rem_euclid(TAU);
        let theta = n.y.clamp(-1.0, 1.0).asin();
        let around = DVec3::new(p.z, 0.0, -p.x);
        let upward = DVec3::new(-n.y * phi.sin(), theta.cos(), -n.y * phi.cos()) * f64::from(self.radius);
        LocalHit {
            t: root.t,
            p,
            p_err: gamma_f64(16) * f64::from(self.radius),
            ng: n,
            ns: n,
            uv: Vec2::new((phi / TAU) as f32, (theta / PI + 0.5) as f32),
            dpdu: (TAU * around).as_vec3(),
            dpdv: (PI * upward).as_vec3(),
        }
    }

    fn bounds(&self) -> Aabb {
        Aabb { min: Vec3::splat(-self.radius), max: Vec3::splat(self.radius) }
    }

    fn area(&self) -> f64 {
        2.0 * TAU * f64::from(self.radius).powi(2)
    }

    fn sample(&self, u: Vec2) -> Option<AreaSample> {
        // Archimedes: equal steps of height cut equal areas.
        let y = 1.0 - 2.0 * f64::from(u.y);
        let ring = (1.0 - y * y).max(0.0).sqrt();
        let (sin, cos) = (TAU * f64::from(u.x)).sin_cos();
        let ng = DVec3::new(ring * sin, y, ring * cos);
        let v = y.asin() / PI + 0.5;
        Some(AreaSample {
            p: f64::from(self.radius) * ng,
            p_err: gamma_f64(16) * f64::from(self.radius),
            ng,
            uv: Vec2::new(u.x, v as f32),
            pdf: 1.0 / self.area(),
        })
    }
}
