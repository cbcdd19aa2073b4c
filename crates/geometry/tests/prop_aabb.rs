//! Laws of axis-aligned boxes.

use glam::Vec3;
use heliostat_geometry::strategies::{direction, extent, hostile_float, point, ray_in_box};
use heliostat_geometry::{Aabb, Ray};
use proptest::prelude::*;

fn aabb() -> impl Strategy<Value = Aabb> {
    (point(), [extent(), extent(), extent()])
        .prop_map(|(min, size)| Aabb { min, max: min + Vec3::from_array(size) })
}

fn hostile_point() -> impl Strategy<Value = Vec3> {
    [hostile_float(), hostile_float(), hostile_float()].prop_map(Vec3::from_array)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, max_global_rejects: u32::MAX, ..ProptestConfig::default() })]

    /// A union holds both, an intersection lies in both, and the empty box is neutral.
    #[test]
    fn union_and_intersection_are_bounds(a in aabb(), b in aabb(), p in hostile_point()) {
        let union = a.union(b);
        prop_assert!(union.contains_box(a) && union.contains_box(b));
        prop_assert_eq!(a.union(Aabb::EMPTY), a);
        prop_assert!(a.intersect(Aabb::EMPTY).is_empty());
        prop_assert_eq!(a.contains(p) && b.contains(p), a.intersect(b).contains(p));
        prop_assert!(a.grow(p).contains(p) && a.grow(p).contains_box(a));
    }

    /// The area is the sum of the faces, the volume the product of the sides; sides differ.
    #[test]
    fn area_and_volume_follow_the_sides(min in point(), x in 1_u8..9, y in 1_u8..9, z in 1_u8..9) {
        // Whole lengths at a whole place, so that the sides are exact.
        let min = min.round();
        let [x, y, z] = [x, y, z].map(f32::from);
        let a = Aabb { min, max: min + Vec3::new(x, y, z) };
        prop_assert_eq!(a.surface_area(), f64::from(x * y + x * y + y * z + y * z + z * x + z * x));
        prop_assert_eq!(a.volume(), f64::from(x * y * z));
        prop_assert_eq!(a.size()[a.longest_axis()], x.max(y).max(z));
        prop_assert!(a.corners().iter().all(|&c| a.contains(c)));
        prop_assert_eq!(Aabb::of_points(a.corners()), a);
    }

    /// Points of the ray that lie in the box lie in the clipped range.
    #[test]
    fn clip_loses_no_point_inside((a, ray) in aabb().prop_flat_map(|a| (Just(a), ray_in_box(a))), s in 0.0_f32..1.0) {
        let clipped = a.clip(&ray);
        // Parameters at which the ray can be near the box, some of them inside.
        let reach = ((ray.origin - a.centre()).length() + a.radius()) / ray.dir.length();
        for i in 0..64 {
            let t = reach * (i as f32 + s) / 64.0;
            // In `f64`: a point computed in `f32` may be rounded into the box.
            let p = ray.origin.as_dvec3() + f64::from(t) * ray.dir.as_dvec3();
            if p.cmpge(a.min.as_dvec3()).all() && p.cmple(a.max.as_dvec3()).all() {
                prop_assert!(clipped.is_some_and(|range| range.contains(t)), "{t} in {clipped:?}");
            }
        }
    }

    /// A clipped range is no longer than the box, up to rounding: the box is not simply everything.
    #[test]
    fn clip_keeps_little_more_than_the_box(a in aabb(), from in point(), dir in direction()) {
        let ray = Ray::new(from, dir);
        if let Some(range) = a.clip(&ray) {
            let slack = 1e-5 * (from.length() + a.min.length() + a.max.length());
            for t in [range.min, range.max].into_iter().filter(|t| t.is_finite()) {
                let p = ray.origin.as_dvec3() + f64::from(t) * ray.dir.as_dvec3();
                let q = p.clamp(a.min.as_dvec3(), a.max.as_dvec3());
                prop_assert!(p.distance(q) <= f64::from(slack) || range.min == 0.0, "{t}: {p}");
            }
        }
    }

    /// A ray in the plane of a face is inside, one step beside it is outside.
    #[test]
    fn rays_along_a_face_count_as_inside(a in aabb(), axis in 0_usize..3, s in 0.0_f32..1.0, t in 0.0_f32..1.0) {
        let mut dir = Vec3::ZERO;
        dir[(axis + 1) % 3] = 1.0;
        let mut on = a.min.lerp(a.max, s);
        on[(axis + 2) % 3] = a.min.lerp(a.max, t)[(axis + 2) % 3].clamp(a.min[(axis + 2) % 3], a.max[(axis + 2) % 3]);
        on[(axis + 1) % 3] = a.min[(axis + 1) % 3] - 1.0;
        for (face, beside) in [(a.min[axis], a.min[axis].next_down()), (a.max[axis], a.max[axis].next_up())] {
            let mut origin = on;
            origin[axis] = face;
            prop_assert!(a.clip(&Ray::new(origin, dir)).is_some());
            origin[axis] = beside;
            prop_assert!(a.clip(&Ray::new(origin, dir)).is_none());
        }
    }

    /// Nothing panics, and empty boxes are never hit.
    #[test]
    fn hostile_boxes_are_harmless(min in hostile_point(), max in hostile_point(), from in hostile_point(), dir in direction()) {
        let a = Aabb { min, max };
        let clipped = a.clip(&Ray::new(from, dir));
        prop_assert!(!a.is_empty() || clipped.is_none() || a.size().min_element() < 0.0);
        prop_assert!(Aabb::EMPTY.clip(&Ray::new(from, dir)).is_none());
        prop_assert!(clipped.is_none_or(|range| !range.is_empty()));
    }
}
