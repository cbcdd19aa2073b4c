//! What rough glass loses more where highlights are drawn out.
//!
//! What facets lose in a direction depends on how far they lean along it, and how far across. The first is the width of even
//! facets that come closest; the second adds a little.

use super::axis::{index_axis, width_axis};
use super::chebyshev::{nodes, series, weights};
use super::curve::{Curve, curve_weights};
use super::stored::{
    DRAWN_COS, DRAWN_CURVE, DRAWN_EDGE, DRAWN_GLASS, DRAWN_INDEX, DRAWN_INNER, DRAWN_WIDTH, PIECES, Table,
};
use crate::bsdf::ggx::Ggx;
use heliostat_scene::Rgb;

/// Widths of facets along a direction and across.
#[derive(Clone, Copy, Debug)]
pub(super) struct Widths {
    pub(super) along: f32,
    across: f32,
}

const ROW: usize = 1 + DRAWN_CURVE;

impl Widths {
    /// In the direction of a turn.
    pub(super) fn new(ggx: &Ggx, turn: f32) -> Self {
        let along = ggx.along(turn);
        Self { along: ggx.width_along(along.extend(0.0)), across: ggx.width_along(along.perp().extend(0.0)) }
    }

    /// Series over the cosine, on the side of the smaller index.
    pub(super) fn more_outside(&self, ior: f32, curve: &Curve) -> [Rgb; DRAWN_COS] {
        folded(&self.numbers::<{ DRAWN_COS * ROW }>(DRAWN_GLASS, ior), &coarse(curve))
    }

    /// Series over the pieces of the cosine, on the side of the larger index.
    pub(super) fn more_inside(&self, ior: f32, curve: &Curve) -> [[Rgb; DRAWN_EDGE]; PIECES] {
        let numbers = self.numbers::<{ PIECES * DRAWN_EDGE * ROW }>(DRAWN_INNER, ior);
        let curve = coarse(curve);
        std::array::from_fn(|piece| folded(&numbers[piece * DRAWN_EDGE * ROW..], &curve))
    }

    /// The numbers of a table for these widths and an index.
    fn numbers<const N: usize>(&self, table: Table, ior: f32) -> [f32; N] {
        let at_width = |alpha: f32| weights::<DRAWN_WIDTH>(width_axis(alpha));
        let (along, across) = (at_width(self.along), at_width(self.across));
        let mut sums = [0.0; N];
        for (i, index) in weights::<DRAWN_INDEX>(index_axis(ior)).into_iter().enumerate() {
            for (a, along) in along.into_iter().enumerate() {
                for (b, across) in across.into_iter().enumerate() {
                    let row = (i * DRAWN_WIDTH + a) * DRAWN_WIDTH + b;
                    table.add(row * N, index * along * across, &mut sums);
                }
            }
        }
        sums
    }
}

/// A curve at fewer nodes.
fn coarse(curve: &Curve) -> [Rgb; DRAWN_CURVE] {
    const { nodes::<DRAWN_CURVE>() }.map(|cos| curve.sum(&curve_weights(cos)))
}

/// The series through numbers at nodes of the cosine, for a curve.
fn folded<const N: usize>(numbers: &[f32], curve: &[Rgb; DRAWN_CURVE]) -> [Rgb; N] {
    series(&std::array::from_fn(|node| {
        let (plain, nodes) = (numbers[node * ROW], &numbers[node * ROW + 1..]);
        curve.iter().zip(nodes).map(|(&value, &weight)| weight * value).sum::<Rgb>() + plain
    }))
}
