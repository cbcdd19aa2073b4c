//! How many roots each side of a binary node is best stood for by.
//!
//! # Source
//! Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, section 3.1
//! (dynamic programming over the number of roots).

use crate::bsp::node::{Kind, Node};
use crate::parallel;
use crate::simd::LANES;
use heliostat_geometry::Aabb;

/// Subtrees with more nodes are planned in parallel.
const LARGE: usize = 8192;

/// The least expected work for a subtree below `i + 1` roots.
type Work = [f32; LANES];

/// What is best for one binary node, three bits a number.
#[derive(Clone, Copy)]
struct Plan(u32);

impl Plan {
    const NONE: Self = Self(0);

    fn set(&mut self, roots: usize, left: u32) {
        self.0 |= left << (3 * (roots - 1));
    }

    fn set_below(&mut self, left: u32) {
        self.0 |= left << (3 * LANES);
    }
}

/// For each binary node, how it is best stood for by wide nodes.
pub(super) struct Plans(Vec<Plan>);

impl Plans {
    /// `bounds` has the box of the content of each node.
    pub(super) fn new(nodes: &[Node], bounds: &[Aabb]) -> Self {
        let mut plans = vec![Plan::NONE; nodes.len()];
        let (first, below) = plans.split_at_mut(1);
        first[0] = Planner { nodes, bounds }.plan(0, below).1;
        Self(plans)
    }

    /// How many of so many roots fall to the left side; 0 where the node itself is the only root.
    pub(super) fn left(&self, node: u32, roots: usize) -> usize {
        (self.0[node as usize].0 >> (3 * (roots - 1))) as usize % LANES
    }

    /// The same for the children of the wide node that stands for it.
    pub(super) fn left_below(&self, node: u32) -> usize {
        (self.0[node as usize].0 >> (3 * LANES)) as usize % LANES
    }
}

struct Planner<'a> {
    nodes: &'a [Node],
    bounds: &'a [Aabb],
}

impl Planner<'_> {
    /// Plans a node and all `below` it: its two children, and then what is below either.
    fn plan(&self, node: usize, below: &mut [Plan]) -> (Work, Plan) {
        let Kind::Inner { left, .. } = self.nodes[node].kind() else { return ([0.0; LANES], Plan::NONE) };
        let (left, right) = (left as usize, left as usize + 1);
        let (children, deeper) = below.split_at_mut(2);
        let is_large = deeper.len() > LARGE;
        let (on_left, on_right) = self.sides(left, deeper);
        let (on_left, on_right) = if is_large {
            parallel::join(|| self.plan(left, on_left), || self.plan(right, on_right))
        } else {
            (self.plan(left, on_left), self.plan(right, on_right))
        };
        (children[0], children[1]) = (on_left.1, on_right.1);
        match (self.bounds[left].is_empty(), self.bounds[right].is_empty()) {
            (false, false) => weigh(self.bounds[node].surface_area() as f32, &on_left.0, &on_right.0),
            // An empty side needs no root: the node is what the other side is.
            (false, true) => on_left,
            (true, false) => on_right,
            (true, true) => ([0.0; LANES], Plan::NONE),
        }
    }

    /// What is below the left child and what is below the right one, from what is behind both; either may come first.
    fn sides<'p>(&self, left: usize, deeper: &'p mut [Plan]) -> (&'p mut [Plan], &'p mut [Plan]) {
        let begin = |child: usize| match self.nodes[child].kind() {
            Kind::Inner { left: next, .. } => Some(next as usize - (left + 2)),
            Kind::Leaf { .. } => None,
        };
        match (begin(left), begin(left + 1)) {
            (Some(left), Some(right)) => {
                let (first, second) = deeper.split_at_mut(left.max(right));
                if left < right { (first, second) } else { (second, first) }
            }
            (Some(_), None) => (deeper, &mut []),
            (None, _) => (&mut [], deeper),
        }
    }
}

/// The plan of a node with a box of this area, from the work on either side.
fn weigh(area: f32, left: &Work, right: &Work) -> (Work, Plan) {
    let split = |roots: usize| {
        let works = (1..roots).map(|k| (left[k - 1] + right[roots - k - 1], k as u32));
        works.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f32::INFINITY, 0))
    };
    let mut plan = Plan::NONE;
    let (below, left_below) = split(LANES);
    plan.set_below(left_below);
    let mut least = [area + below; LANES];
    for roots in 2..=LANES {
        let (work, left) = split(roots);
        if work < least[roots - 1] {
            least[roots - 1] = work;
            plan.set(roots, left);
        }
    }
    (least, plan)
}
