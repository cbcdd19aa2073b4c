//! A tree over places: leaves hold about as many scatterings of light each, wherever in the scene they are.
//!
//! Cells are cut in two at the median along the axis in which their points lie widest apart; so the tree needs no box around the
//! scene, and neither a floor without end nor a far-off thing wastes leaves.
//!
//! # Source
//! Müller, Gross, Novák 2017, section 3.1, which cuts in the middle; Bentley, "Multidimensional Binary Search Trees Used for
//! Associative Searching", CACM 1975, for the median.

use glam::{DVec3, Vec3};

/// Leaves, at most.
const MOST_LEAVES: u32 = 1 << 13;

/// A tree over all of space.
#[derive(Clone, Debug)]
pub(super) struct Places {
    nodes: Vec<Node>,
    leaves: u32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Node {
    /// Below `at` along the axis lies the first child, behind which stands the other.
    Cut {
        axis: u8,
        at: f32,
        first: u32,
    },
    Leaf(u32),
}

impl Places {
    /// One leaf.
    pub(super) fn new() -> Self {
        Self { nodes: vec![Node::Leaf(0)], leaves: 1 }
    }

    /// The leaf that holds a point.
    #[inline]
    pub(super) fn leaf(&self, p: Vec3) -> u32 {
        let mut at = 0;
        loop {
            match self.nodes[at as usize] {
                Node::Leaf(leaf) => return leaf,
                Node::Cut { axis, at: cut, first } => at = first + u32::from(p[axis.into()] >= cut),
            }
        }
    }

    /// Cuts leaves that hold more than `most` of the points. What each leaf comes from: those from before keep their
    /// numbers.
    pub(super) fn divide(&mut self, points: &[Vec3], most: usize) -> Vec<u32> {
        let mut held = vec![Vec::new(); self.leaves as usize];
        points.iter().for_each(|&p| held[self.leaf(p) as usize].push(p));
        let mut origins: Vec<u32> = (0..self.leaves).collect();
        for at in 0..self.nodes.len() {
            if let Node::Leaf(leaf) = self.nodes[at] {
                let points = std::mem::take(&mut held[leaf as usize]);
                self.cut(at, points, most, &mut origins);
            }
        }
        origins
    }

    /// Cuts a leaf until none of its parts holds more than `most` points.
    fn cut(&mut self, at: usize, mut points: Vec<Vec3>, most: usize, origins: &mut Vec<u32>) {
        let Node::Leaf(leaf) = self.nodes[at] else { return };
        if points.len() <= most.max(1) || self.leaves >= MOST_LEAVES {
            return;
        }
        let axis = widest(&points);
        let middle = points.len() / 2;
        let cut = points.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis])).1[axis];
        let (below, above): (Vec<_>, Vec<_>) = points.into_iter().partition(|p| p[axis] < cut);
        if below.is_empty() {
            return;
        }
        let (first, other) = (self.nodes.len(), self.leaves);
        self.nodes[at] = Node::Cut { axis: axis as u8, at: cut, first: first as u32 };
        self.nodes.extend([Node::Leaf(leaf), Node::Leaf(other)]);
        self.leaves += 1;
        origins.push(origins[leaf as usize]);
        self.cut(first, below, most, origins);
        self.cut(first + 1, above, most, origins);
    }
}

/// The axis along which points lie widest apart, by their variance.
fn widest(points: &[Vec3]) -> usize {
    let n = points.len() as f64;
    let mean = points.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / n;
    let squares: DVec3 = points.iter().map(|p| (p.as_dvec3() - mean).powf(2.0)).sum();
    (0..3).fold(0, |best, axis| if squares[axis] > squares[best] { axis } else { best })
}
