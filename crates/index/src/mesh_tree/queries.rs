//! The queries, as tasks for a back end.

use super::many::{Ask, Many};
use super::search::{Any, Each, Nearest};
use super::{MeshHit, MeshTree};
use crate::simd::{Lanes, Task};
use crate::wide::batch::walk_together;
use crate::wide::walk::{Counter, Uncounted, walk};
use heliostat_geometry::Ray;
use std::marker::PhantomData;

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

/// A query for many rays.
pub(super) struct OfMany<'a, A> {
    pub(super) tree: &'a MeshTree,
    pub(super) rays: &'a [Ray],
    pub(super) ask: PhantomData<A>,
}

impl<A: Ask> Task for OfMany<'_, A> {
    type Output = Vec<A::Answer>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Vec<A::Answer> {
        let mut many = Many::<A>::new(self.tree, self.rays.len());
        walk_together(lanes, self.tree.tree.wide(), self.rays, &mut many);
        many.answers
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
