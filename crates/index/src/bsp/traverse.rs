//! The walk of a ray through the tree, front to back.
//!
//! The two rules of the classic BSP walk, in the form that loses nothing:
//!
//! - *The cell of a leaf ends the search.* No cell is entered once the nearest hit lies before its entry. But a
//!   hit is never rejected for lying outside the cell it was found in: a triangle reaches beyond it, and a
//!   rounded distance may fall an ulp to the wrong side.
//! - *When a ray enters both children at the same distance, both are searched* and the nearer hit wins: the
//!   distance to a plane is an interval, grown by the rounding of everything that leads to it, and a child is
//!   left out only when the ray's part of the cell lies wholly on the other side of that interval.
//!
//! How wide the interval must be depends on how far the ray has come, and on the size of what it may meet
//! there. The first is known on the way; for the second the tree has a constant, `slack`, and the few
//! primitives that are larger than it allows for are known to every cell within the error of their own size: so
//! one huge triangle does not blur the cells of all small ones.
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
    /// More growth, for each unit of distance up to which rounding counts.
    growth: f32,
    /// 1 when the ray runs downward: then the right child is the near one.
    near: u32,
}

impl RayAxis {
    /// The distance of `plane`, before rounding is allowed for.
    #[inline]
    fn distance(self, plane: f32) -> f32 {
        (plane - self.origin) * self.inverse
    }

    /// Distances between which the ray passes `plane`, as far as distances up to `reach` matter. NaN ends mean
    /// that nothing is known.
    #[inline]
    fn crossing(self, plane: f32, reach: f32) -> Interval {
        let t = self.distance(plane);
        let padding = self.padding + self.growth * reach;
        Interval { min: t - padding, max: t + padding }
    }
}

/// Per-ray constants.
struct RayAxes {
    /// The fourth makes any two-bit index valid.
    axes: [RayAxis; 4],
    /// The axis along which the ray runs fastest.
    main: usize,
}

impl RayAxes {
    fn new(ray: &Ray, slack: f32) -> Self {
        let inverse = inverse_direction(ray.dir);
        let growth = cell_padding(ray.dir.abs().max_element(), 0.0);
        let axis = |a: usize| RayAxis {
            origin: ray.origin[a],
            inverse: inverse[a],
            padding: slack * inverse[a].abs(),
            growth: growth * inverse[a].abs(),
            near: u32::from(inverse[a].is_sign_negative()),
        };
        Self { axes: [axis(0), axis(1), axis(2), RayAxis::default()], main: ray.dir.abs().max_position() }
    }

    /// The part of `range` inside `bounds`; empty when there is none. A NaN distance cuts off nothing.
    fn clip(&mut self, bounds: Aabb, range: Interval) -> Interval {
        // Along its main axis the ray leaves the box for good: what may be met lies before, and rounding counts
        // up to there.
        let main = self.main;
        let far = if self.axes[main].near == 0 { bounds.max[main] } else { bounds.min[main] };
        let reach = self.axes[main].distance(far).min(range.max).max(0.0);

        let mut part = range;
        for (a, axis) in self.axes[..3].iter().enumerate() {
            let (low, high) = (axis.crossing(bounds.min[a], reach), axis.crossing(bounds.max[a], reach));
            let (enter, leave) = if axis.near == 0 { (low.min, high.max) } else { (high.min, low.max) };
            part = Interval { min: part.min.max(enter), max: part.max.min(leave) };
        }

        // The walk allows for rounding up to the end of the part at hand. Where a ray looks backward, its start
        // may be farther.
        let backward = (-part.min).max(0.0);
        for axis in &mut self.axes {
            axis.padding += axis.growth * backward;
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
    /// Walks the leaves that the ray meets, front to back. `search` is given the references of a leaf and
    /// answers up to which distance hits still matter; below the next entry, the walk ends.
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
        let mut ray_axes = RayAxes::new(ray, self.slack);
        let mut part = ray_axes.clip(self.bounds, Interval { max: limit, ..ray.range });
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
                    let axis = &ray_axes.axes[axis & 3];
                    let crossing = axis.crossing(split, part.max);
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
