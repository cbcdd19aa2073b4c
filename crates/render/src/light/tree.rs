//! A tree over lights that chooses one by what a point may expect of it: ten thousand cost little more than ten.
//!
//! # Source
//! See [`super::cluster`].

use super::cluster::{Beam, Cluster};
use glam::Vec3;
use heliostat_geometry::Aabb;
use std::ops::Range;

/// Bins in which the builder looks for the best cut.
const BINS: usize = 12;
/// Below this level lights are cut in halves by their order, so that a way down fits into 64 bits.
const DEEPEST_CHOICE: u32 = 24;

/// A tree of clusters. The left child of a node follows it.
#[derive(Debug)]
pub(super) struct LightTree {
    nodes: Vec<Node>,
    /// Turns on the way down to each light, the first in the lowest bit.
    ways: Vec<u64>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    beam: Beam,
    next: Next,
}

#[derive(Clone, Copy, Debug)]
enum Next {
    /// The right child.
    Right(u32),
    /// The one light here.
    Light(u32),
}

impl LightTree {
    /// A tree over lights; `None` without any.
    pub(super) fn new(lights: &[Cluster]) -> Option<Self> {
        let mut order: Vec<u32> = (0..lights.len() as u32).collect();
        let mut tree = Self { nodes: Vec::with_capacity(2 * lights.len()), ways: vec![0; lights.len()] };
        if lights.is_empty() {
            return None;
        }
        tree.build(lights, &mut order, 0, 0);
        Some(tree)
    }

    /// Adds a node over the lights of `order`, at the end of `way`.
    fn build(&mut self, lights: &[Cluster], order: &mut [u32], way: u64, depth: u32) -> Cluster {
        let place = self.nodes.len();
        if let [light] = *order {
            let cluster = lights[light as usize];
            self.ways[light as usize] = way;
            self.nodes.push(Node { beam: cluster.beam(), next: Next::Light(light) });
            return cluster;
        }
        // Holds the place until both children are known.
        self.nodes.push(Node { beam: lights[order[0] as usize].beam(), next: Next::Right(0) });
        let cut = cut(lights, order, depth);
        let (left, right) = order.split_at_mut(cut);
        let left = self.build(lights, left, way, depth + 1);
        let right_place = self.nodes.len() as u32;
        let right = self.build(lights, right, way | 1 << depth, depth + 1);
        let cluster = left.union(right);
        self.nodes[place] = Node { beam: cluster.beam(), next: Next::Right(right_place) };
        cluster
    }

    /// About the irradiance from all lights.
    #[inline]
    pub(super) fn importance(&self, p: Vec3, n: Vec3) -> f32 {
        self.nodes[0].beam.importance(p, n)
    }

    /// A light for a point, and its probability; `None` where no light reaches it.
    #[inline]
    pub(super) fn pick(&self, p: Vec3, n: Vec3, mut u: f32) -> Option<(usize, f32)> {
        let (mut place, mut probability) = (0, 1.0);
        loop {
            match self.nodes[place].next {
                Next::Light(light) => return Some((light as usize, probability)),
                Next::Right(right) => {
                    let left = self.left_share(place, right, p, n)?;
                    if u < left {
                        (place, probability) = (place + 1, probability * left);
                        u /= left;
                    } else {
                        (place, probability) = (right as usize, probability * (1.0 - left));
                        u = (u - left) / (1.0 - left);
                    }
                }
            }
        }
    }

    /// The probability with which [`Self::pick`] chooses a light.
    #[inline]
    pub(super) fn probability(&self, p: Vec3, n: Vec3, light: usize) -> f32 {
        let (mut place, mut probability, mut way) = (0, 1.0, self.ways[light]);
        while let Next::Right(right) = self.nodes[place].next {
            let Some(left) = self.left_share(place, right, p, n) else { return 0.0 };
            if way & 1 == 0 {
                (place, probability) = (place + 1, probability * left);
            } else {
                (place, probability) = (right as usize, probability * (1.0 - left));
            }
            way >>= 1;
        }
        probability
    }

    /// The probability of the left child; `None` where neither sends light.
    #[inline]
    fn left_share(&self, place: usize, right: u32, p: Vec3, n: Vec3) -> Option<f32> {
        let left = self.nodes[place + 1].beam.importance(p, n);
        let sum = left + self.nodes[right as usize].beam.importance(p, n);
        (sum > 0.0).then(|| left / sum)
    }
}

