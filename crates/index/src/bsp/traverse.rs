//! The walk of a ray through the tree, front to back.
//!
//! The two rules of the classic BSP walk, in the form that loses nothing:
//!
//! - *The cell of a leaf ends the search.* No cell is entered once the nearest hit lies before its entry. But a hit is
//!   never rejected for lying outside the cell it was found in: a triangle reaches beyond it, and a rounded distance may
//!   fall an ulp to the wrong side.
//! - *When a ray enters both children at the same distance, both are searched* and the nearer hit wins: the distance to a
//!   plane is an interval, grown by the rounding of everything that leads to it, and a child is left out only when
//!   the ray's part of the cell lies wholly on the other side of that interval.
//!
//! The near child is chosen by the sign bit of the direction, never by comparing the origin with the plane.
//!
//! # Source
//! Havran, "Heuristic Ray Shooting Algorithms", 2000, appendix C (recursive walk with a stack); Ize, "Robust BVH
//! Ray Traversal", JCGT 2013 (grown distances).

use super::BspTree;
use super::node::Kind;
use super::params::MAX_DEPTH;
use heliostat_geometry::error_bound::{cell_padding, inverse_direction};
use heliostat_geometry::{Aabb, Interval, Ray};

/// The work of one or more queries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TraversalCost {
    /// Inner nodes passed.
    pub nodes: u64,
    /// Leaves searched, empty ones included.
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
    fn node(&mut self) {
        self.nodes += 1;
    }

    fn leaf(&mut self, tests: usize) {
        self.leaves += 1;
        self.tests += tests as u64;
    }
}

/// Counts nothing.
pub(crate) struct Uncounted;

impl Counter for Uncounted {
    fn node(&mut self) {}

    fn leaf(&mut self, _tests: usize) {}
}

/// What a ray needs along one axis to find its distances to planes.
#[derive(Clone, Copy, Default)]
struct RayAxis {
    origin: f32,
    inverse: f32,
    /// Growth of a distance, both ways.
    padding: f32,
    /// 1 when the ray runs downward: then the right child is the near one.
    near: u32,
}

impl RayAxis {
    /// Distances between which the ray passes `plane`. NaN ends mean that nothing is known.
    #[inline]
    fn crossing(self, plane: f32) -> Interval {
        let t = (plane - self.origin) * self.inverse;
        Interval { min: t - self.padding, max: t + self.padding }
    }
}

/// Per-ray constants; the fourth axis makes any two-bit index valid.
struct RayAxes([RayAxis; 4]);

impl RayAxes {
    fn new(ray: &Ray, extent: f32) -> Self {
        let inverse = inverse_direction(ray.dir);
        let padding = cell_padding(extent + ray.origin.abs().max_element());
        let axis = |a: usize| RayAxis {
            origin: ray.origin[a],
            inverse: inverse[a],
            padding: padding * inverse[a].abs(),
            near: u32::from(inverse[a].is_sign_negative()),
        };
        Self([axis(0), axis(1), axis(2), RayAxis::default()])
    }

    /// The part of `range` inside `bounds`; empty when there is none. A NaN distance cuts off nothing.
    fn clip(&self, bounds: Aabb, range: Interval) -> Interval {
        let mut part = range;
        for (a, axis) in self.0.iter().take(3).enumerate() {
            let (low, high) = (axis.crossing(bounds.min[a]), axis.crossing(bounds.max[a]));
            let (enter, leave) = if axis.near == 0 { (low.min, high.max) } else { (high.min, low.max) };
            part = Interval { min: part.min.max(enter), max: part.max.min(leave) };
        }
        part
    }
}

/// A child to come back to, and the ray's part in it.
#[derive(Clone, Copy, Default)]
struct Pending {
    node: u32,
    min: f32,
    max: f32,
}

impl BspTree {
    /// Walks the leaves that the ray meets, front to back. `search` is given the references of a leaf and answers up
    /// to which distance hits still matter; below the next entry, the walk ends.
    #[inline]
    pub(crate) fn walk(
        &self,
        ray: &Ray,
        mut limit: f32,
        counter: &mut impl Counter,
        mut search: impl FnMut(&[u32]) -> f32,
    ) {
        if self.leaf_refs.is_empty() {
            return;
        }
        let axes = RayAxes::new(ray, self.extent);
        let mut part = axes.clip(self.bounds, Interval { max: limit, ..ray.range });
        if part.is_empty() {
            return;
        }
        let mut stack = [Pending::default(); MAX_DEPTH as usize + 1];
        let mut height = 0;
        let mut node = 0;
        loop {
            match self.nodes[node as usize].kind() {
                Kind::Inner { axis, split, left } => {
                    counter.node();
                    let axis = &axes.0[axis & 3];
                    let crossing = axis.crossing(split);
                    let (near, far) = (left + axis.near, left + 1 - axis.near);
                    // Written so that a NaN leads into both children.
                    if crossing.min > part.max {
                        node = near;
                    } else if crossing.max < part.min {
                        node = far;
                    } else {
                        stack[height] = Pending { node: far, min: part.min.max(crossing.min), max: part.max };
                        height += 1;
                        part.max = part.max.min(crossing.max);
                        node = near;
                    }
                    continue;
                }
                Kind::Leaf { first, count } => {
                    let refs = &self.leaf_refs[first as usize..][..count as usize];
                    counter.leaf(refs.len());
                    if !refs.is_empty() {
                        limit = search(refs);
                    }
                }
            }
            // The next cell that begins before the nearest hit.
            loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                let Pending { node: next, min, max } = stack[height];
                if min <= limit {
                    (node, part) = (next, Interval { min, max });
                    break;
                }
            }
        }
    }
}
