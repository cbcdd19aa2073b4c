//! Laws of the watertight triangle: planted hits, shared edges, permutations, both sides.

use glam::{DVec3, Vec3};
use heliostat_geometry::triangle::{TriangleHit, TriangleRay, intersect};
use heliostat_geometry::{Interval, Ray};
use proptest::prelude::*;

fn vec3(scale: f32) -> impl Strategy<Value = Vec3> {
    [-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0].prop_map(move |v| scale * Vec3::from_array(v))
}

fn hit(ray: &Ray, corners: [Vec3; 3]) -> Option<TriangleHit> {
    intersect(&TriangleRay::new(ray), ray.range, corners)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, max_global_rejects: u32::MAX, ..ProptestConfig::default() })]

    /// A ray aimed at chosen weights inside a triangle hits there.
    #[test]
    fn planted_weights_are_found(
        exponent in -3..6_i32, shape in [vec3(1.0), vec3(1.0), vec3(1.0)], from in vec3(1.0), centre in vec3(1.0),
        x in 0.05_f64..0.95, y in 0.05_f64..0.95,
    ) {
        let scale = 10.0_f32.powi(exponent);
        let corners = shape.map(|p| scale * (p + centre));
        let [a, b, c] = corners.map(|p| p.as_dvec3());
        let weights = [1.0 - y, y * (1.0 - x), y * x];
        let target = weights[0] * a + weights[1] * b + weights[2] * c;
        let origin = 3.0 * scale * from;
        let ray = Ray::new(origin, (target - origin.as_dvec3()).as_vec3());
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let cosine = normal.dot(ray.dir.as_dvec3().normalize_or_zero()).abs();
        // The hit moves by the rounding of the ray over the cosine; stay where that is far below the weights.
        prop_assume!(cosine > 0.05 && (b - a).cross(c - a).length() > 0.05 * f64::from(scale).powi(2));
        let found = hit(&ray, corners);
        prop_assert!(found.is_some());
        let found = found.unwrap();
        // Rounding of direction and corners, u times the distance of about 4, over cosine and the size of the area.
        let tolerance = 1e-3;
        for (found, weight) in found.barycentric.iter().zip(weights) {
            prop_assert!((f64::from(*found) - weight).abs() < tolerance);
        }
        prop_assert!((f64::from(found.t) - 1.0).abs() < tolerance);
        let plane = f64::from(found.t) * normal.dot(ray.dir.as_dvec3()) - normal.dot(a - origin.as_dvec3());
        prop_assert!(plane.abs() <= 1e-6 * f64::from(scale), "t is of the plane: {plane}");
    }

    /// The order and the winding of the corners change nothing but the order of the weights.
    #[test]
    fn permuting_the_corners_keeps_the_hit(shape in [vec3(1.0), vec3(1.0), vec3(1.0)], from in vec3(3.0), to in vec3(0.5)) {
        let ray = Ray::new(from, to - from);
        let [a, b, c] = shape;
        let base = hit(&ray, [a, b, c]);
        for (corners, order) in [([b, c, a], [1, 2, 0]), ([c, a, b], [2, 0, 1]), ([c, b, a], [2, 1, 0]), ([a, c, b], [0, 2, 1])] {
            let other = hit(&ray, corners);
            prop_assert_eq!(base.is_some(), other.is_some());
            if let (Some(base), Some(other)) = (base, other) {
                prop_assert!((base.t - other.t).abs() <= f32::EPSILON * base.t);
                for (weight, k) in other.barycentric.into_iter().zip(order) {
                    prop_assert!((base.barycentric[k] - weight).abs() <= 4.0 * f32::EPSILON);
                }
            }
        }
    }

    /// A ray at the edge that two triangles of a tetrahedron share, from inside, is stopped by the tetrahedron.
    #[test]
    fn closed_shapes_do_not_leak(
        exponent in -6..7_i32, corners in [vec3(1.0), vec3(1.0), vec3(1.0), vec3(1.0)], offset in vec3(1e3),
        inside in [0.05_f32..1.0, 0.05_f32..1.0, 0.05_f32..1.0, 0.05_f32..1.0], along in 0.0_f32..1.0, edge in 0..6_usize, end in 0..8_usize,
    ) {
        let scale = 10.0_f32.powi(exponent);
        let corners = corners.map(|p| scale * (p + offset));
        let sum: f32 = inside.iter().sum();
        let origin = (0..4).map(|i| f64::from(inside[i] / sum) * corners[i].as_dvec3()).sum::<DVec3>().as_vec3();
        let [i, j] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]][edge];
        // Sometimes exactly at a vertex.
        let along = match end { 0 => 0.0, 1 => 1.0, _ => along };
        let target = corners[i].lerp(corners[j], along);
        let volume = (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]);
        prop_assume!(volume.abs() > 0.05 * scale.powi(3) && target != origin);
        let ray = Ray::new(origin, target - origin);
        let faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]];
        prop_assert!(faces.iter().any(|f| hit(&ray, f.map(|v| corners[v])).is_some()));
    }

    /// Nothing but finite triangles with area is hit, and nothing panics.
    #[test]
    fn hostile_numbers_give_none_or_a_sane_hit(bits in proptest::array::uniform32(any::<u32>())) {
        let f = |i: usize| f32::from_bits(bits[i]);
        let v = |i: usize| Vec3::new(f(i), f(i + 1), f(i + 2));
        let ray = Ray { origin: v(0), dir: v(3), range: Interval { min: f(6), max: f(7) } };
        if let Some(hit) = hit(&ray, [v(8), v(11), v(14)]) {
            prop_assert!(hit.t.is_finite() && ray.range.contains(hit.t));
            prop_assert!(hit.barycentric.iter().all(|w| (0.0..=1.0).contains(w)));
        }
    }
}
