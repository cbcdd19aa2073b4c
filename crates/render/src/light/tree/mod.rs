//! A tree over lights that chooses one by what a point may expect of it: ten thousand cost little more than ten.
//!
//! Nodes have eight children, which a point judges side by side: the way down is a third as long as in a binary tree, and is
//! chosen by what lies deeper.
//!
//! # Source
//! See [`super::cluster`].

mod build;
#[cfg(test)]
mod tests;

use super::Lookout;
use super::beams::{Beams, Lane, WIDTH};
use super::cluster::Cluster;

/// Marks a child that is a light.
const LIGHT: u32 = 1 << 31;

/// A tree of clusters.
#[derive(Debug)]
pub(super) struct LightTree {
    /// The root is the first.
    nodes: Vec<Node>,
    /// Where each light hangs.
    places: Vec<Place>,
}

#[derive(Debug)]
struct Node {
    beams: Beams,
    /// Indices of nodes, or of lights with [`LIGHT`].
    children: [u32; WIDTH],
    /// Where it hangs itself; of no meaning at the root.
    place: Place,
}

/// A child of a node.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    node: u32,
    child: u32,
}

impl LightTree {
    /// A tree over lights; `None` without any.
    pub(super) fn new(lights: &[Cluster]) -> Option<Self> {
        (!lights.is_empty()).then(|| build::tree(lights))
    }

    /// About the irradiance from all lights.
    #[inline]
    pub(super) fn importance(&self, from: &Lookout) -> f32 {
        self.nodes[0].beams.importances(from).iter().sum()
    }

    /// A light for a point, and its probability; `None` where no light reaches it.
    #[inline]
    pub(super) fn pick(&self, from: &Lookout, mut u: f32) -> Option<(usize, f32)> {
        let (mut place, mut probability) = (0, 1.0);
        loop {
            let node = &self.nodes[place];
            let importances = node.beams.importances(from);
            let sum: f32 = importances.iter().sum();
            let (child, rest) = pick_lane(&importances, u * sum)?;
            probability *= importances[child] / sum;
            u = rest;
            let next = node.children[child];
            if next & LIGHT != 0 {
                return Some(((next ^ LIGHT) as usize, probability));
            }
            place = next as usize;
        }
    }

    /// The probability with which [`Self::pick`] chooses a light.
    #[inline]
    pub(super) fn probability(&self, from: &Lookout, light: usize) -> f32 {
        let (mut place, mut probability) = (self.places[light], 1.0);
        loop {
            let node = &self.nodes[place.node as usize];
            let importances = node.beams.importances(from);
            let own = importances[place.child as usize];
            if own == 0.0 {
                return 0.0;
            }
            probability *= own / importances.iter().sum::<f32>();
            if place.node == 0 {
                return probability;
            }
            place = node.place;
        }
    }
}

/// The lane in whose share of the running sum `position` lies, and how far into it, in `[0, 1)`; `None` where all are 0.
#[inline]
fn pick_lane(shares: &Lane, mut position: f32) -> Option<(usize, f32)> {
    let mut found = None;
    for (i, &share) in shares.iter().enumerate() {
        if share > 0.0 {
            let rest = position / share;
            found = Some((i, rest.min(1.0_f32.next_down())));
            if rest < 1.0 {
                break;
            }
            position -= share;
        }
    }
    found
}
