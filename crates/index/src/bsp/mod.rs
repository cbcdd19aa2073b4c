//! The BSP tree: axis-aligned planes cut the box around all primitives into disjoint cells.
//!
//! A node is a plane with two children, or a leaf with a run of references to primitives. The cells of the
//! leaves tile the box of the root exactly; a primitive is named by every leaf whose cell it meets. Cells are
//! not stored: they follow from the planes on the way down.
//!
//! # Reading order
//!
//! [`params`] says how a tree is built; `build` does it, cell by cell, with the planes that `sah` or `split` choose.
//! Rays walk another form of the tree, made at the end of the build: `wide`. [`stats`], [`validate`] and [`export`] look
//! at the result.

pub(crate) mod build;
pub mod export;
pub(crate) mod node;
pub mod params;
mod split;
pub mod stats;
pub mod validate;
pub(crate) mod visited;

pub use export::{ExportWhat, export_obj};
pub use params::{BuildError, BuildParams, SahCosts, SplitRule};
pub use stats::TreeStats;
pub use validate::InvalidTree;

use crate::primitives::Primitives;
use crate::query::{Found, Nearest, RayIndex};
use crate::simd::{Backend, Lanes, Task};
use crate::wide::Wide;
use crate::wide::walk::{Counter, Search, TraversalCost, Uncounted, walk};
use build::{Blur, LeafLayout};
use heliostat_geometry::{Aabb, Ray};
use node::{Kind, Node};
use std::ops::Range;
use visited::{Mailbox, Visited};

/// A binary space partition over primitives that it knows by id.
#[derive(Clone, Debug)]
pub struct BspTree {
    /// The root comes first; children lie side by side.
    nodes: Vec<Node>,
    /// Primitive ids, leaf by leaf.
    leaf_refs: Vec<u32>,
    /// What rays walk.
    wide: Wide,
    /// Primitives with infinite boxes: every query tests them.
    unbounded: Vec<u32>,
    /// The root's cell: around all bounded primitives.
    bounds: Aabb,
    /// How sizes and coordinates blur what a cell holds.
    blur: Blur,
    depth: u32,
    params: BuildParams,
    layout: LeafLayout,
    backend: Backend,
    primitives: u32,
    build_seconds: f64,
}

/// A node with its cell, met on a tour of the tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) kind: Kind,
    pub(crate) cell: Aabb,
    pub(crate) depth: u32,
}

impl BspTree {
    /// Builds a tree over all primitives.
    ///
    /// # Errors
    /// When a primitive has an empty or NaN box, a setting is out of range, or there is more than ids can name.
    pub fn build<P: Primitives + ?Sized>(primitives: &P, params: &BuildParams) -> Result<Self, BuildError> {
        build::build(primitives, params, LeafLayout::SINGLE)
    }

    /// The box around all primitives whose boxes are finite, grown by rounding where one is much larger than the
    /// others; empty when there are none.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Ids of the primitives outside the tree, because their boxes are infinite.
    pub fn unbounded(&self) -> &[u32] {
        &self.unbounded
    }

    /// The settings it was built with.
    pub fn params(&self) -> &BuildParams {
        &self.params
    }

    /// [`RayIndex::closest_hit`] that adds its work to `cost`.
    pub fn closest_hit_counted<T>(
        &self,
        ray: &Ray,
        hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
        cost: &mut TraversalCost,
    ) -> Option<Found<T>> {
        cost.tests += self.unbounded.len() as u64;
        self.closest(ray, hit, cost)
    }

    /// The same tree, walked by another back end.
    #[must_use]
    pub fn with_backend(self, backend: Backend) -> Self {
        Self { backend, ..self }
    }

    /// Primitive ids, leaf by leaf, in whole groups.
    pub(crate) fn leaf_refs(&self) -> &[u32] {
        &self.leaf_refs
    }

    /// What rays walk.
    pub(crate) fn wide(&self) -> &Wide {
        &self.wide
    }

    pub(crate) fn backend(&self) -> Backend {
        self.backend
    }

    /// Shows `visit` the references of all leaves on the way of a ray; it answers up to which distance hits still matter.
    #[inline]
    fn walk(&self, ray: &Ray, limit: f32, counter: &mut impl Counter, visit: impl FnMut(&[u32]) -> f32) {
        self.backend.run(Visit { ray, limit, leaves: Leaves { tree: self, visit }, counter });
    }

