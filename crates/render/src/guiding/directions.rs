//! A density over directions: a quadtree over the unit square, which the sphere is mapped to without changing areas.
//!
//! # Source
//! Müller, Gross, Novák 2017, section 3.2: the directional tree, drawn from by going down where the shares say.

use glam::{Vec2, Vec3};
use heliostat_geometry::warp::{SPHERE_PDF, sphere_to_square, square_to_sphere};

/// A density over all directions. Children of a node stand behind it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Directions {
    nodes: Vec<Node>,
}

/// A square in quarters: bit 0 of the index of a quarter is the half in x, bit 1 that in y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Node {
    /// What lies in each quarter: light while it is learnt, then its share of the node, and the four add up to 1.
    pub(super) values: [f32; 4],
    /// The node of each quarter; 0, which is the root, for one that is not divided.
    pub(super) below: [u32; 4],
}

impl Directions {
    /// From what lies in the quarters of each node, those that are divided included; `None` if it is nothing, or too much to be
    /// shared out.
    pub(super) fn new(mut nodes: Vec<Node>) -> Option<Self> {
        let all: f32 = nodes[0].values.iter().sum();
        if !(all > 0.0 && all.is_finite()) {
            return None;
        }
        for node in &mut nodes {
            let sum: f32 = node.values.iter().sum();
            node.values = if sum > 0.0 { node.values.map(|value| value / sum) } else { [0.25; 4] };
        }
        Some(Self { nodes })
    }

    /// Density per steradian of a unit direction.
    #[inline]
    pub(super) fn pdf(&self, dir: Vec3) -> f32 {
        let mut u = within(sphere_to_square(dir));
        let (mut pdf, mut at) = (SPHERE_PDF, 0);
        loop {
            let node = &self.nodes[at];
            let quarter = quarter_of(&mut u);
            pdf *= 4.0 * node.values[quarter];
            at = node.below[quarter] as usize;
            if at == 0 {
                return pdf;
            }
        }
    }

    /// A unit direction by random numbers in `[0, 1)`.
    #[inline]
    pub(super) fn sample(&self, mut u: Vec2) -> Vec3 {
        let (mut corner, mut size, mut at) = (Vec2::ZERO, 1.0, 0);
        loop {
            let Node { values, below } = &self.nodes[at];
            size *= 0.5;
            let right = choose(&mut u.x, values[0] + values[2], values[1] + values[3]);
            let upper = choose(&mut u.y, values[right], values[right | 2]);
            corner += size * Vec2::new(right as f32, upper as f32);
            at = below[right | upper << 1] as usize;
            if at == 0 {
                return square_to_sphere(corner + size * u);
            }
        }
    }
}

/// The quarter in which a point of the unit square lies, which becomes a point of the quarter.
#[inline]
pub(super) fn quarter_of(u: &mut Vec2) -> usize {
    let doubled = 2.0 * *u;
    let half = Vec2::new(f32::from(u8::from(doubled.x >= 1.0)), f32::from(u8::from(doubled.y >= 1.0)));
    *u = doubled - half;
    half.x as usize | (half.y as usize) << 1
}

/// A point of the closed unit square as one of the square without its upper sides.
#[inline]
pub(super) fn within(u: Vec2) -> Vec2 {
    u.min(Vec2::splat(1.0_f32.next_down()))
}

/// 0 or 1 in proportion to two weights, by a random number in `[0, 1)`, which is as good as new after that.
#[inline]
fn choose(u: &mut f32, first: f32, second: f32) -> usize {
    let at = *u * (first + second);
    // Rounding must not lead to where nothing is.
    let is_second = second > 0.0 && at >= first;
    let rest = if is_second { (at - first) / second } else { at / first };
    *u = rest.min(1.0_f32.next_down());
    usize::from(is_second)
}
