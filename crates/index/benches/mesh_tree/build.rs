//! Building, by every preset.

use crate::meshes::Shape;
use divan::Bencher;
use divan::counter::ItemsCount;
use heliostat_index::{BuildParams, MeshTree};

const TRIANGLES: usize = 50_000;

#[divan::bench(args = BuildParams::NAMES, sample_count = 10)]
fn hills(bencher: Bencher<'_, '_>, preset: &str) {
    build(bencher, Shape::Hills, preset);
}

#[divan::bench(args = BuildParams::NAMES, sample_count = 10)]
fn needles(bencher: Bencher<'_, '_>, preset: &str) {
    build(bencher, Shape::Needles, preset);
}

/// Triangles per second.
fn build(bencher: Bencher<'_, '_>, shape: Shape, preset: &str) {
    let mesh = shape.mesh(TRIANGLES);
    let params: BuildParams = preset.parse().expect("a preset");
    bencher
        .counter(ItemsCount::new(mesh.triangles.len()))
        .bench(|| MeshTree::build(&mesh, &params).expect("a tree"));
}
