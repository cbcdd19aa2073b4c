//! The tables of facets that are the same in all directions, folded for the surfaces that ask: series over the cosine at many
//! levels of the roughness.

use super::axis::{curve_width, grazing_axis};
use super::chebyshev::{nodes, series};
use super::levels::Levels;
use super::profile::{axis_direction, hemisphere_mean};
use super::stored::{ANGLES, COS, CURVE, FINE_WIDTH, GLASS, INDEX, LOST, LOWER, LOWERS, WIDTH};
use crate::bsdf::quadrature::gauss_legendre;
use heliostat_geometry::error_bound;
use std::sync::LazyLock;

/// How many levels of the roughness there are: more of what is small.
const FINE: usize = 257;
const COARSE: usize = 129;

/// Series of [`LOST`].
pub(super) static LOST_SERIES: LazyLock<Levels<COS>> = LazyLock::new(|| {
    let rows: Vec<[f32; COS]> = LOST.rows().map(|row| series(&row)).collect();
    Levels::new::<WIDTH>(FINE, &rows)
});

/// Numbers of [`ANGLES`] at one width.
const CURVE_SERIES: usize = CURVE * COS;

/// Series of [`ANGLES`], `[CURVE][COS]`.
pub(super) static ANGLE_SERIES: LazyLock<Levels<CURVE_SERIES>> = LazyLock::new(|| {
    let rows: Vec<[f32; CURVE_SERIES]> =
        ANGLES.rows::<{ COS * CURVE }>().map(|row| columns::<CURVE, CURVE_SERIES>(&row)).collect();
    Levels::new::<FINE_WIDTH>(FINE, &rows)
});

/// Numbers of [`LOWERS`] at one width.
pub(super) const LOWER_NUMBERS: usize = COS * LOWER * CURVE;

/// [`LOWERS`] as they are, `[COS][LOWER][CURVE]`.
pub(super) static LOWER_NODES: LazyLock<Levels<LOWER_NUMBERS>> = LazyLock::new(|| {
    let rows: Vec<[f32; LOWER_NUMBERS]> = LOWERS.rows().collect();
    Levels::new::<WIDTH>(COARSE, &rows)
});

/// Numbers of [`GLASS`] at one width and index.
pub(super) const GLASS_SERIES: usize = (1 + CURVE) * COS;

/// Series of [`GLASS`], `[INDEX][1 + CURVE][COS]`, from the side of the smaller and of the larger index.
pub(super) static GLASS_NEAR: LazyLock<Levels<{ INDEX[0] * GLASS_SERIES }>> = LazyLock::new(|| glass(0));
pub(super) static GLASS_FAR: LazyLock<Levels<{ INDEX[1] * GLASS_SERIES }>> = LazyLock::new(|| glass(1));

fn glass<const N: usize>(side: usize) -> Levels<N> {
    let rows: Vec<[f32; GLASS_SERIES]> =
        GLASS[side].rows::<GLASS_SERIES>().map(|row| columns::<{ 1 + CURVE }, GLASS_SERIES>(&row)).collect();
    let at_width = |w: usize| {
        let mut numbers = [0.0; N];
        let (parts, _) = numbers.as_chunks_mut::<GLASS_SERIES>();
        parts.iter_mut().enumerate().for_each(|(index, part)| *part = rows[index * WIDTH + w]);
        numbers
    };
    let widths: Vec<[f32; N]> = (0..WIDTH).map(at_width).collect();
    Levels::new::<WIDTH>(COARSE, &widths)
}

/// From `[COS][M]` numbers at nodes of the cosine to `[M][COS]` coefficients of series.
fn columns<const M: usize, const N: usize>(row: &[f32; N]) -> [f32; N] {
    let mut columns = [0.0; N];
    for (m, column) in columns.as_chunks_mut::<COS>().0.iter_mut().enumerate() {
        *column = series(&std::array::from_fn(|c| row[c * M + m]));
    }
    columns
}

/// Nodes of means over the hemisphere of what depends on a direction as the losses of facets do.
pub(super) const STEEPS: usize = 24;

/// Cosines of these nodes, then their weights: what is small at all but grazing angles must not be left over from large
/// numbers that cancel.
pub(super) static STEEP_NODES: LazyLock<Levels<{ 2 * STEEPS }>> = LazyLock::new(|| {
    let unit = gauss_legendre::<STEEPS>();
    Levels::each(FINE, |alpha| {
        let width = alpha.max(error_bound::LEAST_WIDTH);
        let range = (1.0 / width).ln_1p();
        let cos = |x: f32| width * (x * range).exp_m1();
        std::array::from_fn(|k| match unit.get(k) {
            Some((x, _)) => cos(*x),
            None => {
                let (x, weight) = unit[k - STEEPS];
                weight * 2.0 * cos(x) * (cos(x) + width) * range
            }
        })
    })
});

/// Weights that values at the nodes of the axis for curves of reflectance have in their mean over the hemisphere.
pub(super) static WIDE_WEIGHTS: LazyLock<Levels<COS>> = LazyLock::new(|| {
    Levels::each(FINE, |alpha| {
        let width = curve_width(alpha);
        let weights = |cos: f32| super::chebyshev::weights::<COS>(grazing_axis(cos, width));
        std::array::from_fn(|node| hemisphere_mean(None, |_| MOST_WIDTH, |w| weights(w.z)[node]))
    })
});

/// The largest width for means of what depends on covers too: these change over tenths.
pub(super) const MOST_WIDTH: f32 = 0.1;

/// The directions of [`WIDE_WEIGHTS`], above the first tangent.
pub(super) fn wide_directions(alpha: f32) -> [glam::Vec3; COS] {
    const { nodes::<COS>() }.map(|x| axis_direction(x, curve_width(alpha)))
}
