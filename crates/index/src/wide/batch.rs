//! The walk of many rays at once, in turns.
//!
//! One ray alone spends much of its time waiting: for the node it has just chosen, and for what was wrongly guessed to come
//! next. Here all rays of a batch go on to their next node before the first has its turn again, and what a ray does next is
//! noted as a bit instead of branched on. First all rays walk until they stand at a leaf, then all leaves are searched.
//!
//! # Source
//! Barringer and Akenine-Möller, "Dynamic Ray Stream Traversal", SIGGRAPH 2014 (lists of rays instead of packets).

use super::rays::{BoxRays, PerRay, Rays, TOGETHER};
use super::set::Set;
use super::walk::Meet;
use super::{LEAF, Wide, WideNode};
use crate::simd::{END, Lanes, StackRoom, Stacks, Task};
use heliostat_geometry::Ray;

/// What is asked of all rays.
pub(crate) trait Question {
    /// Whether a leaf may bring the distance down up to which hits matter.
    const SHORTENS: bool;

    /// Begins with other rays.
    fn begin<L: Lanes>(&mut self, lanes: L, rays: &Rays);

    /// Answers for a ray that cannot be walked with others.
    fn ask_alone(&mut self, rays: &Rays, ray: usize);

    /// Searches the leaves at which some rays stand. Brings `limits` down, up to which hits matter, minus infinity where none does
    /// any more; gives the rays for which it did. What `leaves` says of these rays is not needed afterwards.
    fn search<L: Lanes>(
        &mut self,
        lanes: L,
        rays: &Rays,
        at_leaves: Set,
        leaves: &mut PerRay<u32>,
        limits: &mut PerRay<f32>,
    ) -> Set;

    /// All rays are through.
    fn finish(&mut self, rays: &Rays);
}

/// Rays on their way.
struct Walkers<'r> {
    rays: Rays,
    boxes: BoxRays,
    stacks: Stacks<'r, TOGETHER>,
    /// Up to which distance hits matter.
    limits: PerRay<f32>,
    /// Where each goes next.
    children: PerRay<u32>,
    at_nodes: Set,
    at_leaves: Set,
}

/// Walks the leaves that each of the rays meets.
#[inline(always)]
pub(crate) fn walk_together<L: Lanes>(lanes: L, wide: &Wide, rays: &[Ray], question: &mut impl Question) {
    let mut rooms = [const { StackRoom::new() }; TOGETHER];
    let mut walkers = Walkers {
        rays: Rays::NONE,
        boxes: BoxRays::NONE,
        stacks: Stacks::new(&mut rooms),
        limits: [0.0; TOGETHER],
        children: [END; TOGETHER],
        at_nodes: Set::EMPTY,
        at_leaves: Set::EMPTY,
    };
    for rays in rays.chunks(TOGETHER) {
        lanes.run_loops(Begin { walkers: &mut walkers, wide, rays });
        question.begin(lanes, &walkers.rays);
        for ray in 0..walkers.rays.len {
            let is_alone = walkers.boxes.is_alone(ray);
            walkers.at_nodes.add(ray, !is_alone);
            if is_alone {
                question.ask_alone(&walkers.rays, ray);
            }
        }
        if !wide.nodes.is_empty() {
            walkers.take_turns(lanes, &wide.nodes, question);
        }
        question.finish(&walkers.rays);
    }
}

/// Brings other rays to the root.
struct Begin<'a, 'r> {
    walkers: &'a mut Walkers<'r>,
    wide: &'a Wide,
    rays: &'a [Ray],
}

impl Task for Begin<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) {
        let Self { walkers, wide, rays } = self;
        walkers.rays.fill(rays, &wide.room);
        walkers.boxes.set_up(&walkers.rays, &wide.room);
        walkers.stacks.clear();
        (walkers.limits, walkers.children) = (walkers.rays.max, [0; TOGETHER]);
        (walkers.at_nodes, walkers.at_leaves) = (Set::EMPTY, Set::EMPTY);
    }
}

impl Walkers<'_> {
    /// Walks until all rays are through.
    #[inline(always)]
    fn take_turns<L: Lanes, Q: Question>(&mut self, lanes: L, nodes: &[WideNode], question: &mut Q) {
        loop {
            while !self.at_nodes.is_empty() {
                for ray in self.at_nodes.take_all() {
                    let child = self.step::<L, Q>(lanes, nodes, ray);
                    self.go_on(ray, child);
                }
            }
            if self.at_leaves.is_empty() {
                return;
            }
            let searched = self.at_leaves.take_all();
            let shortened =
                question.search(lanes, &self.rays, searched, &mut self.children, &mut self.limits);
            if Q::SHORTENS {
                for ray in shortened {
                    self.stacks.forget_beyond(lanes, ray, self.limits[ray]);
                }
            }
            for ray in searched {
                let child = self.stacks.take(ray);
                self.go_on(ray, if self.limits[ray] == f32::NEG_INFINITY { END } else { child });
            }
        }
    }

    /// Passes a node; gives where the ray goes next.
    #[inline(always)]
    fn step<L: Lanes, Q: Question>(&mut self, lanes: L, nodes: &[WideNode], ray: usize) -> u32 {
        let node = &nodes[self.children[ray] as usize];
        let boxes = self.boxes.boxes(lanes, ray);
        let met = boxes.meet(lanes, node, self.limits[ray]);
        let order = *boxes.sides().octant.of(&node.orders);
        self.stacks.push_met(lanes, ray, met, &node.children, order, Q::SHORTENS);
        self.stacks.take(ray)
    }

    /// Notes where a ray goes next.
    #[inline(always)]
    fn go_on(&mut self, ray: usize, child: u32) {
        self.children[ray] = child;
        self.at_nodes.add(ray, child & LEAF == 0);
        self.at_leaves.add(ray, (child & LEAF != 0) & (child != END));
    }
}
