//! The exact test of many pairs says what the test of one says.

use glam::{Vec3, Vec3A};
use heliostat_geometry::Interval;
use heliostat_geometry::triangle::{TriangleRay, intersect, intersect_inside};
use heliostat_geometry::triangle_columns::{PAIRS, PairHits, Pairs};
use proptest::prelude::*;

fn vec3() -> impl Strategy<Value = Vec3> {
    // Often on a grid: rays through edges and corners, triangles without an area.
    let number = prop_oneof![-1.0_f32..1.0, (-2..3_i8).prop_map(|i| 0.5 * f32::from(i))];
    proptest::array::uniform3(number).prop_map(Vec3::from_array)
}

/// A ray with its main axis last, and a triangle.
fn pair() -> impl Strategy<Value = (TriangleRay, [Vec3; 3])> {
    (vec3(), vec3(), -0.99_f32..0.99, -0.99_f32..0.99, [vec3(), vec3(), vec3()]).prop_map(
        |(origin, dir, x, y, corners)| {
            let dir =
                if dir.z == 0.0 { Vec3A::new(x, y, -1.0) } else { Vec3A::new(x * dir.z, y * dir.z, dir.z) };
            (TriangleRay::from_turned(2, origin.into(), dir), corners)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn columns_say_what_one_says(all in prop::collection::vec(pair(), 1..=PAIRS)) {
        let (mut pairs, mut hits) = (Pairs::EMPTY, PairHits::EMPTY);
        for (i, (ray, corners)) in all.iter().enumerate() {
            for axis in 0..3 {
                pairs.origin[axis][i] = ray.origin()[axis];
                pairs.dir[axis][i] = ray.dir()[axis];
                for (to, corner) in pairs.corners[axis].iter_mut().zip(corners) {
                    to[i] = corner[axis];
                }
            }
        }
        hits.intersect(&pairs, all.len());
        for (i, (ray, corners)) in all.iter().enumerate().filter(|(i, _)| hits.is_sure[*i] != 0) {
            let hit = intersect_inside(ray, *corners).expect("it is sure");
            prop_assert_eq!((hit.t, hit.barycentric), (hits.t[i], hits.barycentric.map(|column| column[i])));
            let range = Interval { min: f32::NEG_INFINITY, max: f32::INFINITY };
            if let Some(whole) = intersect(ray, range, *corners) {
                prop_assert_eq!(whole, hit);
            }
        }
    }
}
