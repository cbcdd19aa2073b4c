//! Functions of the cosine that change over tenths.

use super::axis::{curve_width, grazing_axis, grazing_cos};
use super::chebyshev::{nodes, series, sum};
use super::folded::WIDE_WEIGHTS;
use super::stored::{COS, LEAN};
use heliostat_scene::Rgb;
use std::sync::LazyLock;

/// A function of the cosine, as a series.
#[derive(Clone, Debug)]
pub(crate) struct EvenProfile([Rgb; COS]);

impl EvenProfile {
    /// From the values at the nodes.
    pub(crate) fn new(values: &Even<Rgb>) -> Self {
        Self(series(values))
    }

    /// The value at a cosine.
    pub(crate) fn at(&self, cos: f32) -> Rgb {
        sum(&self.0, even_axis(cos))
    }
}

/// Values at the nodes.
pub(crate) type Even<V> = [V; COS];

/// The cosines of the nodes.
pub(crate) fn even_cosines() -> Even<f32> {
    const { nodes::<COS>() }.map(|x| grazing_cos(x, curve_width(0.0)))
}

/// The cosine of one of the nodes.
#[cfg(test)]
pub(super) fn even_cos(node: usize) -> f32 {
    even_cosines()[node]
}

/// From a cosine to the axis of the nodes.
pub(super) fn even_axis(cos: f32) -> f32 {
    grazing_axis(cos.min(1.0), curve_width(0.0))
}

/// The mean over the hemisphere, weighted by the cosine.
pub(crate) fn even_mean(values: &Even<Rgb>) -> Rgb {
    static WEIGHTS: LazyLock<Even<f32>> = LazyLock::new(|| WIDE_WEIGHTS.at(0.0));
    values.iter().zip(WEIGHTS.iter()).map(|(&value, &weight)| weight * value).sum()
}

/// The same of values times how light leans ([`lean`](crate::bsdf::diffuse::lean)) to a viewer at each node.
pub(crate) fn lean_means(values: &Even<Rgb>) -> Even<Rgb> {
    static ROWS: LazyLock<Even<Even<f32>>> = LazyLock::new(|| {
        let mut rows = LEAN.rows::<COS>();
        std::array::from_fn(|_| rows.next().unwrap_or_default())
    });
    ROWS.each_ref().map(|row| row.iter().zip(values).map(|(&weight, &value)| weight * value).sum())
}
