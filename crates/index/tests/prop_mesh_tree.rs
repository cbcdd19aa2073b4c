//! Laws of the mesh tree over hostile meshes, for every preset.

#[path = "support/hostile.rs"]
mod hostile;

use heliostat_geometry::triangle::{TriangleRay, intersect};
use heliostat_geometry::{Interval, Ray, TriMesh};
use heliostat_index::mesh_tree::brute_force;
use heliostat_index::{Backend, BspTree, BuildParams, MeshHit, MeshTree, RayIndex, TraversalCost};
use hostile::{RaySeed, mesh, ray_seed};
use proptest::prelude::*;

const PRESETS: [BuildParams; 5] = [
    BuildParams::MIDPOINT,
    BuildParams::FAST,
    BuildParams::BALANCED,
    BuildParams { clip: false, leaf_limit: 1, ..BuildParams::MIDPOINT },
    BuildParams { leaf_limit: 1, ..BuildParams::BEST },
];

fn config() -> ProptestConfig {
    ProptestConfig { failure_persistence: None, ..ProptestConfig::default() }
}

fn scene() -> impl Strategy<Value = (TriMesh, Vec<RaySeed>)> {
    (mesh(), prop::collection::vec(ray_seed(), 24))
}

/// Every hit of a ray, by triangle.
fn all_hits(mesh: &TriMesh, ray: &Ray) -> Vec<MeshHit> {
    let sheared = TriangleRay::new(ray);
    let hit = |i| intersect(&sheared, ray.range, mesh.corners(i)).map(|hit| MeshHit { triangle: i, hit });
    (0..mesh.triangles.len() as u32).filter_map(hit).collect()
}

