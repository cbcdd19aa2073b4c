//! Whether a tree keeps its promises, judged by other means than those it was built with.

use super::node::Kind;
use super::params::MAX_DEPTH;
use super::split::Plane;
use super::{BspTree, Place, build};
use crate::primitives::Primitives;
use glam::Vec3;
use heliostat_geometry::Aabb;
use std::collections::HashMap;
use std::fmt;

/// A promise that a tree breaks. Each message names the node or the primitive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvalidTree {
    /// What is wrong, and where.
    pub violation: String,
}

impl fmt::Display for InvalidTree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "invalid BSP tree: {}", self.violation)
    }
}

impl std::error::Error for InvalidTree {}

fn broken<T>(violation: String) -> Result<T, InvalidTree> {
    Err(InvalidTree { violation })
}

impl BspTree {
    /// Checks the whole tree against the primitives it was built over.
    ///
    /// - Every node but the root has one parent; every reference belongs to one leaf.
    /// - Planes lie strictly inside the cells they cut, so that children tile their parent exactly.
    /// - No leaf lies deeper than the tree says and the walk's stack allows.
    /// - The root holds the box of every bounded primitive, and the unbounded ones are listed apart.
    /// - A leaf names a primitive once, and only one whose box meets its cell.
    /// - The wide form that rays walk has the same leaves, each in a box around all that it holds, in the order of every octant.
    /// - Every leaf names every primitive whose part inside its cell is more than a touch at the border.
    ///
    /// # Errors
    /// The first promise found broken.
    pub fn validate<P: Primitives + ?Sized>(&self, primitives: &P) -> Result<(), InvalidTree> {
        self.check_links()?;
        self.check_cells()?;
        self.check_unbounded(primitives)?;
        self.check_leaves(primitives)?;
        self.check_reach(primitives)?;
        self.check_wide(primitives)
    }

    /// The wide form has every leaf that holds anything, in a box around all that is in it.
    fn check_wide<P: Primitives + ?Sized>(&self, primitives: &P) -> Result<(), InvalidTree> {
        let wide = match self.wide.check() {
            Ok(leaves) => leaves,
            Err(violation) => return broken(violation),
        };
        let mut boxes = HashMap::new();
        for (leaf, bounds) in wide {
            for group in self.range_of(leaf).step_by(self.layout.group) {
                if boxes.insert(group, bounds).is_some() {
                    return broken(format!("the wide form names reference {group} twice"));
                }
            }
        }
        for place in self.places() {
            let Kind::Leaf { first, count } = place.kind else { continue };
            let (first, group) = (first as usize, self.layout.group);
            for i in first..first + count as usize {
                let Some(bounds) = boxes.get(&(i / group * group)) else {
                    return broken(format!("the wide form does not name reference {i}"));
                };
                let primitive = self.leaf_refs[i];
                let inner = self.interior(place.cell, primitives.bounds(primitive));
                let part = primitives.clipped_bounds(primitive, inner);
                if !build::grow(*bounds, self.blur.clipping as f32).contains_box(part) {
                    return broken(format!("primitive {primitive} reaches out of the box of its leaf"));
                }
            }
        }
        Ok(())
    }

    /// Children and references are each owned once.
    fn check_links(&self) -> Result<(), InvalidTree> {
        let mut node_owned = vec![false; self.nodes.len()];
        let mut ref_owned = vec![false; self.leaf_refs.len()];
        let Some(root) = node_owned.first_mut() else { return broken("there is no root".into()) };
        *root = true;
        let claim = |owned: &mut Vec<bool>, i: usize, what: &str| match owned.get_mut(i) {
            None => broken(format!("{what} {i} does not exist")),
            Some(true) => broken(format!("{what} {i} has two owners")),
            Some(slot) => {
                *slot = true;
                Ok(())
            }
        };
        for node in &self.nodes {
            match node.kind() {
                Kind::Inner { left, .. } => {
                    claim(&mut node_owned, left as usize, "node")?;
                    claim(&mut node_owned, left as usize + 1, "node")?;
                }
                Kind::Leaf { first, count } => {
                    let end = first as usize + (count as usize).next_multiple_of(self.layout.group);
                    for i in first as usize..end {
                        claim(&mut ref_owned, i, "reference")?;
                    }
                }
            }
        }
        if let Some(orphan) = node_owned.iter().position(|owned| !owned) {
            return broken(format!("node {orphan} has no parent"));
        }
        match ref_owned.iter().position(|owned| !owned) {
            Some(orphan) => broken(format!("reference {orphan} is in no leaf")),
            None => Ok(()),
        }
    }

    /// Planes cut their cells, and nothing lies too deep.
    fn check_cells(&self) -> Result<(), InvalidTree> {
        let mut met = 0;
        for Place { kind, cell, depth } in self.places() {
            met += 1;
            if depth > self.depth || depth > MAX_DEPTH {
                return broken(format!("a node lies at depth {depth}, deeper than {}", self.depth));
            }
            if let Kind::Inner { axis, split, .. } = kind {
                let inside = cell.min[axis] < split && split < cell.max[axis];
                if !inside {
                    return broken(format!(
                        "plane {split} on axis {axis} does not cut its cell {} to {}",
                        cell.min, cell.max
                    ));
                }
            }
        }
        if met != self.nodes.len() {
            return broken(format!("{met} of {} nodes can be reached", self.nodes.len()));
        }
        Ok(())
    }

