//! What a tree looks like in numbers.

use super::BspTree;
use super::node::{Kind, Node};
use super::params::{SahCosts, SplitRule};
use crate::wide::WideNode;

/// Figures of a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeStats {
    /// Primitives it was built over.
    pub primitives: usize,
    /// Those of them outside the tree, because their boxes are infinite.
    pub unbounded: usize,
    /// Nodes, leaves included.
    pub nodes: usize,
    /// Leaves, empty ones included.
    pub leaves: usize,
    /// Leaves without references.
    pub empty_leaves: usize,
    /// References of the fullest leaf.
    pub largest_leaf: usize,
    /// Levels below the root.
    pub depth: u32,
    /// Nodes of the wide form that rays walk.
    pub wide_nodes: usize,
    /// References of all leaves.
    pub references: usize,
    /// References per bounded primitive, 0 when there is none.
    pub references_per_primitive: f64,
    /// Work that the surface area heuristic expects for a ray that meets the root, in the costs of the build
    /// ([`SahCosts::DEFAULT`] for a tree built without costs, so that trees compare).
    pub sah_cost: f64,
    /// Bytes of the tree, with the triangles that a tree over a mesh lays out for itself; primitives not counted.
    pub bytes: usize,
    /// Seconds that the build took.
    pub build_seconds: f64,
}

impl BspTree {
    /// Counts and measures the tree.
    pub fn stats(&self) -> TreeStats {
        let (mut leaves, mut empty_leaves, mut largest_leaf, mut references) = (0, 0, 0, 0);
        let mut sah_cost = 0.0;
        let costs = self.costs();
        let root_area = self.bounds.surface_area();
        for place in self.places() {
            let chance = if root_area > 0.0 { place.cell.surface_area() / root_area } else { 1.0 };
            match place.kind {
                Kind::Inner { .. } => sah_cost += chance * costs.traversal,
                Kind::Leaf { count, .. } => {
                    sah_cost += chance * costs.intersection * f64::from(count);
                    references += count as usize;
                    leaves += 1;
                    empty_leaves += usize::from(count == 0);
                    largest_leaf = largest_leaf.max(count as usize);
                }
            }
        }
        let bounded = self.primitives as usize - self.unbounded.len();
        TreeStats {
            primitives: self.primitives as usize,
            unbounded: self.unbounded.len(),
            nodes: self.nodes.len(),
            leaves,
            empty_leaves,
            largest_leaf,
            depth: self.depth,
            wide_nodes: self.wide.nodes.len(),
            references,
            references_per_primitive: references as f64 / bounded.max(1) as f64,
            sah_cost,
            bytes: size_of::<Self>()
                + self.nodes.len() * size_of::<Node>()
                + self.wide.nodes.len() * size_of::<WideNode>()
                + (self.leaf_refs.len() + self.unbounded.len()) * size_of::<u32>(),
            build_seconds: self.build_seconds,
        }
    }

    fn costs(&self) -> SahCosts {
        match self.params.split {
            SplitRule::Sah(costs) => costs,
            SplitRule::Midpoint => SahCosts::DEFAULT,
        }
    }
}
