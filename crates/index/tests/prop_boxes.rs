//! Laws of the generic queries over primitives that are boxes: nested, touching, flat, of no size, and unbounded.

use glam::{DVec3, Vec3};
use heliostat_geometry::{Aabb, Interval, Ray};
use heliostat_index::{BruteForce, BspTree, BuildParams, Found, RayIndex};
use proptest::prelude::*;
use std::collections::BTreeSet;

const PRESETS: [BuildParams; 3] = [
    BuildParams::MIDPOINT,
    BuildParams::BALANCED,
    BuildParams { leaf_limit: 1, max_depth: 12, ..BuildParams::BALANCED },
];

fn config() -> ProptestConfig {
    ProptestConfig { failure_persistence: None, ..ProptestConfig::default() }
}

/// Where the ray enters a box, or leaves it when it starts inside; solved in `f64`, exact for boxes without
/// size, too.
fn enter(bounds: Aabb, ray: &Ray) -> Option<(f32, bool)> {
    let (origin, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
    let (low, high) = (bounds.min.as_dvec3() - origin, bounds.max.as_dvec3() - origin);
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        if dir[axis] == 0.0 {
            if low[axis] > 0.0 || high[axis] < 0.0 {
                return None;
            }
            continue;
        }
        let (a, b) = (low[axis] / dir[axis], high[axis] / dir[axis]);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    let t = |t: f64| Some(t as f32).filter(|&t| ray.range.contains(t));
    if near > far {
        return None;
    }
    t(near).map(|t| (t, true)).or_else(|| t(far).map(|t| (t, false)))
}

fn corner() -> impl Strategy<Value = Vec3> {
    prop_oneof![
        [-8_i8..9, -8_i8..9, -8_i8..9].prop_map(|p| Vec3::from_array(p.map(f32::from))),
        [-8.0_f32..8.0, -8.0_f32..8.0, -8.0_f32..8.0].prop_map(Vec3::from_array),
    ]
}

fn one_box() -> impl Strategy<Value = Aabb> {
    let side = prop_oneof![Just(0.0_f32), Just(1.0), 0.0_f32..0.5, 0.0_f32..16.0];
    (corner(), [side.clone(), side.clone(), side])
        .prop_map(|(min, size)| Aabb { min, max: min + Vec3::from_array(size) })
}

/// Boxes, some of which have no end in some direction.
fn boxes() -> impl Strategy<Value = Vec<Aabb>> {
    let unbounded = (one_box(), 0..3_usize, any::<bool>()).prop_map(|(mut bounds, axis, above)| {
        if above {
            bounds.max[axis] = f32::INFINITY;
        } else {
            bounds.min[axis] = f32::NEG_INFINITY;
        }
        bounds
    });
    let scale = prop_oneof![Just(1.0_f32), Just(1e-3), Just(1e5)];
    (prop::collection::vec(prop_oneof![20 => one_box(), 1 => unbounded], 0..80), scale).prop_map(
        |(boxes, scale)| boxes.into_iter().map(|b| Aabb { min: scale * b.min, max: scale * b.max }).collect(),
    )
}

/// A ray at the middle, a corner or a side of one of the boxes; often along an axis, often from inside.
fn ray_at(boxes: &[Aabb], (pick, from, to, kind): RaySeed) -> Ray {
    let finite: Vec<Aabb> = boxes.iter().copied().filter(|b| b.is_finite()).collect();
    let target = finite.get(pick % finite.len().max(1)).map_or(to, |b| match kind % 3 {
        0 => b.min,
        1 => b.centre(),
        _ => Vec3::new(b.max.x, b.min.y, b.centre().z),
    });
    let scale = finite.first().map_or(1.0, |b| b.max.abs().max_element().max(f32::MIN_POSITIVE));
    let axis = [Vec3::X, Vec3::NEG_Y, Vec3::Z][pick % 3];
    let (origin, dir) = match kind / 3 {
        0 => (scale * from, target - scale * from),
        1 => (target - 3.0 * scale * axis, axis),
        _ => (target, from),
    };
    let dir = if dir == Vec3::ZERO { axis } else { dir };
    let max = if pick % 5 == 0 { 1.0 } else { f32::INFINITY };
    Ray { origin, dir, range: Interval { min: 0.0, max } }
}

type RaySeed = (usize, Vec3, Vec3, u8);

fn seeds() -> impl Strategy<Value = Vec<RaySeed>> {
    prop::collection::vec((0..1000_usize, corner(), corner(), 0..9_u8), 24)
}

fn answers<I: RayIndex>(index: &I, boxes: &[Aabb], ray: &Ray) -> (Option<Found<bool>>, bool, BTreeSet<u32>) {
    let hit = |i: u32, ray: &Ray| enter(boxes[i as usize], ray);
    let mut visited = BTreeSet::new();
    let mut twice = false;
    index.for_each_hit(ray, |i| twice |= !visited.insert(i));
    assert!(!twice, "a primitive was visited twice");
    visited.retain(|&i| hit(i, ray).is_some());
    (index.closest_hit(ray, hit), index.any_hit(ray, |i, ray| hit(i, ray).is_some()), visited)
}

proptest! {
    #![proptest_config(config())]

    // All indices give the same three answers.
    #[test]
    fn all_indices_agree(boxes in boxes(), seeds in seeds()) {
        let truth = BruteForce::new(boxes.len() as u32);
        let trees = PRESETS.map(|params| BspTree::build(&boxes, &params).unwrap());
        #[cfg(feature = "reference")]
        let witness = heliostat_index::ReferenceBvh::build(&boxes).unwrap();
        for seed in seeds {
            let ray = ray_at(&boxes, seed);
            let expected = answers(&truth, &boxes, &ray);
            prop_assert_eq!(expected.1, expected.0.is_some());
            for tree in &trees {
                prop_assert_eq!(&answers(tree, &boxes, &ray), &expected, "{:?} {:?}", ray, tree.params());
            }
            #[cfg(feature = "reference")]
            prop_assert_eq!(&answers(&witness, &boxes, &ray), &expected, "{:?}", ray);
        }
    }

    #[test]
    fn every_tree_is_valid(boxes in boxes()) {
        for params in PRESETS {
            let tree = BspTree::build(&boxes, &params).unwrap();
            prop_assert_eq!(tree.validate(&boxes), Ok(()), "{:?}", params);
        }
    }

    // A planted box alone on its ray is found, at the planted distance, among boxes that keep away from the ray.
    #[test]
    fn a_planted_box_is_found(
        others in prop::collection::vec(one_box(), 0..60),
        at in 0..60_usize,
        distance in 1.0_f32..1000.0,
    ) {
        // The ray runs along x, at y = z = 100; the others stay below 24.
        let mut boxes = others;
        let at = at.min(boxes.len());
        let start = Vec3::new(-50.0, 100.0, 100.0);
        let near = start + Vec3::new(distance, -0.5, -0.25);
        boxes.insert(at, Aabb { min: near, max: near + Vec3::new(2.0, 1.0, 1.0) });
        let ray = Ray::new(start, Vec3::X);
        let planted = (DVec3::from(near).x - DVec3::from(start).x) as f32;
        for params in PRESETS {
            let tree = BspTree::build(&boxes, &params).unwrap();
            let found = tree.closest_hit(&ray, |i, ray| enter(boxes[i as usize], ray));
            prop_assert_eq!(found.map(|f| (f.primitive, f.t)), Some((at as u32, planted)));
        }
    }
}