    /// Places of the references of a leaf by what its wide child says, those included that fill the last group.
    fn range_of(&self, leaf: u32) -> Range<usize> {
        let (first, count) = match (self.layout.group, self.nodes.get(leaf as usize).map(|node| node.kind()))
        {
            (1, Some(Kind::Leaf { first, count })) => (first as usize, count as usize),
            (group, _) => (group * (leaf & 0xFF_FFFF) as usize, group * (leaf >> 24) as usize),
        };
        first..first + count
    }

    fn closest<T>(
        &self,
        ray: &Ray,
        mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
        counter: &mut impl Counter,
    ) -> Option<Found<T>> {
        let mut nearest = Nearest::new(ray);
        for &primitive in &self.unbounded {
            nearest.test(primitive, &mut hit);
        }
        let mut mailbox = Mailbox::new();
        self.walk(ray, nearest.ray.range.max, counter, |refs| {
            for &primitive in refs {
                if mailbox.is_new(primitive) {
                    nearest.test(primitive, &mut hit);
                }
            }
            nearest.ray.range.max
        });
        nearest.found
    }

    /// Every node, parents before children, left before right. Stops at a node that is its own ancestor.
    pub(crate) fn places(&self) -> impl Iterator<Item = Place> {
        let mut pending = vec![(0_u32, self.bounds, 0_u32)];
        std::iter::from_fn(move || {
            let (index, cell, depth) = pending.pop()?;
            let kind = self.nodes.get(index as usize)?.kind();
            if let Kind::Inner { axis, split, left } = kind {
                let plane = split::Plane { axis, position: split };
                let (below, above) = plane.cut(cell);
                pending.push((left + 1, above, depth + 1));
                pending.push((left, below, depth + 1));
            }
            Some(Place { kind, cell, depth })
        })
    }
}

/// Shows references to a closure.
struct Leaves<'t, F> {
    tree: &'t BspTree,
    visit: F,
}

/// A walk that shows references to a closure.
struct Visit<'a, F, C> {
    ray: &'a Ray,
    limit: f32,
    leaves: Leaves<'a, F>,
    counter: &'a mut C,
}

impl<F: FnMut(&[u32]) -> f32, C: Counter> Task for Visit<'_, F, C> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self, lanes: L) {
        let wide = &self.leaves.tree.wide;
        walk(lanes, wide, self.ray, self.limit, &mut self.leaves, self.counter);
    }
}

impl<F: FnMut(&[u32]) -> f32> Search for Leaves<'_, F> {
    const SHORTENS: bool = true;

    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, _lanes: L, leaf: u32, counter: &mut impl Counter) -> f32 {
        let refs = &self.tree.leaf_refs[self.tree.range_of(leaf)];
        counter.leaf(refs.len());
        (self.visit)(refs)
    }
}

impl RayIndex for BspTree {
    fn closest_hit<T>(&self, ray: &Ray, hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>) -> Option<Found<T>> {
        self.closest(ray, hit, &mut Uncounted)
    }

    fn any_hit(&self, ray: &Ray, mut hit: impl FnMut(u32, &Ray) -> bool) -> bool {
        if self.unbounded.iter().any(|&primitive| hit(primitive, ray)) {
            return true;
        }
        let mut mailbox = Mailbox::new();
        let mut found = false;
        self.walk(ray, ray.range.max, &mut Uncounted, |refs| {
            found = found || refs.iter().any(|&primitive| mailbox.is_new(primitive) && hit(primitive, ray));
            // Nothing lies before minus infinity: that ends the walk.
            if found { f32::NEG_INFINITY } else { ray.range.max }
        });
        found
    }

    fn for_each_hit(&self, ray: &Ray, mut visit: impl FnMut(u32)) {
        self.unbounded.iter().for_each(|&primitive| visit(primitive));
        let mut visited = Visited::new();
        self.walk(ray, ray.range.max, &mut Uncounted, |refs| {
            for &primitive in refs {
                if visited.insert(primitive) {
                    visit(primitive);
                }
            }
            ray.range.max
        });
    }
}
