//! Building the tree: binary, by the cheapest of a few cuts, then eight subtrees to a node.

use super::{LIGHT, LightTree, Node, Place};
use crate::light::beams::{Beams, WIDTH};
use crate::light::cluster::Cluster;
use glam::Vec3;
use heliostat_geometry::Aabb;
use std::ops::Range;

/// Bins in which the best cut is looked for.
const BINS: usize = 12;
/// Below this level lights are cut in halves by their order, so that no input makes a deep tree.
const DEEPEST_CHOICE: u32 = 32;
/// Below this many lights threads have nothing to share.
const LARGE: usize = 4096;

/// The binary tree.
struct Branch {
    cluster: Cluster,
    next: Next,
}

enum Next {
    Light(u32),
    Both(Box<[Branch; 2]>),
}

/// A tree over at least one light.
pub(super) fn tree(lights: &[Cluster]) -> LightTree {
    let mut order: Vec<u32> = (0..lights.len() as u32).collect();
    let root = branch(lights, &mut order, 0);
    let mut tree = LightTree { nodes: Vec::new(), places: vec![Place::default(); lights.len()] };
    tree.add(&root, Place::default());
    tree
}

/// The branch over the lights of `order`.
fn branch(lights: &[Cluster], order: &mut [u32], depth: u32) -> Branch {
    if let [light] = *order {
        return Branch { cluster: lights[light as usize], next: Next::Light(light) };
    }
    let cut = cut(lights, order, depth);
    let is_large = order.len() > LARGE;
    let (left, right) = order.split_at_mut(cut);
    let (mut left, mut right) = (|| branch(lights, left, depth + 1), || branch(lights, right, depth + 1));
    let both = if is_large { rayon::join(left, right) } else { (left(), right()) };
    Branch { cluster: both.0.cluster.union(both.1.cluster), next: Next::Both(Box::new(both.into())) }
}

impl LightTree {
    /// Adds the node of a branch, and all below it; its index.
    fn add(&mut self, branch: &Branch, place: Place) -> u32 {
        let node = self.nodes.len() as u32;
        self.nodes.push(Node { beams: Beams::NONE, children: [0; WIDTH], place });
        for (child, branch) in (0..).zip(opened(branch)) {
            let place = Place { node, child };
            let next = match branch.next {
                Next::Light(light) => {
                    self.places[light as usize] = place;
                    light | LIGHT
                }
                Next::Both(_) => self.add(branch, place),
            };
            let node = &mut self.nodes[node as usize];
            node.beams.set(child as usize, &branch.cluster);
            node.children[child as usize] = next;
        }
        node
    }
}

/// The subtrees that take the place of a branch: always the costliest is opened.
fn opened(branch: &Branch) -> Vec<&Branch> {
    let mut open = vec![branch];
    let cost = |branch: &&Branch| match &branch.next {
        Next::Light(_) => f64::NEG_INFINITY,
        Next::Both(_) => branch_cost(&branch.cluster),
    };
    while open.len() < WIDTH {
        let costs = open.iter().map(cost).enumerate();
        let Some((costliest, _)) = costs.max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        let Next::Both(both) = &open[costliest].next else { break };
        open[costliest] = &both[0];
        open.push(&both[1]);
    }
    open
}

fn branch_cost(cluster: &Cluster) -> f64 {
    f64::from(cluster.cost()) * cluster.bounds.surface_area()
}

/// Brings lights into two groups that lie and shine together; the size of the first.
fn cut(lights: &[Cluster], order: &mut [u32], depth: u32) -> usize {
    let centre = |light: &u32| lights[*light as usize].bounds.centre();
    let centres = Aabb::of_points(order.iter().map(centre));
    let best = if depth < DEEPEST_CHOICE { best_plane(lights, order, centres) } else { None };
    if let Some((axis, bin)) = best {
        let cut = partition(order, |light| bin_of(centres, axis, centre(light)) <= bin);
        if cut > 0 && cut < order.len() {
            return cut;
        }
    }
    let axis = centres.longest_axis();
    order.sort_by(|a, b| centre(a)[axis].total_cmp(&centre(b)[axis]));
    order.len() / 2
}

/// Brings to the front what is `first`; how many these are.
fn partition(order: &mut [u32], first: impl Fn(&u32) -> bool) -> usize {
    let mut count = 0;
    for i in 0..order.len() {
        if first(&order[i]) {
            order.swap(i, count);
            count += 1;
        }
    }
    count
}

/// The axis and the last bin of the first group of the cheapest cut; `None` where all lie in one place.
fn best_plane(lights: &[Cluster], order: &[u32], centres: Aabb) -> Option<(usize, usize)> {
    let size = centres.size();
    let mut best: Option<(f64, (usize, usize))> = None;
    for axis in (0..3).filter(|&axis| size[axis] > 0.0) {
        let mut bins: [Option<Cluster>; BINS] = [None; BINS];
        for &light in order {
            let cluster = lights[light as usize];
            let bin = &mut bins[bin_of(centres, axis, cluster.bounds.centre())];
            *bin = join(*bin, Some(cluster));
        }
        // Thin boxes cost more: a cut across their length is better.
        let shape = f64::from(size.max_element() / size[axis]);
        let cost = |range: Range<usize>| {
            let all = bins[range].iter().copied().fold(None, join);
            all.map(|all| branch_cost(&all))
        };
        for bin in 0..BINS - 1 {
            if let (Some(left), Some(right)) = (cost(0..bin + 1), cost(bin + 1..BINS)) {
                let cost = shape * (left + right);
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, (axis, bin)));
                }
            }
        }
    }
    best.map(|(_, plane)| plane)
}

/// The union of what is there.
fn join(a: Option<Cluster>, b: Option<Cluster>) -> Option<Cluster> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(b)),
        (one, None) | (None, one) => one,
    }
}

/// The bin of a point along an axis.
fn bin_of(centres: Aabb, axis: usize, p: Vec3) -> usize {
    let share = (p[axis] - centres.min[axis]) / centres.size()[axis];
    ((share * BINS as f32) as usize).min(BINS - 1)
}
