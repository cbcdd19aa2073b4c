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
    let plans = Plans::new(nodes, bounds);
    let mut wide = vec![WideNode::EMPTY];
    // Binary nodes with the places of their wide nodes.
    let mut pending = vec![(0_u32, 0_usize)];
    let mut words = Vec::new();
    while let Some((root, place)) = pending.pop() {
        let treelet = Treelet::of(nodes, bounds, &plans, root);
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

/// For each binary node, how it is best stood for by wide nodes.
///
/// # Source
/// Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, section 3.1
/// (dynamic programming over the number of roots).
struct Plans(Vec<Plan>);

/// The least expected work for a subtree below `i + 1` roots.
#[derive(Clone, Copy)]
struct Plan {
    work: [f32; LANES],
    /// Of these roots, how many fall to the left side; 0 where the node itself is the only root.
    left: [u8; LANES],
    /// The same for the children of the wide node that stands for it.
    left_below: u8,
}

impl Plans {
    fn new(nodes: &[Node], bounds: &[Aabb]) -> Self {
        let mut plans = vec![Plan { work: [0.0; LANES], left: [0; LANES], left_below: 0 }; nodes.len()];
        // Children lie behind their parents.
        for (i, node) in nodes.iter().enumerate().rev() {
            if let Kind::Inner { left, .. } = node.kind() {
                let children = [left as usize, left as usize + 1].map(|child| {
                    let is_empty = bounds[child].is_empty();
                    (!is_empty).then_some(plans[child])
                });
                plans[i] = Plan::of_inner(bounds[i].surface_area() as f32, children);
            }
        }
        Self(plans)
    }
}

impl Plan {
    fn of_inner(area: f32, children: [Option<Self>; 2]) -> Self {
        let [left, right] = match children {
            [Some(left), Some(right)] => [left, right],
            // An empty side needs no root: the node is what the other side is.
            [Some(only), None] | [None, Some(only)] => return only,
            [None, None] => return Self { work: [0.0; LANES], left: [0; LANES], left_below: 0 },
        };
        let split = |roots: usize| {
            let works = (1..roots).map(|k| (left.work[k - 1] + right.work[roots - k - 1], k as u8));
            works.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f32::INFINITY, 0))
        };
        let (below, left_below) = split(LANES);
        let mut plan = Self { work: [area + below; LANES], left: [0; LANES], left_below };
        for roots in 2..=LANES {
            let (work, left) = split(roots);
            if work < plan.work[roots - 1] {
                (plan.work[roots - 1], plan.left[roots - 1]) = (work, left);
            }
        }
        plan
    }
}

/// The upper part of a subtree.
struct Treelet {
    /// Nodes inside it.
    opened: Vec<u32>,
    /// Its lower ends that are not empty, at most as many as there are lanes, from left to right.
    ends: Vec<Slot>,
}

impl Treelet {
    /// The treelet of the wide node that stands for `root`.
    fn of(nodes: &[Node], bounds: &[Aabb], plans: &Plans, root: u32) -> Self {
        let mut treelet = Self { opened: Vec::with_capacity(LANES), ends: Vec::with_capacity(LANES) };
        let mut pending = Vec::with_capacity(LANES);
        pending.push((root, LANES));
        while let Some((node, roots)) = pending.pop() {
            let at = node as usize;
            if bounds[at].is_empty() {
                continue;
            }
            let plan = &plans.0[at];
            let left_roots = if node == root { plan.left_below } else { plan.left[roots - 1] } as usize;
            match nodes[at].kind() {
                Kind::Inner { left, .. } => {
                    let halves = [left, left + 1].map(|child| bounds[child as usize].is_empty());
                    if halves[0] || halves[1] {
                        treelet.opened.push(node);
                        pending.extend([(left + 1, roots), (left, roots)]);
                    } else if left_roots > 0 {
                        treelet.opened.push(node);
                        pending.extend([(left + 1, roots - left_roots), (left, left_roots)]);
                    } else {
                        treelet.ends.push(Slot { node, bounds: bounds[at] });
                    }
                }
                Kind::Leaf { .. } => treelet.ends.push(Slot { node, bounds: bounds[at] }),
            }
        }
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