    /// Unbounded primitives are listed, bounded ones lie in the root.
    fn check_unbounded<P: Primitives + ?Sized>(&self, primitives: &P) -> Result<(), InvalidTree> {
        if primitives.len() != self.primitives as usize {
            return broken(format!("built over {}, given {} primitives", self.primitives, primitives.len()));
        }
        let mut listed = self.unbounded.iter().copied().peekable();
        for i in 0..self.primitives {
            let bounds = primitives.bounds(i);
            let is_listed = listed.next_if_eq(&i).is_some();
            if bounds.is_finite() == is_listed {
                return broken(format!("primitive {i} is on the wrong side of the list of unbounded ones"));
            }
            if bounds.is_finite() && !self.bounds.contains_box(bounds) {
                return broken(format!("primitive {i} reaches out of the root"));
            }
        }
        match listed.next() {
            Some(i) => broken(format!("unbounded primitive {i} does not exist or is listed twice")),
            None => Ok(()),
        }
    }

    /// Leaves name what meets them, once.
    fn check_leaves<P: Primitives + ?Sized>(&self, primitives: &P) -> Result<(), InvalidTree> {
        // The last leaf, counted from 1, that named each primitive.
        let mut named_by = vec![0_usize; self.primitives as usize];
        let leaves = self.places().filter_map(|place| match place.kind {
            Kind::Leaf { first, count } => Some((place.cell, first as usize, count as usize)),
            Kind::Inner { .. } => None,
        });
        for (number, (cell, first, count)) in leaves.enumerate() {
            for &primitive in &self.leaf_refs[first..first + count] {
                let Some(last) = named_by.get_mut(primitive as usize) else {
                    return broken(format!(
                        "leaf {number} names primitive {primitive}, which does not exist"
                    ));
                };
                if *last == number + 1 {
                    return broken(format!("leaf {number} names primitive {primitive} twice"));
                }
                *last = number + 1;
                if self.blur.grown(primitives.bounds(primitive)).intersect(cell).is_empty() {
                    return broken(format!(
                        "leaf {number} names primitive {primitive}, which lies elsewhere"
                    ));
                }
            }
        }
        let missing =
            (0..self.primitives).find(|&i| named_by[i as usize] == 0 && primitives.bounds(i).is_finite());
        match missing {
            Some(i) => broken(format!("no leaf names primitive {i}")),
            None => Ok(()),
        }
    }

    /// Every primitive is named wherever it is.
    fn check_reach<P: Primitives + ?Sized>(&self, primitives: &P) -> Result<(), InvalidTree> {
        let mut pending = Vec::new();
        for primitive in 0..self.primitives {
            let bounds = primitives.bounds(primitive);
            if !bounds.is_finite() {
                continue;
            }
            pending.push((0_u32, self.bounds));
            while let Some((node, cell)) = pending.pop() {
                let inner = self.interior(cell, bounds);
                if inner.intersect(bounds).is_empty() {
                    continue;
                }
                match self.nodes[node as usize].kind() {
                    Kind::Inner { axis, split, left } => {
                        let (below, above) = Plane { axis, position: split }.cut(cell);
                        pending.extend([(left, below), (left + 1, above)]);
                    }
                    Kind::Leaf { first, count } => {
                        let refs = &self.leaf_refs[first as usize..][..count as usize];
                        let is_there = !primitives.clipped_bounds(primitive, inner).is_empty();
                        if is_there && !refs.contains(&primitive) {
                            return broken(format!(
                                "primitive {primitive} is not named by the leaf {} to {} that it meets",
                                cell.min, cell.max
                            ));
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// The part of a cell in which a primitive must be known to it: all but a border as wide as the error of
    /// clipping.
    ///
    /// A primitive that only touches a plane may belong to the other side; one that lies flat in a plane
    /// belongs to the side below, which at the lower border of the root is the root's own.
    fn interior(&self, cell: Aabb, bounds: Aabb) -> Aabb {
        let margin = self.blur.clipping;
        let low = |axis: usize| {
            let is_flat = bounds.min[axis] == bounds.max[axis];
            let is_border = cell.min[axis] == self.bounds.min[axis];
            match (is_flat, is_border) {
                (true, true) => cell.min[axis],
                (true, false) => cell.min[axis].next_up(),
                (false, _) => ((f64::from(cell.min[axis]) + margin) as f32).next_up(),
            }
        };
        let high = |axis: usize| {
            let is_flat = bounds.min[axis] == bounds.max[axis];
            if is_flat { cell.max[axis] } else { ((f64::from(cell.max[axis]) - margin) as f32).next_down() }
        };
        Aabb { min: Vec3::new(low(0), low(1), low(2)), max: Vec3::new(high(0), high(1), high(2)) }
    }
}
