//! Reflectances over the angle.

use super::chebyshev::{cosine_weights, nodes, weights};
use super::stored::CURVE;
use heliostat_scene::Rgb;

/// A reflectance at Chebyshev's nodes of the cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Curve([Rgb; CURVE]);

impl Curve {
    /// Of a reflectance over the cosine.
    pub(crate) fn new(reflectance: impl Fn(f32) -> Rgb) -> Self {
        Self(const { nodes::<CURVE>() }.map(reflectance))
    }

    /// 1 at one node, 0 at the others.
    pub(super) fn unit(node: usize) -> Self {
        Self(std::array::from_fn(|k| if k == node { Rgb::ONE } else { Rgb::ZERO }))
    }

    /// Series, one for each node, added up by the values there.
    pub(super) fn fold<const N: usize>(&self, series: &[f32]) -> [Rgb; N] {
        let mut channels = [[0.0; N]; 3];
        for (value, series) in self.0.iter().zip(series.as_chunks::<N>().0) {
            for (sums, value) in channels.iter_mut().zip(value.to_array()) {
                sums.iter_mut().zip(series).for_each(|(sum, coefficient)| *sum += value * coefficient);
            }
        }
        let [r, g, b] = channels;
        std::array::from_fn(|k| Rgb::new(r[k], g[k], b[k]))
    }

    /// Whether it is 0 at every angle.
    pub(crate) fn is_zero(&self) -> bool {
        self.0 == [Rgb::ZERO; CURVE]
    }

    /// The mean with these weights of the nodes.
    pub(crate) fn sum(&self, weights: &[f32]) -> Rgb {
        self.0.iter().zip(weights).map(|(&value, &weight)| value * weight).sum()
    }

    /// The mean over the hemisphere, weighted by the cosine.
    pub(crate) fn cosine_mean(&self) -> Rgb {
        self.sum(&const { cosine_weights::<CURVE>() }).max(Rgb::ZERO)
    }
}

/// Weights by which a curve's nodes give its value at a cosine.
pub(crate) fn curve_weights(cos: f32) -> [f32; CURVE] {
    weights(cos.clamp(0.0, 1.0))
}
