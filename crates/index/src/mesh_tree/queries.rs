//! The queries, as tasks for a back end.

use super::search::{Any, Each, Nearest};
use super::{MeshHit, MeshTree};
use crate::simd::{Lanes, Task};
use crate::wide::batch::{Question, walk_together};
use crate::wide::walk::{Counter, Uncounted, walk};
use heliostat_geometry::Ray;

/// The query for the nearest hit.
pub(super) struct Closest<'a, C> {
    pub(super) tree: &'a MeshTree,
    pub(super) ray: &'a Ray,
    pub(super) counter: &'a mut C,
}

impl<C: Counter> Task for Closest<'_, C> {
    type Output = Option<MeshHit>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Option<MeshHit> {
        let Self { tree, ray, counter } = self;
        let mut search = Nearest::new(lanes, tree, ray);
        walk(lanes, tree.tree.wide(), ray, ray.range.max, &mut search, counter);
        search.finish()
    }
}

/// The query for any hit.
pub(super) struct Occluded<'a> {
    pub(super) tree: &'a MeshTree,
    pub(super) ray: &'a Ray,
}

impl Task for Occluded<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> bool {
        let Self { tree, ray } = self;
        let mut search = Any::new(lanes, tree, ray);
        walk(lanes, tree.tree.wide(), ray, ray.range.max, &mut search, &mut Uncounted);
        search.found
    }
}

/// The query for the nearest hits of many rays.
pub(super) struct ManyClosest<'a> {
    pub(super) tree: &'a MeshTree,
    pub(super) rays: &'a [Ray],
    pub(super) hits: &'a mut Vec<Option<MeshHit>>,
}

impl Task for ManyClosest<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self, lanes: L) {
        walk_together(lanes, self.tree.tree.wide(), self.rays, &mut self);
    }
}

impl<'a> Question<'a> for ManyClosest<'a> {
    type Search = Nearest<'a>;

    #[inline(always)]
    fn start<L: Lanes>(&self, lanes: L, ray: &'a Ray) -> Nearest<'a> {
        Nearest::new(lanes, self.tree, ray)
    }

    #[inline(always)]
    fn finish(&mut self, search: &Nearest<'a>) {
        self.hits.push(search.finish());
    }
}

/// The query for any hit of many rays.
pub(super) struct ManyOccluded<'a> {
    pub(super) tree: &'a MeshTree,
    pub(super) rays: &'a [Ray],
    pub(super) hits: &'a mut Vec<bool>,
}

impl Task for ManyOccluded<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self, lanes: L) {
        walk_together(lanes, self.tree.tree.wide(), self.rays, &mut self);
    }
}

impl<'a> Question<'a> for ManyOccluded<'a> {
    type Search = Any<'a>;

    #[inline(always)]
    fn start<L: Lanes>(&self, lanes: L, ray: &'a Ray) -> Any<'a> {
        Any::new(lanes, self.tree, ray)
    }

    #[inline(always)]
    fn finish(&mut self, search: &Any<'a>) {
        self.hits.push(search.found);
    }
}

/// The query that shows all hits to a closure.
pub(super) struct Visit<'a, V> {
    pub(super) tree: &'a MeshTree,
    pub(super) ray: &'a Ray,
    pub(super) visit: V,
}

impl<V: FnMut(MeshHit)> Task for Visit<'_, V> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { tree, ray, visit } = self;
        let mut search = Each::new(lanes, tree, ray, visit);
        walk(lanes, tree.tree.wide(), ray, ray.range.max, &mut search, &mut Uncounted);
    }
}
