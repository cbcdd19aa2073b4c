//! What depends on one direction at a rough surface.

use super::axis::{grazing_axis, grazing_cos};
use super::chebyshev::{Value, nodes, series, sum};
use super::stored::{COS, TURN};
use crate::bsdf::ggx::Ggx;
use crate::bsdf::quadrature::gauss_legendre;
use glam::{Vec2, Vec3};
use std::sync::LazyLock;

/// A function of a direction, as series over the cosine and, where highlights are drawn out, over the turn.
#[derive(Clone, Debug)]
pub(crate) struct Profile<V> {
    mean: [V; COS],
    /// Coefficients of higher degree over the turn.
    turned: Option<Box<[[V; COS]; TURN - 1]>>,
}

/// Where a direction lies on the axes of a [`Profile`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    x: f32,
    turn: f32,
}

impl Spot {
    /// `width` is that of the axis of grazing angles.
    pub(crate) fn new(ggx: Option<&Ggx>, width: f32, w: Vec3) -> Self {
        let turn = ggx.filter(|ggx| !ggx.is_isotropic()).map_or(0.0, |ggx| ggx.turn_of(w));
        Self { x: grazing_axis(w.z.abs().min(1.0), width), turn }
    }

    /// See [`Ggx::turn_of`]; 0 where tangents are alike.
    pub(super) fn turn(&self) -> f32 {
        self.turn
    }
}

impl<V: Value> Profile<V> {
    /// Of a function of the direction and the numbers of its nodes, by turn and cosine; `width` is that of the axis.
    pub(crate) fn new(
        ggx: Option<&Ggx>,
        width: impl Fn(Vec3) -> f32,
        value: impl Fn(Vec3, [usize; 2]) -> V,
    ) -> Self {
        let drawn_out = ggx.filter(|ggx| !ggx.is_isotropic());
        let row = |turn: usize| {
            let along = drawn_out.map_or(Vec2::X, |ggx| ggx.along(const { nodes::<TURN>() }[turn]));
            let width = width(along.extend(0.0));
            series(&std::array::from_fn(|c| value(node_direction(along, c, width), [turn, c])))
        };
        if drawn_out.is_none() {
            return Self { mean: row(0), turned: None };
        }
        Self::from_turns(&std::array::from_fn(row))
    }

    /// Of series over the cosine at the nodes of the turn.
    pub(super) fn from_turns(rows: &[[V; COS]; TURN]) -> Self {
        let columns: [[V; TURN]; COS] =
            std::array::from_fn(|c| series(&std::array::from_fn(|turn| rows[turn][c])));
        let turned = std::array::from_fn(|j| std::array::from_fn(|c| columns[c][j + 1]));
        Self { mean: columns.map(|column| column[0]), turned: Some(Box::new(turned)) }
    }

    /// Of a series over the cosine, the same for all turns.
    pub(super) fn from_series(series: [V; COS]) -> Self {
        Self { mean: series, turned: None }
    }

    /// The series over the cosine, the same for all turns.
    pub(super) fn series(&self) -> &[V; COS] {
        &self.mean
    }

    /// The value at a direction.
    #[inline]
    pub(crate) fn at(&self, spot: Spot) -> V {
        match &self.turned {
            None => sum(&self.mean, spot.x),
            Some(turned) => self.turned_at(turned, spot),
        }
    }

    #[inline(never)]
    fn turned_at(&self, turned: &[[V; COS]; TURN - 1], spot: Spot) -> V {
        let column = |c: usize| {
            let coefficients: [V; TURN] =
                std::array::from_fn(|j| if j == 0 { self.mean[c] } else { turned[j - 1][c] });
            sum(&coefficients, spot.turn)
        };
        sum(&std::array::from_fn::<V, COS, _>(column), spot.x)
    }
}

/// The direction above `along` at a node of the axis of grazing angles.
fn node_direction(along: Vec2, node: usize, width: f32) -> Vec3 {
    raised(along, grazing_cos(const { nodes::<COS>() }[node], width))
}

/// The direction above the x-axis at a place on the axis of grazing angles.
pub(super) fn axis_direction(x: f32, width: f32) -> Vec3 {
    raised(Vec2::X, grazing_cos(x, width))
}

/// The unit direction above `along` at a cosine.
fn raised(along: Vec2, cos: f32) -> Vec3 {
    ((1.0 - cos * cos).max(0.0).sqrt() * along).extend(cos)
}

/// Nodes of means over the cosine, and over the turn.
const HEIGHTS: usize = 32;
pub(super) const AROUND: usize = 8;

/// Nodes and weights over the height, worked out once.
static HEIGHT_NODES: LazyLock<[(f32, f32); HEIGHTS]> = LazyLock::new(gauss_legendre);

/// Directions evenly around the normal, from one tangent to the other.
pub(super) fn around(ggx: &Ggx) -> [Vec2; AROUND] {
    std::array::from_fn(|k| {
        let angle = std::f32::consts::FRAC_PI_2 * (k as f32 + 0.5) / AROUND as f32;
        Vec2::from_angle(angle).rotate(ggx.tangent())
    })
}

/// The mean over the hemisphere, weighted by the cosine, of a function of the direction that depends on the turn as facets do.
///
/// Nodes lie evenly over the logarithm of cosines above `width`, so that what narrow highlights do and what happens over
/// tenths is seen alike.
pub(crate) fn hemisphere_mean<V: Value>(
    ggx: Option<&Ggx>,
    width: impl Fn(Vec3) -> f32,
    value: impl Fn(Vec3) -> V,
) -> V {
    let drawn_out = ggx.filter(|ggx| !ggx.is_isotropic());
    let count = if drawn_out.is_some() { AROUND } else { 1 };
    let mut sum = V::default();
    for turn in 0..count {
        let along = drawn_out.map_or(Vec2::X, |ggx| around(ggx)[turn]);
        let width = width(along.extend(0.0));
        let range = (1.0 / width).ln_1p();
        for &(x, weight) in HEIGHT_NODES.iter() {
            let cos = width * (x * range).exp_m1();
            let area = 2.0 * cos * (cos + width) * range;
            sum = sum + value(raised(along, cos)) * (weight * area / count as f32);
        }
    }
    sum
}
