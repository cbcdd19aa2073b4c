//! Trees are the same, whatever the number of threads that build them.

#![cfg(feature = "parallel")]

use glam::Vec3;
use heliostat_geometry::TriMesh;
use heliostat_index::{BuildParams, MeshTree};

/// A sheet in waves with `2 * side * side` triangles: enough to cut in pieces and to graft subtrees.
fn sheet(side: u32) -> TriMesh {
    let corner = |i: u32| {
        let (x, z) = ((i % (side + 1)) as f32, (i / (side + 1)) as f32);
        Vec3::new(x, 9.0 * (0.11 * x).sin() * (0.07 * z + 0.02 * x).cos(), z)
    };
    let squares = (0..side * (side + 1)).filter(|i| i % (side + 1) != side);
    TriMesh {
        positions: (0..(side + 1) * (side + 1)).map(corner).collect(),
        triangles: squares
            .flat_map(|i| [[i, i + side + 1, i + 1], [i + 1, i + side + 1, i + side + 2]])
            .collect(),
        ..TriMesh::default()
    }
}

#[test]
fn threads_change_no_tree() {
    let mesh = sheet(150);
    let built = |threads: usize, params: &BuildParams| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| MeshTree::build(&mesh, params)).unwrap()
    };
    for params in [BuildParams::FAST, BuildParams::BALANCED] {
        let alone = built(1, &params);
        alone.tree().validate(&mesh).unwrap();
        // All but the seconds.
        let text = |tree: &MeshTree| {
            let is_number = |c: char| c.is_ascii_digit() || "e.-".contains(c);
            let text = format!("{tree:?}");
            text.split("build_seconds: ").map(|part| part.trim_start_matches(is_number)).collect::<String>()
        };
        assert!(text(&built(3, &params)) == text(&alone));
    }
}
