//! From binary nodes to wide ones.

use super::plans::Plans;
use super::{LEAF, WideNode};
use crate::bsp::node::{Kind, Node};
use crate::parallel;
use crate::simd::LANES;
use heliostat_geometry::Aabb;

/// Subtrees so many wide nodes below the root are made in parallel.
const TOP_LEVELS: u32 = 3;

/// Makes wide nodes of a binary tree. `bounds` has the box of the content of each node; `leaf` writes what the child of a
/// leaf says (without [`LEAF`]) from the index of the node: in several words, where one cannot say it.
pub(crate) fn collapse(
    nodes: &[Node],
    bounds: &[Aabb],
    leaf: impl Fn(u32, &mut Vec<u32>) + Sync,
) -> Vec<WideNode> {
    let tree = Collapse { nodes, bounds, plans: Plans::new(nodes, bounds), leaf };
    let mut grafts = Vec::new();
    let top = tree.lay(0, TOP_LEVELS, |root, place, before| grafts.push((root, place, before)));
    let subtrees = parallel::map_each(grafts, |(root, place, before)| Graft {
        nodes: tree.lay(root, u32::MAX, |_, _, _| {}),
        place,
        before,
    });
    joined(top, &subtrees)
}

/// A subtree, its root first.
struct Graft {
    nodes: Vec<WideNode>,
    /// The place for its root in the top.
    place: usize,
    /// Nodes of the top that come before all the others of its nodes.
    before: usize,
}

/// The top with its subtrees, each behind those nodes of the top that were there before it.
fn joined(mut top: Vec<WideNode>, subtrees: &[Graft]) -> Vec<WideNode> {
    // How many nodes the subtrees before each have behind their roots; and where its own begin.
    let (mut moved, mut begins) = (vec![0], Vec::with_capacity(subtrees.len()));
    let mut sum = 0;
    for subtree in subtrees {
        begins.push(subtree.before + sum);
        sum += subtree.nodes.len() - 1;
        moved.push(sum);
    }
    let place_of_top = |i: usize| i + moved[subtrees.partition_point(|subtree| subtree.before <= i)];
    top.iter_mut().for_each(|node| node.renumber(place_of_top));
    let node_of = |subtree: usize, i: usize| {
        let mut node = subtrees[subtree].nodes[i];
        node.renumber(|child| begins[subtree] + child - 1);
        node
    };
    for (number, subtree) in subtrees.iter().enumerate() {
        top[subtree.place] = node_of(number, 0);
    }
    parallel::map_numbers(top.len() + sum, |i| {
        let Some(last) = begins.partition_point(|begin| *begin <= i).checked_sub(1) else { return top[i] };
        let (Graft { nodes, before, .. }, offset) = (&subtrees[last], i - begins[last] + 1);
        if offset < nodes.len() { node_of(last, offset) } else { top[before + offset - nodes.len()] }
    })
}

/// A binary tree on its way.
struct Collapse<'a, F> {
    nodes: &'a [Node],
    bounds: &'a [Aabb],
    plans: Plans,
    leaf: F,
}

impl<F: Fn(u32, &mut Vec<u32>)> Collapse<'_, F> {
    /// The wide nodes of a subtree, its root first, down to so many levels. `deeper` is told of what is below: the root, its
    /// place, and how many nodes come before the others, in the order in which they would have been laid out.
    fn lay(&self, root: u32, levels: u32, mut deeper: impl FnMut(u32, usize, usize)) -> Vec<WideNode> {
        let mut wide = vec![WideNode::EMPTY];
        let mut pending = vec![(root, 0, levels)];
        let (mut treelet, mut words) = (Treelet::default(), Vec::new());
        while let Some((root, place, levels)) = pending.pop() {
            if levels == 0 {
                deeper(root, place, wide.len());
                continue;
            }
            treelet.clear();
            self.open(&mut treelet, root, self.plans.left_below(root), LANES);
            let mut node = WideNode::EMPTY;
            for (lane, &end) in treelet.ends.iter().enumerate() {
                let bounds = self.bounds[end as usize];
                let child = match self.nodes[end as usize].kind() {
                    Kind::Leaf { .. } => {
                        words.clear();
                        (self.leaf)(end, &mut words);
                        words.iter_mut().for_each(|word| *word |= LEAF);
                        gather(&mut wide, &mut words, bounds)
                    }
                    Kind::Inner { .. } => {
                        pending.push((end, wide.len(), levels - 1));
                        wide.push(WideNode::EMPTY);
                        wide.len() as u32 - 1
                    }
                };
                node.set(lane, bounds, child);
            }
            node.orders = std::array::from_fn(|octant| treelet.order(octant));
            wide[place] = node;
        }
        wide
    }

    /// Adds a node below so many roots to a treelet: `left_roots` of them stand for its left side, or it is an end for 0.
    fn open(&self, treelet: &mut Treelet, node: u32, left_roots: usize, roots: usize) {
        let is_empty = |node: u32| self.bounds[node as usize].is_empty();
        let add = |treelet: &mut Treelet, child: u32, roots: usize| {
            self.open(treelet, child, self.plans.left(child, roots), roots);
        };
        match self.nodes[node as usize].kind() {
            _ if is_empty(node) => {}
            Kind::Inner { left, .. } if is_empty(left) || is_empty(left + 1) => {
                add(treelet, left, roots);
                add(treelet, left + 1, roots);
            }
            Kind::Inner { axis, left, .. } if left_roots > 0 => {
                let first = treelet.ends.len();
                add(treelet, left, left_roots);
                let middle = treelet.ends.len();
                add(treelet, left + 1, roots - left_roots);
                treelet.cuts.push(Cut { axis, first, middle, end: treelet.ends.len() });
            }
            _ => treelet.ends.push(node),
        }
    }
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
#[derive(Default)]
struct Treelet {
    /// The cuts inside it, children before parents.
    cuts: Vec<Cut>,
    /// Its lower ends that are not empty, at most as many as there are lanes, from left to right.
    ends: Vec<u32>,
}

/// A plane, with the ends `first .. middle` below it and `middle .. end` above.
struct Cut {
    axis: usize,
    first: usize,
    middle: usize,
    end: usize,
}

impl Treelet {
    fn clear(&mut self) {
        self.cuts.clear();
        self.ends.clear();
    }

    /// The lanes from the first that a ray of this octant meets to the last, and then those without a child.
    fn order(&self, octant: usize) -> u32 {
        let mask = |lanes: usize| (1 << (3 * lanes)) - 1;
        let upward = WideNode::EMPTY.orders[0];
        self.cuts.iter().filter(|cut| octant >> cut.axis & 1 != 0).fold(upward, |order, cut| {
            let (below, above) = (cut.middle - cut.first, cut.end - cut.middle);
            let lanes = order >> (3 * cut.first);
            // What lies above the plane is met first.
            let turned = (lanes >> (3 * below)) & mask(above) | (lanes & mask(below)) << (3 * above);
            order & !(mask(below + above) << (3 * cut.first)) | turned << (3 * cut.first)
        })
    }
}
