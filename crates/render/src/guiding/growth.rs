//! A density over directions while it is learnt: what light was found, in the squares of a quadtree, and what is to become of it.
//!
//! # Source
//! Müller, Gross, Novák 2017, section 3.2 (where squares are divided); Müller 2019, sections 10.3 (box filter) and 10.5 (the share
//! of the surface, by the divergence of Kullback and Leibler; here the best of a few shares instead of a descent).

use super::directions::{Directions, Node, quarter_of, within};
use super::trail::Record;
use glam::Vec2;

/// A square is divided where it holds more than this share of all.
const LARGEST_SHARE: f32 = 0.02;
/// And light was found in it so often: what few paths have found by chance is no reason to look nowhere else.
const LEAST_HITS: f32 = 3.0;
/// So often, at most.
const MOST_DEPTH: u32 = 14;
/// Nodes of a tree, at most.
const MOST_NODES: usize = 512;

/// What was found in a turn counts so much in the next one, which has twice the paths.
const KEPT: f32 = 0.5;

/// Shares of the surface that are tried. With less of it, what was not learnt becomes rare and bright; evidence for more is of what
/// was learnt a turn ago, and unfair to what is known now.
const OWN_SHARES: [f32; 4] = [0.3, 0.4, 0.5, 0.6];
/// The share where nothing is known.
pub(super) const UNKNOWN: f32 = 0.5;

/// What was found around a place: in a turn, and by halves in those before.
#[derive(Clone, Debug)]
pub(super) struct Growth {
    /// As of [`Node`].
    below: Vec<[u32; 4]>,
    /// By the quarters of nodes that are not divided: what was found there,
    light: Vec<[f32; 4]>,
    /// and how often.
    hits: Vec<[f32; 4]>,
    /// By [`OWN_SHARES`]: the logarithms of the density, by the light that was sent on.
    evidence: [f32; OWN_SHARES.len()],
}

/// What a tree has found in all quarters of all nodes, those that are divided included.
struct Sums {
    light: Vec<[f32; 4]>,
    hits: Vec<[f32; 4]>,
}

/// What a node of a new tree is made from.
#[derive(Clone, Copy)]
enum Old {
    /// A node of the tree before.
    Node(usize),
    /// A square that was not divided: the light in it, and how often some was found.
    Even(f32, f32),
}

impl Growth {
    /// One that takes all directions for the same.
    pub(super) fn new() -> Self {
        Self {
            below: vec![[0; 4]],
            light: vec![[0.0; 4]],
            hits: vec![[0.0; 4]],
            evidence: [0.0; OWN_SHARES.len()],
        }
    }

    /// Lays down what was found.
    pub(super) fn add(&mut self, record: &Record) {
        let Record { sent, lead, .. } = record;
        let u = within(record.dir);
        let (node, quarter, size) = self.square_at(u);
        self.hits[node][quarter] += 1.0;
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

    /// The undivided square that holds a point: a quarter of a node, and its side.
    fn square_at(&self, mut u: Vec2) -> (usize, usize, f32) {
        let (mut size, mut at) = (0.5, 0);
        loop {
            let quarter = quarter_of(&mut u);
            match self.below[at][quarter] {
                0 => return (at, quarter, size),
                below => at = below as usize,
            }
            size *= 0.5;
        }
    }

    /// Adds what a box holds to the quarters of a node with that corner, which are `side` wide.
    fn spread(&mut self, at: usize, (corner, side): (Vec2, f32), (low, size): (Vec2, f32), density: f32) {
        for quarter in 0..4 {
            let corner = corner + side * Vec2::new((quarter & 1) as f32, (quarter >> 1) as f32);
            let common = (corner + side).min(low + size) - corner.max(low);
            if common.min_element() <= 0.0 {
                continue;
            }
            match self.below[at][quarter] {
                0 => self.light[at][quarter] += density * common.x * common.y,
                below => self.spread(below as usize, (corner, 0.5 * side), (low, size), density),
            }
        }
    }

    /// The values of all quarters, from those that are not divided.
    fn summed(&self, mut values: Vec<[f32; 4]>) -> Vec<[f32; 4]> {
        // Children stand behind their parents.
        for i in (0..values.len()).rev() {
            for quarter in 0..4 {
                let below = self.below[i][quarter] as usize;
                if below != 0 {
                    values[i][quarter] = values[below].iter().sum();
                }
            }
        }
        values
    }

    /// All that was found.
    #[cfg(test)]
    pub(super) fn found(&self) -> f32 {
        self.summed(self.light.clone())[0].iter().sum()
    }

    /// The density that was learnt.
    pub(super) fn directions(&self) -> Option<Directions> {
        let light = self.summed(self.light.clone());
        Directions::new(
            light.into_iter().zip(&self.below).map(|(values, &below)| Node { values, below }).collect(),
        )
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

    /// One for the next turn, divided where this one has found much, of which it keeps a part: without that, leaves with few records
    /// would learn mostly noise.
    pub(super) fn refined(&self) -> Self {
        let old = Sums { light: self.summed(self.light.clone()), hits: self.summed(self.hits.clone()) };
        let most = LARGEST_SHARE * old.light[0].iter().sum::<f32>();
        let evidence = self.evidence.map(|evidence| KEPT * evidence);
        let mut new = Self { below: Vec::new(), light: Vec::new(), hits: Vec::new(), evidence };
        new.divide((self, &old), Old::Node(0), 1, most);
        new
    }

    /// Appends a node, and those below it whose squares hold more than `most`; its index.
    fn divide(&mut self, before: (&Self, &Sums), from: Old, depth: u32, most: f32) -> u32 {
        let (tree, sums) = before;
        let index = self.below.len();
        self.below.push([0; 4]);
        self.light.push([0.0; 4]);
        self.hits.push([0.0; 4]);
        for quarter in 0..4 {
            let (light, hits, below) = match from {
                Old::Node(i) => (sums.light[i][quarter], sums.hits[i][quarter], tree.below[i][quarter]),
                Old::Even(light, hits) => (0.25 * light, 0.25 * hits, 0),
            };
            let is_rich = light > most && hits >= LEAST_HITS;
            if is_rich && depth < MOST_DEPTH && self.below.len() < MOST_NODES {
                let from = if below == 0 { Old::Even(light, hits) } else { Old::Node(below as usize) };
                self.below[index][quarter] = self.divide(before, from, depth + 1, most);
            } else {
                self.light[index][quarter] = KEPT * light;
                self.hits[index][quarter] = KEPT * hits;
            }
        }
        index as u32
    }
}
