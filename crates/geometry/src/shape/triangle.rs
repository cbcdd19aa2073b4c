//! A single triangle, in `f64`; meshes are in [`crate::mesh`].

use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::error_bound::triangle_point;
use crate::ray::LocalRay;
use crate::warp::square_to_triangle;
use glam::{DVec3, Vec2, Vec3};

/// A triangle with its normal towards the side from which `a, b, c` turn counter-clockwise.
///
/// `u` and `v` are the weights of `b` and `c`. It is seen from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// First corner; `u = v = 0`.
    pub a: Vec3,
    /// Second corner; `u = 1`.
    pub b: Vec3,
    /// Third corner; `v = 1`.
    pub c: Vec3,
}

impl Triangle {
    fn corners(&self) -> [DVec3; 3] {
        [self.a.as_dvec3(), self.b.as_dvec3(), self.c.as_dvec3()]
    }

    /// Twice the area, along the normal.
    fn normal(&self) -> DVec3 {
        let [a, b, c] = self.corners();
        (b - a).cross(c - a)
    }

    /// The volumes that the ray spans with the edges opposite to a, b and c: the weights, up to a factor.
    #[inline]
    fn edge_volumes(&self, ray: &LocalRay) -> DVec3 {
        let [a, b, c] = self.corners().map(|corner| corner - ray.origin);
        DVec3::new(ray.dir.dot(c.cross(b)), ray.dir.dot(a.cross(c)), ray.dir.dot(b.cross(a)))
    }
}

impl Geometry for Triangle {
    #[inline]
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        // Reversing an edge negates its volume exactly, so triangles that share one leave no gap.
        let volumes = self.edge_volumes(ray);
        if volumes.min_element() < 0.0 && volumes.max_element() > 0.0 {
            return None;
        }
        let normal = self.normal();
        let t = normal.dot(self.a.as_dvec3() - ray.origin) / normal.dot(ray.dir);
        ray.accepts(t).then_some(Root { t, part: 0 })
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let [a, b, c] = self.corners();
        let (to_b, to_c, normal) = (b - a, c - a, self.normal());
        // From the point rather than from the ray, whose origin may be far away.
        let at = ray.at(root.t) - a;
        let weight = |volume: f64| (volume / normal.length_squared()).clamp(0.0, 1.0);
        let wb = weight(normal.dot(at.cross(to_c)));
        let wc = weight(normal.dot(to_b.cross(at))).min(1.0 - wb);
        LocalHit {
            t: root.t,
            p: a + wb * to_b + wc * to_c,
            p_err: triangle_point([self.a, self.b, self.c]),
            ng: normal,
            ns: normal,
            uv: Vec2::new(wb as f32, wc as f32),
            dpdu: to_b.as_vec3(),
            dpdv: to_c.as_vec3(),
        }
    }

    fn bounds(&self) -> Aabb {
        Aabb::of_points([self.a, self.b, self.c])
    }

    fn area(&self) -> f64 {
        0.5 * self.normal().length()
    }

    fn sample(&self, u: Vec2) -> Option<AreaSample> {
        let [a, b, c] = self.corners();
        let [_, wb, wc] = square_to_triangle(u);
        let area = self.area();
        (area > 0.0).then(|| AreaSample {
            p: a + f64::from(wb) * (b - a) + f64::from(wc) * (c - a),
            p_err: triangle_point([self.a, self.b, self.c]),
            ng: self.normal().normalize(),
            uv: Vec2::new(wb, wc),
            pdf: 1.0 / area,
        })
    }
}
