//! A density over directions while it is learnt: what light was found, in the squares of a quadtree, and what is to become of it.
//!
//! # Source
//! Müller, Gross, Novák 2017, section 3.2 (where squares are divided); Müller 2019, sections 10.3 (box filter) and 10.5 (the share
//! of the surface, by the divergence of Kullback and Leibler; here the best of a few shares instead of a descent).

use super::directions::{Directions, Node, quarter_of, within};
use super::trail::Record;
use glam::Vec2;

/// A square is divided where it holds more than this share of all.
const LARGEST_SHARE: f32 = 0.03;
/// So often, at most.
const MOST_DEPTH: u32 = 14;
/// Nodes of a tree, at most.
const MOST_NODES: usize = 512;

/// Shares of the surface that are tried.
const OWN_SHARES: [f32; 9] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];
/// The share where nothing is known.
pub(super) const UNKNOWN: f32 = 0.5;

/// What was found around a place in one turn.
#[derive(Clone, Debug)]
pub(super) struct Growth {
    /// Values of quarters that are divided are 0.
    nodes: Vec<Node>,
    /// By [`OWN_SHARES`]: the mean logarithm of the density, by the light that was sent on, times the number of records.
    evidence: [f32; OWN_SHARES.len()],
}

/// What a new tree is made from.
#[derive(Clone, Copy)]
enum Old {
    /// A node of the tree before.
    Node(u32),
    /// A square that was not divided, with what it held.
    Even(f32),
}

impl Growth {
    /// One that takes all directions for the same.
    pub(super) fn new() -> Self {
        Self { nodes: vec![Node::default()], evidence: [0.0; OWN_SHARES.len()] }
    }

    /// Lays down what was found.
    pub(super) fn add(&mut self, record: &Record) {
        let Record { sent, lead, .. } = record;
        let u = within(record.dir);
        let size = self.size_at(u);
        // A box of the size of the square, around the direction. There is no way around over the poles, but there is one around
        // the axis.
        let low = Vec2::new(u.x - 0.5 * size, (u.y - 0.5 * size).clamp(0.0, 1.0 - size));
        for turn in [-1.0, 0.0, 1.0] {
            let low = low + Vec2::new(turn, 0.0);
            if low.x < 1.0 && low.x + size > 0.0 {
                self.spread(0, (Vec2::ZERO, 0.5), (low, size), sent / (size * size));
            }
        }
        let Some(odds) = lead else { return };
        for (evidence, own) in self.evidence.iter_mut().zip(OWN_SHARES) {
            *evidence += sent * (odds.mixed(own) / record.pdf).ln();
        }
    }

    /// The side of the undivided square that holds a point.
    fn size_at(&self, mut u: Vec2) -> f32 {
        let (mut size, mut at) = (0.5, 0);
        loop {
            at = self.nodes[at].below[quarter_of(&mut u)] as usize;
            if at == 0 {
                return size;
            }
            size *= 0.5;
        }
    }

    /// Adds what a box holds to the quarters of a node with that corner, which are `side` wide.
    fn spread(&mut self, at: u32, (corner, side): (Vec2, f32), (low, size): (Vec2, f32), density: f32) {
        for quarter in 0..4 {
            let corner = corner + side * Vec2::new((quarter & 1) as f32, (quarter >> 1) as f32);
            let common = (corner + side).min(low + size) - corner.max(low);
            if common.min_element() <= 0.0 {
                continue;
            }
            match self.nodes[at as usize].below[quarter] {
                0 => self.nodes[at as usize].values[quarter] += density * common.x * common.y,
                below => self.spread(below, (corner, 0.5 * side), (low, size), density),
            }
        }
    }

    /// What lies in all quarters of all nodes, those that are divided included.
    fn summed(&self) -> Vec<Node> {
        let mut nodes = self.nodes.clone();
        // Children stand behind their parents.
        for i in (0..nodes.len()).rev() {
            for quarter in 0..4 {
                let below = nodes[i].below[quarter] as usize;
                if below != 0 {
                    nodes[i].values[quarter] = nodes[below].values.iter().sum();
                }
            }
        }
        nodes
    }

    /// All that was found.
    #[cfg(test)]
    pub(super) fn found(&self) -> f32 {
        self.summed()[0].values.iter().sum()
    }

    /// The density that was learnt.
    pub(super) fn directions(&self) -> Option<Directions> {
        Directions::new(self.summed())
    }

    /// The share of the surface for which the mixture comes closest to what was sent on.
    pub(super) fn own(&self) -> f32 {
        let best = |a: usize, b: usize| if self.evidence[b] > self.evidence[a] { b } else { a };
        let first = self.evidence[0];
        if self.evidence.iter().all(|evidence| *evidence == first) {
            return UNKNOWN;
        }
        OWN_SHARES[(1..OWN_SHARES.len()).fold(0, best)]
    }

    /// An empty one for the next turn, divided where this one has found much.
    pub(super) fn refined(&self) -> Self {
        let old = self.summed();
        let all: f32 = old[0].values.iter().sum();
        let mut new = Self { nodes: Vec::new(), ..Self::new() };
        new.divide(&old, Old::Node(0), 1, LARGEST_SHARE * all);
        new
    }

    /// Appends a node, and those below it whose squares hold more than `most`; its index.
    fn divide(&mut self, old: &[Node], from: Old, depth: u32, most: f32) -> u32 {
        let index = self.nodes.len();
        self.nodes.push(Node::default());
        for quarter in 0..4 {
            let (value, below) = match from {
                Old::Node(node) => (old[node as usize].values[quarter], old[node as usize].below[quarter]),
                Old::Even(value) => (0.25 * value, 0),
            };
            if value > most && depth < MOST_DEPTH && self.nodes.len() < MOST_NODES {
                let from = if below == 0 { Old::Even(value) } else { Old::Node(below) };
                self.nodes[index].below[quarter] = self.divide(old, from, depth + 1, most);
            }
        }
        index as u32
    }
}
