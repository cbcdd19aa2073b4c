//! Queries: every back end that this processor has, on the tree that renders use, and every preset on the best back end.

use crate::meshes::Shape;
use crate::rays::{coherent, incoherent};
use divan::Bencher;
use divan::counter::ItemsCount;
use heliostat_geometry::Ray;
use heliostat_index::{Backend, BuildParams, MeshTree};
use std::fmt;

const TRIANGLES: usize = 200_000;

/// A tree to trace rays through.
#[derive(Clone, Copy, Debug)]
struct Case {
    shape: Shape,
    preset: &'static str,
    backend: Backend,
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}, {}", self.shape, self.preset, self.backend.name())
    }
}

fn cases() -> Vec<Case> {
    let each = |shape| {
        let back_ends = Backend::available().into_iter();
        let of_back_ends = back_ends.map(move |backend| Case { shape, preset: "balanced", backend });
        let others = BuildParams::NAMES.into_iter().filter(|&preset| preset != "balanced");
        of_back_ends.chain(others.map(move |preset| Case { shape, preset, backend: Backend::best() }))
    };
    [Shape::Hills, Shape::Needles].into_iter().flat_map(each).collect()
}

impl Case {
    fn tree(self) -> MeshTree {
        let params: BuildParams = self.preset.parse().expect("a preset");
        let tree = MeshTree::build(&self.shape.mesh(TRIANGLES), &params).expect("a tree");
        tree.with_backend(self.backend)
    }
}

#[divan::bench(args = cases(), sample_count = 10)]
fn closest_hit_coherent(bencher: Bencher<'_, '_>, case: Case) {
    trace(bencher, &coherent(256), case, |tree, ray| tree.closest_hit(ray).is_some());
}

#[divan::bench(args = cases(), sample_count = 10)]
fn closest_hit_incoherent(bencher: Bencher<'_, '_>, case: Case) {
    trace(bencher, &incoherent(1 << 16), case, |tree, ray| tree.closest_hit(ray).is_some());
}

#[divan::bench(args = cases(), sample_count = 10)]
fn any_hit_coherent(bencher: Bencher<'_, '_>, case: Case) {
    trace(bencher, &coherent(256), case, MeshTree::any_hit);
}

#[divan::bench(args = cases(), sample_count = 10)]
fn any_hit_incoherent(bencher: Bencher<'_, '_>, case: Case) {
    trace(bencher, &incoherent(1 << 16), case, MeshTree::any_hit);
}

/// Rays per second; an iteration traces all rays and counts those that hit.
fn trace(bencher: Bencher<'_, '_>, rays: &[Ray], case: Case, query: impl Fn(&MeshTree, &Ray) -> bool + Sync) {
    let tree = case.tree();
    bencher
        .counter(ItemsCount::new(rays.len()))
        .bench(|| rays.iter().filter(|ray| query(&tree, ray)).count());
}
