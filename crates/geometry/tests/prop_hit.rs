//! Laws of intervals, frames, spawned rays, and of the strategies that the other tests rest on.

use glam::Vec3;
use heliostat_geometry::strategies::{
    closed_mesh, direction, hostile_float, mesh, point, ray_at_mesh, shape, transform,
};
use heliostat_geometry::triangle::{TriangleRay, intersect};
use heliostat_geometry::{Interval, OrthonormalFrame, Ray, SurfacePoint};
use proptest::prelude::*;

fn interval() -> impl Strategy<Value = Interval> {
    [hostile_float(), hostile_float()].prop_map(|[min, max]| Interval { min, max })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// What lies in both lies in the intersection; nothing lies in an empty interval.
    #[test]
    fn intervals_meet(a in interval(), b in interval(), t in hostile_float()) {
        prop_assert_eq!(a.contains(t) && b.contains(t), a.intersect(b).contains(t));
        prop_assert!(!(a.is_empty() && a.contains(t)));
        let broken = Interval { min: f32::NAN, ..a };
        prop_assert!(!a.contains(f32::NAN) && broken.is_empty());
    }

    /// Frames are orthonormal and right-handed around any direction, and keep lengths.
    #[test]
    fn frames_are_orthonormal(dir in direction(), v in point()) {
        let z = dir.normalize();
        let frame = OrthonormalFrame::around(z);
        for (a, b, expected) in [(frame.x, frame.x, 1.0), (frame.y, frame.y, 1.0), (frame.x, frame.y, 0.0), (frame.x, z, 0.0)] {
            prop_assert!((a.dot(b) - expected).abs() < 1e-6);
        }
        prop_assert!(frame.x.cross(frame.y).distance(z) < 1e-6);
        prop_assert!(frame.to_local(frame.to_world(v)).distance(v) <= 4e-6 * v.length());
    }

    /// A spawned ray starts on the side of its direction, beyond the error; a segment ends on the target.
    #[test]
    fn spawned_rays_start_off_the_surface(p in point(), n in direction(), dir in direction(), err in 0.0_f32..1e-3) {
        let ng = n.normalize();
        let at = SurfacePoint { p, p_err: Vec3::splat(err), ng };
        let cosine = dir.as_dvec3().dot(ng.as_dvec3());
        let height = (at.spawn(dir).origin.as_dvec3() - p.as_dvec3()).dot(ng.as_dvec3());
        // The height reaches over the corner of the box of error that the normal points to.
        let reach = f64::from(err) * f64::from(ng.abs().element_sum()) * (1.0 - 1e-6);
        prop_assert!(if cosine < 0.0 { height <= -reach } else { height >= reach }, "{height} {reach}");

        let ray = at.spawn_to(p + dir);
        prop_assert_eq!(ray.range, Interval { min: 0.0, max: 1.0 });
        let rounding = 1e-6 * (p.length() + dir.length());
        prop_assert!(ray.at(1.0).distance(p + dir) <= rounding);
    }

    /// Strategies give what they promise: whole meshes, valid rays, bounded shapes, invertible transforms.
    #[test]
    fn strategies_keep_their_word((mesh, ray) in mesh(12).prop_flat_map(|m| { let rays = ray_at_mesh(&m); (Just(m), rays) }), shape in shape(), place in transform()) {
        prop_assert!(mesh.validate().is_ok() && !mesh.triangles.is_empty());
        prop_assert!(ray.is_valid());
        prop_assert!(shape.geometry().bounds().is_finite() && shape.geometry().area() > 0.0);
        prop_assert!(place.bounds(shape.geometry().bounds()).is_finite());
    }

    /// The nearest hit stays the nearest while the range ends at or behind it, and is gone when it ends before.
    #[test]
    fn meshes_are_hit_as_the_range_allows((mesh, ray) in closed_mesh().prop_flat_map(|m| { let rays = ray_at_mesh(&m); (Just(m), rays) })) {
        let nearest = |ray: &Ray| {
            let prepared = TriangleRay::new(ray);
            (0..mesh.triangles.len() as u32)
                .filter_map(|i| intersect(&prepared, ray.range, mesh.corners(i)))
                .map(|hit| hit.t)
                .reduce(f32::min)
        };
        if let Some(t) = nearest(&ray) {
            prop_assert!(t >= 0.0 && t.is_finite());
            prop_assert_eq!(nearest(&ray.until(t)), Some(t));
            prop_assert!(t == 0.0 || nearest(&ray.until(t.next_down())).is_none());
        }
    }
}