/// Brings lights into two groups that lie and shine together; the size of the first.
fn cut(lights: &[Cluster], order: &mut [u32], depth: u32) -> usize {
    let centre = |light: &u32| lights[*light as usize].bounds.centre();
    let centres = Aabb::of_points(order.iter().map(centre));
    let best = if depth < DEEPEST_CHOICE { best_plane(lights, order, centres) } else { None };
    if let Some((axis, bin)) = best {
        order.sort_by_key(|light| bin_of(centres, axis, centre(light)));
        let cut = order.partition_point(|light| bin_of(centres, axis, centre(light)) <= bin);
        if cut > 0 && cut < order.len() {
            return cut;
        }
    }
    let axis = centres.longest_axis();
    order.sort_by(|a, b| centre(a)[axis].total_cmp(&centre(b)[axis]));
    order.len() / 2
}

/// The axis and the last bin of the first group of the cheapest cut; `None` where all lie in one place.
fn best_plane(lights: &[Cluster], order: &[u32], centres: Aabb) -> Option<(usize, usize)> {
    let size = centres.size();
    let mut best: Option<(f32, (usize, usize))> = None;
    for axis in (0..3).filter(|&axis| size[axis] > 0.0) {
        let mut bins: [Option<Cluster>; BINS] = [None; BINS];
        for &light in order {
            let cluster = lights[light as usize];
            let bin = &mut bins[bin_of(centres, axis, cluster.bounds.centre())];
            *bin = join(*bin, Some(cluster));
        }
        // Thin boxes cost more: a cut across their length is better.
        let shape = size.max_element() / size[axis];
        let cost = |range: Range<usize>| {
            let all = bins[range].iter().copied().fold(None, join);
            all.map(|all| all.cost() * all.bounds.surface_area() as f32)
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

#[cfg(test)]
mod tests {
    use super::super::cluster::Cone;
    use super::*;
    use crate::sampler::Sampler;
    use std::f32::consts::{FRAC_PI_2, PI};

    /// Lamps in a cube of side 10, small and large, weak and strong, turned anyhow.
    fn lights(count: u32) -> Vec<Cluster> {
        let light = |i: u32| {
            let mut draws = Sampler::new(3, [0, 0], i);
            let p = 10.0 * draws.next_2d().extend(draws.next_1d());
            let axis = heliostat_geometry::warp::square_to_sphere(draws.next_2d());
            let size = 0.2 * draws.next_1d();
            Cluster {
                bounds: Aabb { min: p, max: p + size },
                intensity: 0.01 + draws.next_1d(),
                normals: Cone { axis, angle: if i.is_multiple_of(3) { PI } else { 0.0 } },
                spread: FRAC_PI_2,
                two_sided: i.is_multiple_of(5),
            }
        };
        (0..count).map(light).collect()
    }

    #[test]
    fn lights_are_picked_as_often_as_they_say() {
        let lights = lights(60);
        let tree = LightTree::new(&lights).unwrap();
        for (p, n) in
            [(Vec3::splat(5.0), Vec3::Y), (Vec3::new(-20.0, 3.0, 1.0), Vec3::X), (Vec3::ZERO, Vec3::Z)]
        {
            let count = 1 << 16;
            let (mut picks, mut missed) = (vec![0_u32; lights.len()], 0_u32);
            for i in 0..count {
                // Below a cluster that might send light there may be none that does.
                let Some((light, probability)) = tree.pick(p, n, (i as f32 + 0.5) / count as f32) else {
                    missed += 1;
                    continue;
                };
                assert!((tree.probability(p, n, light) / probability - 1.0).abs() < 1e-4);
                picks[light] += 1;
            }
            let sum: f32 = (0..lights.len()).map(|light| tree.probability(p, n, light)).sum();
            assert!((sum + missed as f32 / count as f32 - 1.0).abs() < 1e-3, "{sum} {missed}");
            for (light, picked) in picks.into_iter().enumerate() {
                let expected = tree.probability(p, n, light) * count as f32;
                assert!((picked as f32 - expected).abs() < 3.0, "{light}: {picked} for {expected}");
            }
        }
    }

    #[test]
    fn no_light_that_reaches_a_point_is_forgotten() {
        let lights = lights(500);
        let tree = LightTree::new(&lights).unwrap();
        for i in 0..50 {
            let mut draws = Sampler::new(9, [0, 0], i);
            let p = 20.0 * draws.next_2d().extend(draws.next_1d()) - 5.0;
            let n = heliostat_geometry::warp::square_to_sphere(draws.next_2d());
            for (light, cluster) in lights.iter().enumerate() {
                let reaches = cluster.beam().importance(p, n) > 0.0;
                assert!(!reaches || tree.probability(p, n, light) > 0.0, "{light} {cluster:?}");
            }
        }
    }

    #[test]
    fn lamps_in_one_place_make_a_tree_all_the_same() {
        let lamp = lights(1)[0];
        let tree = LightTree::new(&vec![lamp; 1000]).unwrap();
        let probability = tree.probability(Vec3::splat(-3.0), Vec3::Y, 77);
        assert!(probability == 0.0 || (probability * 1000.0 - 1.0).abs() < 0.1, "{probability}");
    }
}
