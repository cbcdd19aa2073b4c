//! The trees against brute force on real models.
//!
//! `HELIOSTAT_DEEP=N` traces N rays through each mesh instead of a few hundred.

#![expect(clippy::unwrap_used, reason = "tests fail by panicking")]

mod support;

use glam::Vec3;
use heliostat_geometry::strategies::Random;
use heliostat_geometry::{Ray, TriMesh};
use heliostat_index::verify::{Agreement, Verifier};
use heliostat_index::{Backend, BuildParams, MeshTree};

const PRESETS: [(&str, BuildParams); 2] =
    [("midpoint", BuildParams::MIDPOINT), ("balanced", BuildParams::BALANCED)];

fn rays(fewer: u64) -> u64 {
    std::env::var("HELIOSTAT_DEEP").ok().and_then(|n| n.parse().ok()).unwrap_or(fewer)
}

#[test]
fn trees_agree_with_brute_force_on_every_model() {
    for path in support::obj_files() {
        let mesh = support::read_obj(&path);
        if mesh.triangles.is_empty() {
            continue;
        }
        let verifier = Verifier::new(&mesh, &PRESETS).unwrap();
        let agreement = run(&verifier, rays(200));
        let name = path.display();
        assert!(agreement.hits > agreement.rays / 20, "{name}: too few rays meet it: {}", agreement.hits);
        assert_eq!(agreement.disagreements, [], "{name}");
    }
}

/// On two threads when there is much to do.
fn run(verifier: &Verifier<'_>, rays: u64) -> Agreement {
    let middle = rays / 2;
    std::thread::scope(|scope| {
        let second = scope.spawn(|| verifier.run(middle..rays, 1));
        let mut agreement = verifier.run(0..middle, 1);
        agreement.merge(second.join().unwrap());
        agreement
    })
}

#[test]
fn trees_of_every_model_are_valid_and_bounded() {
    for path in support::obj_files() {
        let mesh = support::read_obj(&path);
        // Clipping every triangle against every leaf takes its time.
        if mesh.triangles.len() as u64 > rays(30_000) {
            continue;
        }
        for (preset, params) in PRESETS {
            let tree = MeshTree::build(&mesh, &params).unwrap();
            tree.tree().validate(&mesh).unwrap();
            let stats = tree.tree().stats();
            let most = f64::from(params.max_duplication) * mesh.triangles.len() as f64 + 64.0;
            assert!(stats.references as f64 <= most, "{} {preset}: {stats:?}", path.display());
        }
    }
}

/// Points that rays in every direction leave through an odd number of triangles.
fn points_inside(mesh: &TriMesh, tree: &MeshTree, random: &mut Random, count: usize) -> Vec<Vec3> {
    let bounds = mesh.bounds();
    let is_inside = |p: Vec3| {
        let crossings = |dir: Vec3| {
            let mut crossings = 0;
            tree.for_each_hit(&Ray::new(p, dir), |_| crossings += 1);
            crossings
        };
        [Vec3::X, Vec3::NEG_Y, Vec3::new(0.3, 0.5, -0.8)].into_iter().all(|dir| crossings(dir) % 2 == 1)
    };
    std::iter::repeat_with(|| bounds.centre() + 0.5 * random.cube() * bounds.size())
        .filter(|&p| is_inside(p))
        .take(count)
        .collect()
}

#[test]
fn no_ray_leaves_a_closed_mesh() {
    let Some(path) = support::obj_files().into_iter().find(|path| path.ends_with("horse.obj")) else {
        return;
    };
    let mesh = support::read_obj(&path);
    let each = rays(2000);
    for backend in Backend::available() {
        let tree = MeshTree::build(&mesh, &BuildParams::BALANCED).unwrap().with_backend(backend);
        let mut random = Random::new(7);
        let inside = points_inside(&mesh, &tree, &mut random, 64);
        for i in 0..each {
            let origin = inside[i as usize % inside.len()];
            let [a, b, c] = mesh.corners(random.below(mesh.triangles.len()) as u32);
            let (u, v) = (random.unit(), random.unit());
            let along_edge = a.lerp(b, u);
            let rays = [a - origin, along_edge - origin, along_edge.lerp(c, v) - origin, random.direction()]
                .map(|dir| Ray::new(origin, dir));
            for ray in &rays {
                assert!(tree.any_hit(ray) && tree.closest_hit(ray).is_some(), "{} {ray:?}", backend.name());
            }
            assert!(tree.any_hits(&rays).iter().all(|hit| *hit), "{} {rays:?}", backend.name());
            assert!(tree.closest_hits(&rays).iter().all(Option::is_some), "{} {rays:?}", backend.name());
        }
    }
}
