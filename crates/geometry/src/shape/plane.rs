//! The infinite plane `y = 0`.

use super::flat::plane_root;
use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::ray::LocalRay;
use glam::{DVec3, Vec2, Vec3};

/// The infinite plane `y = 0` with normal `+y`; `u = x` and `v = -z` in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Plane;

impl Geometry for Plane {
    #[inline]
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        let t = plane_root(ray);
        ray.accepts(t).then_some(Root { t, part: 0 })
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let at = ray.at(root.t);
        LocalHit {
            t: root.t,
            p: DVec3::new(at.x, 0.0, at.z),
            // The height is exact, and the plane is the same everywhere else.
            p_err: 0.0,
            ng: DVec3::Y,
            ns: DVec3::Y,
            uv: Vec2::new(at.x as f32, -at.z as f32),
            dpdu: Vec3::X,
            dpdv: Vec3::NEG_Z,
        }
    }

    fn bounds(&self) -> Aabb {
        let far = Vec3::new(f32::INFINITY, 0.0, f32::INFINITY);
        Aabb { min: -far, max: far }
    }

    fn area(&self) -> f64 {
        f64::INFINITY
    }

    fn sample(&self, _: Vec2) -> Option<AreaSample> {
        None
    }
}
