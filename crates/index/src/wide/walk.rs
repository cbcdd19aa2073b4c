//! The walk of a ray through wide nodes, front to back.
//!
//! - *A box ends the search.* No child is entered once the nearest hit lies before it. But a hit is never rejected for lying
//!   outside the box it was found in: a triangle reaches beyond its cell, and a rounded distance may fall to the wrong side.
//! - *Boxes are met with a margin* for the rounding of everything that leads to a hit; see [`BoxRay`].
//! - *Order comes from signs*, never from comparing distances.

use super::ray::BoxRay;
use super::{LEAF, Wide, WideNode};
use crate::simd::{END, LANES, Lanes, Pending, Pick, Row, StackRoom};
use glam::Vec3A;
use heliostat_geometry::Ray;
use heliostat_geometry::error_bound::cell_padding;

/// The work of one or more queries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TraversalCost {
    /// Inner nodes passed; each compares the ray with up to eight boxes.
    pub nodes: u64,
    /// Leaves searched.
    pub leaves: u64,
    /// Primitives tested, repeated tests included.
    pub tests: u64,
}

/// Counts work, or does not: the choice is made when the walk is compiled.
pub(crate) trait Counter {
    fn node(&mut self);
    fn leaf(&mut self, tests: usize);
}

impl Counter for TraversalCost {
    #[inline(always)]
    fn node(&mut self) {
        self.nodes += 1;
    }

    #[inline(always)]
    fn leaf(&mut self, tests: usize) {
        self.leaves += 1;
        self.tests += tests as u64;
    }
}

/// Counts nothing.
pub(crate) struct Uncounted;

impl Counter for Uncounted {
    #[inline(always)]
    fn node(&mut self) {}

    #[inline(always)]
    fn leaf(&mut self, _tests: usize) {}
}

/// What is looked for in leaves.
pub(crate) trait Search {
    /// Whether a leaf may bring the distance down up to which hits matter.
    const SHORTENS: bool;

    /// Searches a leaf; answers up to which distance hits still matter. Minus infinity ends the walk.
    fn leaf<L: Lanes>(&mut self, lanes: L, leaf: u32, counter: &mut impl Counter) -> f32;
}

/// Walks the leaves that a ray meets up to `limit`.
#[inline(always)]
pub(crate) fn walk<L: Lanes>(
    lanes: L,
    wide: &Wide,
    ray: &Ray,
    limit: f32,
    search: &mut impl Search,
    counter: &mut impl Counter,
) {
    if wide.nodes.is_empty() {
        return;
    }
    let box_ray = BoxRay::new(ray, &wide.room);
    let sides = Sides::of(box_ray.octant());
    if box_ray.blurs {
        let boxes = FineBoxes::new(lanes, sides, &box_ray, wide.room.slack);
        walk_boxes(lanes, &wide.nodes, &boxes, limit, search, counter);
    } else {
        let boxes = Boxes::new(lanes, sides, &box_ray);
        walk_boxes(lanes, &wide.nodes, &boxes, limit, search, counter);
    }
}

#[inline(always)]
fn walk_boxes<L: Lanes, S: Search>(
    lanes: L,
    nodes: &[WideNode],
    boxes: &impl Meet<L>,
    mut limit: f32,
    search: &mut S,
    counter: &mut impl Counter,
) {
    let octant = boxes.sides().octant;
    let mut stack_room = StackRoom::new();
    let mut stack = L::Stack::new(&mut stack_room);
    let mut child = 0;
    loop {
        while child & LEAF == 0 {
            counter.node();
            let node = &nodes[child as usize];
            let (near, far) = boxes.meet(lanes, node, limit);
            let order = *octant.of(&node.orders);
            child = lanes.enter(&mut stack, near, far, &node.children, order, S::SHORTENS);
        }
        if child == END {
            return;
        }
        let end = search.leaf(lanes, child & !LEAF, counter);
        if end == f32::NEG_INFINITY {
            return;
        }
        if S::SHORTENS && end < limit {
            limit = end;
            lanes.forget_beyond(&mut stack, limit);
        }
        child = stack.pop();
    }
}

/// Which sides a ray meets first, by axis, and which last.
#[derive(Clone, Copy)]
pub(super) struct Sides {
    near: [Pick<Row, 2>; 3],
    far: [Pick<Row, 2>; 3],
    pub(super) octant: Pick<u32, LANES>,
}

impl Sides {
    /// Those of an octant: bit a is set where rays run downward along axis a.
    #[inline(always)]
    pub(super) const fn of(octant: usize) -> Self {
        Self {
            near: [Pick::new(octant), Pick::new(octant >> 1), Pick::new(octant >> 2)],
            far: [Pick::new(!octant), Pick::new(!octant >> 1), Pick::new(!octant >> 2)],
            octant: Pick::new(octant),
        }
    }
}

/// A ray that is compared with boxes.
pub(super) trait Meet<L: Lanes> {
    fn sides(&self) -> &Sides;

