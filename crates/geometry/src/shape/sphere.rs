//! A sphere around the origin.

use super::round::Radial;
use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::error_bound::shape_point;
use crate::ray::LocalRay;
use glam::{DVec3, Vec2, Vec3};
use std::f32::consts::FRAC_1_PI;
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
        let r = f64::from(self.radius);
        let (radial, ring) = Radial::through(ng);
        AreaSample {
            p: r * ng,
            p_err: shape_point(r),
            ng,
            uv: Vec2::new(radial.u(), latitude(ring, ng.y)),
            pdf: 1.0 / self.area(),
        }
    }

    /// Where the line of the ray enters and leaves, in order; `None` for most lines that miss, and rays that move away.
    #[inline]
    fn roots(&self, ray: &LocalRay) -> Option<[f64; 2]> {
        let r_squared = f64::from(self.radius) * f64::from(self.radius);
        // Outside and moving away: the common miss costs two products.
        let b = -ray.origin.dot(ray.dir);
        let c = ray.origin.length_squared() - r_squared;
        if c > 0.0 && b <= 0.0 {
            return None;
        }
        // Compare radius and distance of the line, in which nothing cancels (Haines et al., Ray Tracing Gems, ch. 7).
        let a = ray.dir.length_squared();
        let discriminant = r_squared * a - ray.origin.cross(ray.dir).length_squared();
        if discriminant < 0.0 {
            return None;
        }
        let q = b + discriminant.sqrt().copysign(b);
        Some(if b > 0.0 { [c / q, q / a] } else { [q / a, c / q] })
    }
}

impl Geometry for Sphere {
    #[inline]
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        self.roots(ray)?.into_iter().find(|&t| ray.accepts(t)).map(|t| Root { t, part: 0 })
    }

    fn each_root(&self, ray: &LocalRay, visit: &mut dyn FnMut(Root)) {
        let roots = self.roots(ray).into_iter().flatten();
        roots.filter(|&t| ray.accepts(t)).for_each(|t| visit(Root { t, part: 0 }));
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let bare = self.bare_surface(ray, root);
        let (r, n) = (f64::from(self.radius), bare.ng);
        let (radial, ring) = Radial::through(n);
        LocalHit {
            uv: Vec2::new(radial.u(), latitude(ring, n.y)),
            dpdu: radial.dpdu(r * ring),
            dpdv: (PI * r * radial.point(-n.y, ring)).as_vec3(),
            ..bare
        }
    }

    fn bare_surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let r = f64::from(self.radius);
        let n = ray.at(root.t).normalize();
        LocalHit {
            t: root.t,
            p: r * n,
            p_err: shape_point(r),
            ng: n,
            ns: n,
            uv: Vec2::ZERO,
            dpdu: Vec3::ZERO,
            dpdv: Vec3::ZERO,
        }
    }

    #[inline]
    fn normal(&self, ray: &LocalRay, root: Root) -> DVec3 {
        ray.at(root.t)
    }

    fn bounds(&self) -> Aabb {
        Aabb { min: Vec3::splat(-self.radius), max: Vec3::splat(self.radius) }
    }

    fn area(&self) -> f64 {
        2.0 * TAU * f64::from(self.radius).powi(2)
    }

    fn sample(&self, u: Vec2) -> Option<AreaSample> {
        // Archimedes: equal steps of height cut equal areas.
        let height = f64::from(u.y);
        let ring = 2.0 * (height * (1.0 - height)).max(0.0).sqrt();
        let ng = Radial::at(u.x).point(ring, 2.0 * height - 1.0);
        (self.radius > 0.0).then(|| self.point(ng))
    }
}

/// The parameter `v` of a point on the unit sphere, by its distance from the axis and its height.
fn latitude(ring: f64, y: f64) -> f32 {
    (y as f32).atan2(ring as f32) * FRAC_1_PI + 0.5
}