proptest! {
    #![proptest_config(config())]

    // closest_hit = brute force, bit for bit; any_hit iff there is one; for_each_hit = all hits, each once.
    #[test]
    fn tree_finds_what_brute_force_finds((mesh, seeds) in scene()) {
        for params in &PRESETS {
            let tree = MeshTree::build(&mesh, params).unwrap();
            for seed in &seeds {
                let ray = seed.fit(&mesh);
                let truth = brute_force(&mesh, &ray);
                prop_assert_eq!(tree.closest_hit(&ray), truth, "{:?} {:?}", ray, params);
                prop_assert_eq!(tree.any_hit(&ray), truth.is_some(), "{:?} {:?}", ray, params);

                let mut hits = Vec::new();
                tree.for_each_hit(&ray, |hit| hits.push(hit));
                hits.sort_by_key(|hit| hit.triangle);
                prop_assert_eq!(hits, all_hits(&mesh, &ray), "{:?} {:?}", ray, params);
            }
        }
    }

    // The generic queries give the same answers, over a tree of their own and over the one inside, and count their work.
    #[test]
    fn generic_queries_agree_with_the_fast_path((mesh, seeds) in scene()) {
        for params in &PRESETS {
            let fast = MeshTree::build(&mesh, params).unwrap();
            let own = BspTree::build(&mesh, params).unwrap();
            for tree in [fast.tree(), &own] {
                for seed in &seeds {
                    let ray = seed.fit(&mesh);
                    let sheared = TriangleRay::new(&ray);
                    let closure =
                        |i, ray: &Ray| intersect(&sheared, ray.range, mesh.corners(i)).map(|hit| (hit.t, hit));
                    let mut cost = TraversalCost::default();
                    let found = tree.closest_hit_counted(&ray, closure, &mut cost);
                    prop_assert_eq!(found, tree.closest_hit(&ray, closure));
                    prop_assert!(found.is_none() || (cost.nodes > 0 && cost.leaves > 0 && cost.tests > 0));

                    let found = found.map(|f| MeshHit { triangle: f.primitive, hit: f.data });
                    let mut cost = TraversalCost::default();
                    prop_assert_eq!(fast.closest_hit_counted(&ray, &mut cost), found);
                    prop_assert!(found.is_none() || (cost.nodes > 0 && cost.leaves > 0 && cost.tests > 0));
                }
            }
        }
    }

    // Every back end finds what plain arrays find, bit for bit.
    #[test]
    fn back_ends_agree((mesh, seeds) in scene()) {
        let tree = MeshTree::build(&mesh, &BuildParams::BALANCED).unwrap();
        let twin = tree.clone().with_backend(Backend::PORTABLE);
        for backend in Backend::available() {
            let tree = tree.clone().with_backend(backend);
            for seed in &seeds {
                let ray = seed.fit(&mesh);
                prop_assert_eq!(tree.closest_hit(&ray), twin.closest_hit(&ray), "{} {:?}", backend.name(), ray);
                prop_assert_eq!(tree.any_hit(&ray), twin.any_hit(&ray), "{} {:?}", backend.name(), ray);
                let all = |tree: &MeshTree| {
                    let mut hits = Vec::new();
                    tree.for_each_hit(&ray, |hit| hits.push(hit));
                    hits.sort_by_key(|hit| hit.triangle);
                    hits
                };
                prop_assert_eq!(all(&tree), all(&twin), "{} {:?}", backend.name(), ray);
            }
        }
    }

    // Many rays at once find what each finds alone, in their order, also when there are more than take turns together.
    #[test]
    fn many_rays_find_what_each_finds((mesh, seeds) in scene(), times in 1..9_usize) {
        let tree = MeshTree::build(&mesh, &BuildParams::BALANCED).unwrap();
        let rays: Vec<Ray> = seeds.iter().map(|seed| seed.fit(&mesh)).collect::<Vec<_>>().repeat(times);
        let closest: Vec<_> = rays.iter().map(|ray| tree.closest_hit(ray)).collect();
        let any: Vec<_> = rays.iter().map(|ray| tree.any_hit(ray)).collect();
        for backend in Backend::available() {
            let tree = tree.clone().with_backend(backend);
            prop_assert_eq!(&tree.closest_hits(&rays), &closest, "{}", backend.name());
            prop_assert_eq!(&tree.any_hits(&rays), &any, "{}", backend.name());
        }
    }

    // A promise is a promise, whatever is built.
    #[test]
    fn every_tree_is_valid(mesh in mesh()) {
        for params in &PRESETS {
            let tree = BspTree::build(&mesh, params).unwrap();
            prop_assert_eq!(tree.validate(&mesh), Ok(()), "{:?}", params);
            prop_assert!(tree.stats().depth <= params.max_depth);
        }
    }

    // A range that ends at the nearest hit keeps it; one that ends just before loses it; one that begins behind
    // it gives the next.
    #[test]
    fn distance_grows_as_the_range_shrinks((mesh, seeds) in scene()) {
        let tree = MeshTree::build(&mesh, &BuildParams::BALANCED).unwrap();
        for seed in &seeds {
            let ray = seed.fit(&mesh);
            let Some(first) = tree.closest_hit(&ray) else { continue };
            let range = ray.range;
            let at = |range: Interval| tree.closest_hit(&Ray { range, ..ray });
            prop_assert_eq!(at(Interval { max: first.hit.t, ..range }), Some(first));
            prop_assert_eq!(at(Interval { max: first.hit.t.next_down(), ..range }), None);
            let next = at(Interval { min: first.hit.t.next_up(), ..range });
            prop_assert!(next.is_none_or(|next| next.hit.t > first.hit.t));
        }
    }

    // Distances do not depend on the order of the triangles, nor on how often each is there.
    #[test]
    fn order_and_copies_change_no_distance((mesh, seeds) in scene()) {
        let mut changed = mesh.clone();
        changed.triangles.reverse();
        changed.triangles.extend_from_slice(&mesh.triangles);
        for params in &PRESETS {
            let tree = MeshTree::build(&mesh, params).unwrap();
            let other = MeshTree::build(&changed, params).unwrap();
            for seed in &seeds {
                let ray = seed.fit(&mesh);
                let t = |tree: &MeshTree| tree.closest_hit(&ray).map(|hit| hit.hit.t);
                prop_assert_eq!(t(&tree), t(&other), "{:?}", ray);
            }
        }
    }
}

#[cfg(feature = "reference")]
proptest! {
    #![proptest_config(config())]

    // The witness, written by others, says the same.
    #[test]
    fn obvhs_finds_what_brute_force_finds((mesh, seeds) in scene()) {
        let witness = heliostat_index::ReferenceBvh::build(&mesh).unwrap();
        for seed in &seeds {
            let ray = seed.fit(&mesh);
            let sheared = TriangleRay::new(&ray);
            let closure =
                |i, ray: &Ray| intersect(&sheared, ray.range, mesh.corners(i)).map(|hit| (hit.t, hit));
            let found = witness.closest_hit(&ray, closure);
            let truth = brute_force(&mesh, &ray);
            prop_assert_eq!(found.map(|f| MeshHit { triangle: f.primitive, hit: f.data }), truth, "{:?}", ray);
            prop_assert_eq!(witness.any_hit(&ray, |i, ray| closure(i, ray).is_some()), truth.is_some());
        }
    }
}