    /// Where the ray enters and leaves each child, within its range up to `limit`. A NaN distance cuts off nothing.
    fn meet(&self, lanes: L, node: &WideNode, limit: f32) -> (L::F, L::F);
}

/// One padding for all boxes.
pub(super) struct Boxes<L: Lanes> {
    pub(super) sides: Sides,
    pub(super) inverse: [L::F; 3],
    pub(super) near_offset: [L::F; 3],
    pub(super) far_offset: [L::F; 3],
    pub(super) start: L::F,
}

impl<L: Lanes> Boxes<L> {
    #[inline(always)]
    fn new(lanes: L, sides: Sides, ray: &BoxRay) -> Self {
        Self {
            sides,
            inverse: splat(lanes, ray.inverse),
            near_offset: splat(lanes, ray.near_offset),
            far_offset: splat(lanes, ray.far_offset),
            start: lanes.splat(ray.range.min),
        }
    }
}

impl<L: Lanes> Meet<L> for Boxes<L> {
    #[inline(always)]
    fn sides(&self) -> &Sides {
        &self.sides
    }

    #[inline(always)]
    fn meet(&self, lanes: L, node: &WideNode, limit: f32) -> (L::F, L::F) {
        let near = |axis: usize| {
            let plane = lanes.load(self.sides.near[axis].of(&node.planes[axis]));
            lanes.mul_sub(plane, self.inverse[axis], self.near_offset[axis])
        };
        let far = |axis: usize| {
            let plane = lanes.load(self.sides.far[axis].of(&node.planes[axis]));
            lanes.mul_sub(plane, self.inverse[axis], self.far_offset[axis])
        };
        let enter = lanes.later(lanes.later(near(0), near(1)), lanes.later(near(2), self.start));
        let leave = lanes.sooner(lanes.sooner(far(0), far(1)), lanes.sooner(far(2), lanes.splat(limit)));
        (enter, leave)
    }
}

/// A padding for each box, by its distance.
struct FineBoxes<L: Lanes> {
    sides: Sides,
    origin: [L::F; 3],
    inverse: [L::F; 3],
    /// The magnitudes of the inverses.
    size: [L::F; 3],
    slack: L::F,
    growth: L::F,
    reach: L::F,
    start: L::F,
}

impl<L: Lanes> FineBoxes<L> {
    #[inline(always)]
    fn new(lanes: L, sides: Sides, ray: &BoxRay, slack: f32) -> Self {
        Self {
            sides,
            origin: splat(lanes, ray.origin),
            inverse: splat(lanes, ray.inverse),
            size: splat(lanes, ray.inverse.abs()),
            slack: lanes.splat(slack),
            growth: lanes.splat(cell_padding(1.0, 0.0)),
            reach: lanes.splat(ray.reach),
            start: lanes.splat(ray.range.min),
        }
    }
}

impl<L: Lanes> Meet<L> for FineBoxes<L> {
    #[inline(always)]
    fn sides(&self) -> &Sides {
        &self.sides
    }

    #[inline(always)]
    fn meet(&self, lanes: L, node: &WideNode, limit: f32) -> (L::F, L::F) {
        let near = |axis: usize| {
            lanes.sub(lanes.load(self.sides.near[axis].of(&node.planes[axis])), self.origin[axis])
        };
        let far = |axis: usize| {
            lanes.sub(lanes.load(self.sides.far[axis].of(&node.planes[axis])), self.origin[axis])
        };
        let (near_x, near_y, near_z) = (near(0), near(1), near(2));
        let (far_x, far_y, far_z) = (far(0), far(1), far(2));
        // What is met in a box is no farther than its farthest corner.
        let x = lanes.larger_size(near_x, far_x);
        let y = lanes.larger_size(near_y, far_y);
        let z = lanes.larger_size(near_z, far_z);
        let distance = lanes.min(lanes.max(lanes.max(x, y), z), self.reach);
        let padding = lanes.add(self.slack, lanes.mul(self.growth, distance));
        let enter = |from: L::F, axis: usize| {
            lanes.mul_sub(from, self.inverse[axis], lanes.mul(padding, self.size[axis]))
        };
        let leave = |to: L::F, axis: usize| {
            lanes.add(lanes.mul(to, self.inverse[axis]), lanes.mul(padding, self.size[axis]))
        };
        let enter =
            lanes.max(lanes.max(enter(near_x, 0), enter(near_y, 1)), lanes.max(enter(near_z, 2), self.start));
        let leave = lanes
            .min(lanes.min(leave(far_x, 0), leave(far_y, 1)), lanes.min(leave(far_z, 2), lanes.splat(limit)));
        (enter, leave)
    }
}

/// The coordinates, each for all lanes.
#[inline(always)]
pub(super) fn splat<L: Lanes>(lanes: L, v: Vec3A) -> [L::F; 3] {
    [lanes.splat(v.x), lanes.splat(v.y), lanes.splat(v.z)]
}
