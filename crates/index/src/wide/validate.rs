//! Whether the wide form keeps its promises.

use super::{LEAF, Wide, WideNode};
use crate::simd::LANES;
use heliostat_geometry::Aabb;

/// A leaf child: what it says, and its box.
pub(crate) type Leaf = (u32, Aabb);

impl Wide {
    /// Checks that every node has one parent whose box holds it, and that each octant meets all lanes of a node, in the order
    /// in which a ray does; answers the leaves.
    ///
    /// # Errors
    /// The first promise found broken.
    pub(crate) fn check(&self) -> Result<Vec<Leaf>, String> {
        let mut leaves = Vec::new();
        let mut met = vec![false; self.nodes.len()];
        let mut pending = vec![(0_u32, Aabb::EVERYTHING)];
        while let Some((index, around)) = pending.pop() {
            let Some(node) = self.nodes.get(index as usize) else {
                return Err(format!("wide node {index} does not exist"));
            };
            if std::mem::replace(&mut met[index as usize], true) {
                return Err(format!("wide node {index} has two parents"));
            }
            node.check_orders().map_err(|why| format!("wide node {index}: {why}"))?;
            for (child, bounds) in node.children() {
                if !around.contains_box(bounds) {
                    return Err(format!("a child of wide node {index} reaches out of the box of the node"));
                }
                if child & LEAF == 0 {
                    pending.push((child, bounds));
                } else {
                    leaves.push((child & !LEAF, bounds));
                }
            }
        }
        match met.iter().position(|met| !met) {
            Some(orphan) => Err(format!("wide node {orphan} has no parent")),
            None => Ok(leaves),
        }
    }
}

impl WideNode {
    /// Each order names every lane once, and no box before one that a ray of that octant could meet first.
    fn check_orders(&self) -> Result<(), String> {
        for octant in 0..8 {
            let lanes: [usize; LANES] =
                std::array::from_fn(|place| (self.orders[octant] >> (3 * place)) as usize % LANES);
            if (0..LANES).any(|lane| !lanes.contains(&lane)) {
                return Err(format!("octant {octant} does not meet every lane"));
            }
            for (place, &first) in lanes.iter().enumerate() {
                for &second in &lanes[place + 1..] {
                    let (first, second) = (self.bounds(first), self.bounds(second));
                    let is_known = first.is_empty() || second.is_empty() || first == second;
                    if !is_known && !comes_before(first, second, octant) {
                        return Err(format!("octant {octant} may meet a later child first"));
                    }
                }
            }
        }
        Ok(())
    }
}

/// Whether a plane across some axis has the first box on the side where rays of the octant come from.
fn comes_before(first: Aabb, second: Aabb, octant: usize) -> bool {
    (0..3).any(|axis| {
        let is_downward = octant >> axis & 1 != 0;
        if is_downward { second.max[axis] <= first.min[axis] } else { first.max[axis] <= second.min[axis] }
    })
}
