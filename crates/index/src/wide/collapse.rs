//! From binary nodes to wide ones.

use super::{LEAF, WideNode};
use crate::bsp::node::{Kind, Node};
use crate::simd::LANES;
use heliostat_geometry::Aabb;

/// The lower end of a treelet, or a node inside it.
#[derive(Clone, Copy)]
struct Slot {
    node: u32,
    bounds: Aabb,
}

/// Makes wide nodes of a binary tree. `bounds` has the box of the content of each node; `leaf` writes what the child of a
/// leaf says (without [`LEAF`]) from the index of the node: in several words, where one cannot say it.
pub(crate) fn collapse(
    nodes: &[Node],
    bounds: &[Aabb],
    mut leaf: impl FnMut(u32, &mut Vec<u32>),
) -> Vec<WideNode> {
    let mut wide = vec![WideNode::EMPTY];
    // Binary nodes with the places of their wide nodes.
    let mut pending = vec![(0_u32, 0_usize)];
    let mut words = Vec::new();
    while let Some((root, place)) = pending.pop() {
        let treelet = Treelet::grow(nodes, bounds, root);
        let mut node = WideNode::EMPTY;
        for (lane, &Slot { node: end, bounds }) in treelet.ends.iter().enumerate() {
            let child = match nodes[end as usize].kind() {
                Kind::Leaf { .. } => {
                    words.clear();
                    leaf(end, &mut words);
                    words.iter_mut().for_each(|word| *word |= LEAF);
                    gather(&mut wide, &mut words, bounds)
                }
                Kind::Inner { .. } => {
                    pending.push((end, wide.len()));
                    wide.push(WideNode::EMPTY);
                    wide.len() as u32 - 1
                }
            };
            node.set(lane, bounds, child);
        }
        node.orders = std::array::from_fn(|octant| treelet.order(nodes, root, octant));
        wide[place] = node;
    }
    wide
}

/// One child that stands for all of `children`, which lie in the same box.
fn gather(wide: &mut Vec<WideNode>, children: &mut Vec<u32>, bounds: Aabb) -> u32 {
    while children.len() > 1 {
        let parents = children.chunks(LANES).map(|group| {
            let mut node = WideNode::EMPTY;
            group.iter().enumerate().for_each(|(lane, &child)| node.set(lane, bounds, child));
            wide.push(node);
            wide.len() as u32 - 1
        });
        *children = parents.collect();
    }
    children[0]
}

/// The upper part of a subtree.
struct Treelet {
    /// Nodes inside it.
    opened: Vec<u32>,
    /// Its lower ends that are not empty, at most as many as there are lanes, from left to right.
    ends: Vec<Slot>,
}

impl Treelet {
    /// Opens the node with the largest box again and again.
    fn grow(nodes: &[Node], bounds: &[Aabb], root: u32) -> Self {
        let mut treelet = Self { opened: Vec::new(), ends: Vec::new() };
        let slot = |node: u32| Slot { node, bounds: bounds[node as usize] };
        treelet.ends.push(slot(root));
        while treelet.ends.len() < LANES {
            let inner = treelet.ends.iter().enumerate().filter_map(|(i, end)| {
                match nodes[end.node as usize].kind() {
                    Kind::Inner { left, .. } => Some((i, left, end.bounds.surface_area())),
                    Kind::Leaf { .. } => None,
                }
            });
            let Some((i, left, _)) = inner.max_by(|a, b| a.2.total_cmp(&b.2)) else { break };
            treelet.opened.push(treelet.ends[i].node);
            treelet
                .ends
                .splice(i..=i, [slot(left), slot(left + 1)].into_iter().filter(|s| !s.bounds.is_empty()));
        }
        treelet.ends.retain(|end| !end.bounds.is_empty());
        treelet
    }

    /// The lanes from the first that a ray of this octant meets to the last, and then those without a child.
    fn order(&self, nodes: &[Node], root: u32, octant: usize) -> u32 {
        let (mut order, mut places) = (0, 0);
        let mut put = |lane: usize| {
            order |= (lane as u32) << (3 * places);
            places += 1;
        };
        let mut pending = vec![root];
        while let Some(node) = pending.pop() {
            match nodes[node as usize].kind() {
                Kind::Inner { axis, left, .. } if self.opened.contains(&node) => {
                    let far_is_right = octant >> axis & 1 == 0;
                    pending.extend(if far_is_right { [left + 1, left] } else { [left, left + 1] });
                }
                _ => self.ends.iter().position(|end| end.node == node).into_iter().for_each(&mut put),
            }
        }
        (self.ends.len()..LANES).for_each(put);
        order
    }
}
