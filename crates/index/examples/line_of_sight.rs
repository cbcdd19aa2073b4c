//! Line of sight: which of many points see each other over a landscape?
//!
//! A segment between two points is a ray with `t` in `[0, 1]`; two points see each other when nothing is hit. Run
//! with `cargo run -p heliostat-index --example line_of_sight`.

use glam::Vec3;
use heliostat_geometry::{Ray, TriMesh};
use heliostat_index::{BuildError, BuildParams, MeshTree};

/// Height of the hills.
fn height(x: f32, z: f32) -> f32 {
    6.0 * (0.13 * x).sin() * (0.11 * z).cos() + 2.0 * (0.31 * x + 0.23 * z).sin()
}

/// A square landscape of `n` by `n` cells of one metre.
fn landscape(n: u32) -> TriMesh {
    let row = n + 1;
    let at = |i: u32| {
        let (x, z) = ((i % row) as f32, (i / row) as f32);
        Vec3::new(x, height(x, z), z)
    };
    let cell = |i: u32| {
        let corner = i / n * row + i % n;
        [[corner, corner + row, corner + 1], [corner + 1, corner + row, corner + row + 1]]
    };
    TriMesh {
        positions: (0..row * row).map(at).collect(),
        triangles: (0..n * n).flat_map(cell).collect(),
        ..TriMesh::default()
    }
}

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), BuildError> {
    let hills = landscape(200);
    let tree = MeshTree::build(&hills, &BuildParams::BALANCED)?;

    // Towers of three metres on a grid.
    let tower = |i: u32| {
        let (x, z) = (5.0 + 19.0 * (i % 11) as f32, 5.0 + 19.0 * (i / 11) as f32);
        Vec3::new(x, height(x, z) + 3.0, z)
    };
    let towers: Vec<Vec3> = (0..121).map(tower).collect();

    let segment = |a: Vec3, b: Vec3| Ray::new(a, b - a).until(1.0);
    let sees = |a: usize, b: usize| !tree.any_hit(&segment(towers[a], towers[b]));
    let pairs = (0..towers.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    let (seen, all) = pairs.fold((0, 0), |(seen, all), (a, b)| (seen + u32::from(sees(a, b)), all + 1));
    println!("{seen} of {all} pairs of towers see each other over {} triangles", hills.triangles.len());

    // How much rock lies between two of them: the surface is crossed in and out.
    let mut crossings = Vec::new();
    tree.for_each_hit(&segment(towers[0], towers[120]), |hit| crossings.push(hit.hit.t));
    println!("the segment from the first to the last crosses the ground {} times", crossings.len());
    Ok(())
}
