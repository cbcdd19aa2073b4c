//! The walk of many rays at once, in turns.
//!
//! One ray alone spends much of its time waiting: for the node it has just chosen, and for what was wrongly guessed to come
//! next. Here all rays of a batch go on to their next node before the first has its turn again, and what a ray does next is
//! noted in a list instead of branched on. First all rays walk until they stand at a leaf, then they search it.
//!
//! # Source
//! Barringer and Akenine-Möller, "Dynamic Ray Stream Traversal", SIGGRAPH 2014 (lists of rays instead of packets).

use super::ray::BoxRay;
use super::walk::{Boxes, Meet, Search, Sides, Uncounted, walk};
use super::{LEAF, Wide};
use crate::simd::{END, Lanes, Pending, StackRoom};
use heliostat_geometry::Ray;

/// So many rays take turns: enough to hide how long one waits, few enough to stay in the nearest cache.
const TOGETHER: usize = 32;

/// What is asked of all rays of a batch.
pub(crate) trait Question<'a> {
    type Search: Search;

    /// Starts the search for one ray.
    fn start<L: Lanes>(&self, lanes: L, ray: &'a Ray) -> Self::Search;

    /// Takes what came of it; for the rays in their order.
    fn finish(&mut self, search: &Self::Search);
}

/// A ray on its way.
struct Walker<'r, L: Lanes + 'r, S> {
    boxes: Boxes<L>,
    stack: L::Stack<'r>,
    search: S,
    /// Up to which distance hits matter.
    limit: f32,
    /// Where it goes next.
    child: u32,
}

/// Numbers of rays, in order.
struct List {
    rays: [u8; TOGETHER],
    len: usize,
}

impl List {
    const EMPTY: Self = Self { rays: [0; TOGETHER], len: 0 };

    /// Adds a ray, or does not: without a branch.
    #[inline(always)]
    fn add(&mut self, ray: u8, counts: bool) {
        self.rays[self.len % TOGETHER] = ray;
        self.len += usize::from(counts);
    }
}

/// Walks the leaves that each of the rays meets.
#[inline(always)]
pub(crate) fn walk_together<'a, L: Lanes, Q: Question<'a>>(
    lanes: L,
    wide: &Wide,
    rays: &'a [Ray],
    question: &mut Q,
) {
    let mut rooms = [const { StackRoom::new() }; TOGETHER];
    let mut walkers: Vec<Walker<'_, L, Q::Search>> = Vec::with_capacity(TOGETHER);
    for (ray, room) in rays.iter().zip(&mut rooms) {
        let box_ray = BoxRay::new(ray, &wide.room);
        let boxes = Boxes::new(lanes, Sides::new(&box_ray), &box_ray);
        let (stack, search) = (L::Stack::with_end(room), question.start(lanes, ray));
        walkers.push(Walker { boxes, stack, search, limit: 0.0, child: END });
    }
    for rays in rays.chunks(TOGETHER) {
        let mut at_nodes = List::EMPTY;
        for (number, (ray, walker)) in rays.iter().zip(&mut walkers).enumerate() {
            let box_ray = BoxRay::new(ray, &wide.room);
            walker.boxes = Boxes::new(lanes, Sides::new(&box_ray), &box_ray);
            walker.search = question.start(lanes, ray);
            walker.stack.clear();
            (walker.limit, walker.child) = (ray.range.max, 0);
            at_nodes.add(number as u8, !box_ray.blurs);
            if box_ray.blurs {
                walk(lanes, wide, ray, ray.range.max, &mut walker.search, &mut Uncounted);
            }
        }
        take_turns(lanes, wide, &mut walkers, at_nodes);
        for walker in &walkers[..rays.len()] {
            question.finish(&walker.search);
        }
    }
}

/// Walks until all rays are through.
#[inline(always)]
fn take_turns<L: Lanes, S: Search>(
    lanes: L,
    wide: &Wide,
    walkers: &mut [Walker<'_, L, S>],
    mut at_nodes: List,
) {
    let mut at_leaves = List::EMPTY;
    if wide.nodes.is_empty() {
        return;
    }
    while at_nodes.len + at_leaves.len > 0 {
        while at_nodes.len > 0 {
            let before = std::mem::replace(&mut at_nodes.len, 0);
            for i in 0..before {
                let number = at_nodes.rays[i % TOGETHER];
                let walker = &mut walkers[usize::from(number)];
                walker.step(lanes, wide);
                at_nodes.add(number, walker.child & LEAF == 0);
                at_leaves.add(number, (walker.child & LEAF != 0) & (walker.child != END));
            }
        }
        let before = std::mem::replace(&mut at_leaves.len, 0);
        for i in 0..before {
            let number = at_leaves.rays[i % TOGETHER];
            let walker = &mut walkers[usize::from(number)];
            walker.search(lanes);
            at_nodes.add(number, walker.child & LEAF == 0);
            at_leaves.add(number, (walker.child & LEAF != 0) & (walker.child != END));
        }
    }
}

impl<L: Lanes, S: Search> Walker<'_, L, S> {
    /// Passes a node.
    #[inline(always)]
    fn step(&mut self, lanes: L, wide: &Wide) {
        let node = &wide.nodes[self.child as usize];
        let (near, far) = self.boxes.meet(lanes, node, self.limit);
        let order = *self.boxes.sides().octant.of(&node.orders);
        self.child = lanes.enter_evenly(&mut self.stack, near, far, &node.children, order, S::SHORTENS);
    }

    /// Searches a leaf.
    #[inline(always)]
    fn search(&mut self, lanes: L) {
        let end = self.search.leaf(lanes, self.child & !LEAF, &mut Uncounted);
        if end == f32::NEG_INFINITY {
            self.child = END;
            return;
        }
        if S::SHORTENS && end < self.limit {
            self.limit = end;
            lanes.forget_beyond(&mut self.stack, end);
        }
        self.child = self.stack.pop();
    }
}
