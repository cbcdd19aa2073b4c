//! The trees under the hostile strategies that the geometry crate shares with all crates.

use glam::Vec3;
use heliostat_geometry::strategies::{direction, displaced_sphere, mesh, ray_at_mesh};
use heliostat_geometry::{Ray, TriMesh};
use heliostat_index::mesh_tree::brute_force;
use heliostat_index::{BuildParams, MeshTree};
use proptest::prelude::*;

const PRESETS: [BuildParams; 2] = [BuildParams::MIDPOINT, BuildParams::BALANCED];

fn config() -> ProptestConfig {
    let usual = ProptestConfig::default();
    // Large meshes: fewer of them.
    ProptestConfig { failure_persistence: None, cases: usual.cases / 4, ..usual }
}

fn mesh_and_rays() -> impl Strategy<Value = (TriMesh, Vec<Ray>)> {
    mesh(40).prop_flat_map(|mesh| {
        let rays = prop::collection::vec(ray_at_mesh(&mesh), 24);
        (Just(mesh), rays)
    })
}

/// A bumpy ball, stretched and moved, with a point from which all of it is seen.
fn ball() -> impl Strategy<Value = (TriMesh, Vec3)> {
    let scale = prop_oneof![Just(Vec3::ONE), Just(Vec3::splat(1e-3)), Just(Vec3::new(1e5, 10.0, 300.0))];
    let shift = prop_oneof![Just(Vec3::ZERO), Just(Vec3::new(2.0, -0.5, 40.0))];
    (0_u32..5, 0.0_f32..0.4, any::<u64>(), scale, shift).prop_map(|(level, depth, seed, scale, shift)| {
        let mut mesh = displaced_sphere(level, depth, seed);
        for p in &mut mesh.positions {
            *p = scale * (*p + shift);
        }
        (mesh, scale * shift)
    })
}

proptest! {
    #![proptest_config(config())]

    // Brute force and both trees say the same, bit for bit.
    #[test]
    fn trees_find_what_brute_force_finds((mesh, rays) in mesh_and_rays()) {
        for params in PRESETS {
            let tree = MeshTree::build(&mesh, &params).unwrap();
            prop_assert_eq!(tree.tree().validate(&mesh), Ok(()));
            for ray in &rays {
                let truth = brute_force(&mesh, ray);
                prop_assert_eq!(tree.closest_hit(ray), truth, "{:?}", ray);
                prop_assert_eq!(tree.any_hit(ray), truth.is_some(), "{:?}", ray);
            }
        }
    }

    // No ray leaves a closed surface: not through a face, an edge or a vertex, nor along a split plane.
    #[test]
    fn no_ray_escapes_from_inside(
        (mesh, inside) in ball(),
        dirs in prop::collection::vec(direction(), 16),
        picks in prop::collection::vec((any::<prop::sample::Index>(), 0.0_f32..1.0), 16),
    ) {
        for params in PRESETS {
            let tree = MeshTree::build(&mesh, &params).unwrap();
            for (&dir, &(pick, along)) in dirs.iter().zip(&picks) {
                let [a, b, _] = mesh.corners(pick.index(mesh.triangles.len()) as u32);
                for dir in [dir, a - inside, a.lerp(b, along) - inside] {
                    let ray = Ray::new(inside, dir);
                    prop_assert!(tree.closest_hit(&ray).is_some(), "{:?} escapes", ray);
                    prop_assert!(tree.any_hit(&ray), "{:?} escapes", ray);
                }
            }
        }
    }
}
