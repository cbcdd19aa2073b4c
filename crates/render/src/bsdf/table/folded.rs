//! The tables of facets that are the same in all directions, folded for the surfaces that ask: series over the cosine at many
//! levels of the roughness.

use super::axis::{curve_width, grazing_axis};
use super::chebyshev::{nodes, series};
use super::levels::Levels;
use super::profile::{axis_direction, hemisphere_mean};
use super::stored::{
    ANGLES, COS, CURVE, EDGE, FINE_WIDTH, GLASS, GLASS_WIDTH, INDEX, INNER_GLASS, LOST, LOWER, LOWERS,
    PIECES, WIDTH,
};
use crate::bsdf::quadrature::gauss_legendre;
use heliostat_geometry::error_bound;
use std::sync::LazyLock;

/// How many levels of the roughness there are: more of what is small.
const FINE: usize = 257;
const COARSE: usize = 129;

/// Series of [`LOST`].
pub(super) static LOST_SERIES: LazyLock<Levels<COS>> = LazyLock::new(|| {
    let rows: Vec<[f32; COS]> = LOST.rows().map(|row| series(&row)).collect();
    Levels::new::<FINE_WIDTH>(FINE, &rows)
});

/// Numbers of [`ANGLES`] at one width.
const CURVE_SERIES: usize = CURVE * COS;

/// Series of [`ANGLES`], `[CURVE][COS]`.
pub(super) static ANGLE_SERIES: LazyLock<Levels<CURVE_SERIES>> = LazyLock::new(|| {
    let rows: Vec<[f32; CURVE_SERIES]> =
        ANGLES.rows::<{ COS * CURVE }>().map(|row| columns::<CURVE, COS, CURVE_SERIES>(&row)).collect();
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

/// Series of [`GLASS`], `[INDEX][1 + CURVE][COS]`.
pub(super) static GLASS_NEAR: LazyLock<Levels<{ INDEX[0] * GLASS_SERIES }>> = LazyLock::new(|| {
    let columns = |row: [f32; GLASS_SERIES]| columns::<{ 1 + CURVE }, COS, GLASS_SERIES>(&row);
    let rows: Vec<[f32; GLASS_SERIES]> = GLASS.rows().map(columns).collect();
    Levels::new::<GLASS_WIDTH>(COARSE, &by_width(&rows))
});

/// Numbers of [`INNER_GLASS`] at one width, index and piece, and at one width and index.
pub(super) const EDGE_SERIES: usize = (1 + CURVE) * EDGE;
pub(super) const EDGES_SERIES: usize = PIECES * EDGE_SERIES;

/// Series of [`INNER_GLASS`], `[INDEX][PIECES][1 + CURVE][EDGE]`.
pub(super) static GLASS_FAR: LazyLock<Levels<{ INDEX[1] * EDGES_SERIES }>> = LazyLock::new(|| {
    let columns = |row: [f32; EDGE_SERIES]| columns::<{ 1 + CURVE }, EDGE, EDGE_SERIES>(&row);
    let pieces: Vec<[f32; EDGE_SERIES]> = INNER_GLASS.rows().map(columns).collect();
    let rows: Vec<[f32; EDGES_SERIES]> = pieces
        .as_chunks::<PIECES>()
        .0
        .iter()
        .filter_map(|pieces| pieces.as_flattened().first_chunk().copied())
        .collect();
    Levels::new::<GLASS_WIDTH>(COARSE, &by_width(&rows))
});

/// From rows by index and width to those by width, of all indices.
fn by_width<const M: usize, const N: usize>(rows: &[[f32; M]]) -> Vec<[f32; N]> {
    let at_width = |w: usize| {
        let mut numbers = [0.0; N];
        let (parts, _) = numbers.as_chunks_mut::<M>();
        parts.iter_mut().enumerate().for_each(|(index, part)| *part = rows[index * GLASS_WIDTH + w]);
        numbers
    };
    (0..GLASS_WIDTH).map(at_width).collect()
}

/// From `[C][M]` numbers at nodes to `[M][C]` coefficients of series.
fn columns<const M: usize, const C: usize, const N: usize>(row: &[f32; N]) -> [f32; N] {
    let mut columns = [0.0; N];
    for (m, column) in columns.as_chunks_mut::<C>().0.iter_mut().enumerate() {
        *column = series(&std::array::from_fn(|c| row[c * M + m]));
    }
    columns
}

/// Nodes of means over the hemisphere of what depends on a direction as the losses of facets do.
pub(super) const STEEPS: usize = 32;

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
