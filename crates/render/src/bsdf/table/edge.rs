//! Losses of rough glass on its denser side, where total reflection begins like an edge.
//!
//! The cosine is parted in three: away from grazing angles, and away from the edge to either side. In each piece an axis
//! resolves its end as finely as the facets are wide.

#[cfg(test)]
use super::axis::axis_end;
use super::axis::{critical, end_axis};
use super::chebyshev::{sum, sums};
use super::curve::Curve;
use super::folded::{EDGE_SERIES, EDGES_SERIES, GLASS_FAR};
use super::interface::at_index;
use super::stored::{EDGE, INDEX, PIECES};
use crate::bsdf::quadrature::gauss_legendre;
use heliostat_geometry::error_bound;
use heliostat_scene::Rgb;
use std::sync::LazyLock;

/// A piece of the cosine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Where it starts, and which way it runs.
    from: f32,
    sign: f32,
    length: f32,
}

/// The pieces for a cosine where total reflection ends.
pub(super) fn pieces(critical: f32) -> [Piece; PIECES] {
    let half = 0.5 * critical;
    [
        Piece { from: 0.0, sign: 1.0, length: half },
        Piece { from: critical, sign: -1.0, length: half },
        Piece { from: critical, sign: 1.0, length: 1.0 - critical },
    ]
}

impl Piece {
    /// The cosine at a place on the axis.
    #[cfg(test)]
    pub(super) fn cos(&self, x: f32, width: f32) -> f32 {
        (self.from + self.sign * axis_end(x, self.length, width)).clamp(0.0, 1.0)
    }

    fn place(&self, cos: f32, width: f32) -> f32 {
        end_axis(self.sign * (cos - self.from), self.length, width)
    }
}

/// What is lost over the cosine, for facets of one width.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeProfile {
    critical: f32,
    width: f32,
    series: [[Rgb; EDGE]; PIECES],
}

/// How many nodes means over a piece have.
const NODES: usize = 32;

/// The nodes, evenly over the logarithm of distances above the width.
static UNIT_NODES: LazyLock<[(f32, f32); NODES]> = LazyLock::new(gauss_legendre);

impl EdgeProfile {
    /// `ior` is the index of this side over that of the other, and `curve` the reflectance over the cosine on the other.
    pub(super) fn new(alpha: f32, ior: f32, weights: [f32; INDEX[1]], curve: &Curve) -> Self {
        let numbers: [f32; EDGES_SERIES] = at_index(&GLASS_FAR, alpha, weights);
        let series = |piece: usize| {
            let (plain, curves) = numbers[piece * EDGE_SERIES..][..EDGE_SERIES].split_at(EDGE);
            let folded = curve.fold::<EDGE>(curves);
            std::array::from_fn(|k| folded[k] + plain[k])
        };
        let width = alpha.max(error_bound::LEAST_WIDTH);
        Self { critical: critical(ior), width, series: std::array::from_fn(series) }
    }

    /// With so much more lost, by series for each piece.
    pub(super) fn with_more<const N: usize>(mut self, more: &[[Rgb; N]; PIECES]) -> Self {
        for (series, more) in self.series.iter_mut().zip(more) {
            series.iter_mut().zip(more).for_each(|(coefficient, more)| *coefficient += *more);
        }
        self
    }

    /// At a cosine.
    pub(super) fn at(&self, cos: f32) -> Rgb {
        let piece = usize::from(cos > 0.5 * self.critical) + usize::from(cos > self.critical);
        sum(&self.series[piece], pieces(self.critical)[piece].place(cos, self.width))
            .clamp(Rgb::ZERO, Rgb::ONE)
    }

    /// The mean over the hemisphere, weighted by the cosine.
    pub(super) fn mean(&self) -> Rgb {
        let mut mean = [0.0; 3];
        for (piece, series) in pieces(self.critical).iter().zip(&self.series) {
            let range = (piece.length / self.width).ln_1p();
            let distances = UNIT_NODES.map(|(x, _)| self.width * (x * range).exp_m1());
            let places = distances.map(|distance| end_axis(distance, piece.length, self.width));
            let area: [f32; NODES] = std::array::from_fn(|k| {
                let cos = piece.from + piece.sign * distances[k];
                2.0 * UNIT_NODES[k].1 * cos * (distances[k] + self.width) * range
            });
            for (channel, mean) in mean.iter_mut().enumerate() {
                let values = sums(&series.map(|coefficient| coefficient[channel]), &places);
                *mean +=
                    values.iter().zip(area).map(|(value, area)| value.clamp(0.0, 1.0) * area).sum::<f32>();
            }
        }
        Rgb::from_array(mean)
    }
}
