//! How much light standing fibres send back.

use super::chebyshev::{nodes, series, sum};
use super::stored::{COS, FIBRES, LOWER, SHEEN, SHEEN_LOWERS, STEEP};
use crate::bsdf::quadrature::gauss_legendre;
use crate::bsdf::sheen::roughness_axis;
use std::sync::LazyLock;

/// Share of the light that white fibres send to a viewer, by the angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SheenAlbedo {
    /// Place between two of [`LEVELS`].
    level: usize,
    between: f32,
    scale: f32,
}

/// Levels of the roughness with lines between.
const LEVELS: usize = 129;

/// The share at a level of the roughness and an angle.
static SHARES: LazyLock<Box<[[f32; STEEP]]>> = LazyLock::new(|| {
    let level = |level: usize| {
        let row: [f32; STEEP] = SHEEN.at::<FIBRES, STEEP>(level as f32 / (LEVELS - 1) as f32);
        row.map(|share| share.max(0.0))
    };
    (0..LEVELS).map(level).collect()
});

/// From a cosine to the axis on which fibres are known: they hide each other with about its fifth root.
fn angle_axis(cos: f32) -> f32 {
    cos.clamp(0.0, 1.0).sqrt().sqrt()
}

/// The inverse of [`angle_axis`].
pub(super) fn axis_cos(x: f32) -> f32 {
    x.powi(4)
}

/// The whole part of `x` in `[0, count - 1]`, at most `count - 2`, and the rest.
fn parted(x: f32, count: usize) -> (usize, f32) {
    let whole = (x as usize).min(count - 2);
    (whole, x - whole as f32)
}

impl SheenAlbedo {
    /// For a roughness in `[0, 1]`.
    pub(crate) fn new(roughness: f32) -> Self {
        let (level, between) = parted(roughness_axis(roughness) * (LEVELS - 1) as f32, LEVELS);
        let albedo = Self { level, between, scale: 1.0 };
        let brightest = (0..STEEP).map(|k| albedo.at_node(k)).fold(1.0, f32::max);
        Self { scale: 1.0 / brightest, ..albedo }
    }

    fn at_node(&self, node: usize) -> f32 {
        let [low, high] = [SHARES[self.level][node], SHARES[self.level + 1][node]];
        low + (high - low) * self.between
    }

    /// At an angle of cosine `cos`.
    pub(crate) fn at(&self, cos: f32) -> f32 {
        let (node, between) = parted(angle_axis(cos) * (STEEP - 1) as f32, STEEP);
        let [low, high] = [self.at_node(node), self.at_node(node + 1)];
        low + (high - low) * between
    }

    /// By which the fibres are made darker, so that they send back no more than all light from any angle.
    pub(crate) fn scale(&self) -> f32 {
        self.scale
    }
}

/// What a cover stops of the light of white fibres, because it lets the smaller of what passes along either direction: by
/// the angle of the viewer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SheenStopped {
    series: [f32; COS],
    mean: f32,
}

/// Means over the hemisphere, weighted by the cosine, of Chebyshev's polynomials on that axis.
static MEANS: LazyLock<[f32; COS]> = LazyLock::new(|| {
    std::array::from_fn(|degree| {
        let unit: [f32; COS] = std::array::from_fn(|k| if k == degree { 1.0 } else { 0.0 });
        let area = |x: f32| 8.0 * x.powi(7);
        gauss_legendre::<COS>().iter().map(|&(x, weight)| weight * area(x) * sum(&unit, x)).sum()
    })
});

impl SheenStopped {
    /// `passed` is what the cover lets pass over the cosine.
    pub(crate) fn new(roughness: f32, passed: impl Fn(f32) -> f32) -> Self {
        let rows = SHEEN_LOWERS.at::<FIBRES, { COS * LOWER }>(roughness_axis(roughness));
        let stopped = |k: usize| {
            let cos = axis_cos(const { nodes::<COS>() }[k]);
            let here = passed(cos);
            let light = const { nodes::<LOWER>() }.iter().zip(&rows[k * LOWER..]);
            light
                .map(|(lower, weight)| weight * (here - passed(cos * (1.0 - lower))).max(0.0))
                .sum::<f32>()
                .max(0.0)
        };
        let series = series(&std::array::from_fn(stopped));
        let mean = MEANS.iter().zip(&series).map(|(mean, coefficient)| mean * coefficient).sum::<f32>();
        Self { series, mean: mean.max(f32::MIN_POSITIVE) }
    }

    /// At an angle of cosine `cos`.
    pub(crate) fn at(&self, cos: f32) -> f32 {
        sum(&self.series, angle_axis(cos)).max(0.0)
    }

    /// The mean over the hemisphere, weighted by the cosine; above 0.
    pub(crate) fn mean(&self) -> f32 {
        self.mean
    }
}
