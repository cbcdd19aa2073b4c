//! Axes of tables, and where between two of their nodes a number lies.

use heliostat_geometry::error_bound;

/// A place between node `index` and the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) index: usize,
    /// How far on the way, in `[0, 1]`.
    pub(super) share: f32,
}

impl Place {
    /// Where `x` in `[0, 1]` lies among `count` nodes from 0 to 1 at equal distances.
    pub(super) fn even(x: f32, count: usize) -> Self {
        let at = x.clamp(0.0, 1.0) * (count - 1) as f32;
        let index = (at as usize).min(count - 2);
        Self { index, share: at - index as f32 }
    }

    /// Where the width `alpha` in `[0, 1]` lies among the squares of `count` even nodes.
    ///
    /// Nodes are even in roughness and shares even in width: what rough lobes lose grows with the width at first.
    pub(super) fn width(alpha: f32, count: usize) -> Self {
        let Self { index, .. } = Self::even(alpha.max(0.0).sqrt(), count);
        let (low, high) = (node_width(index, count), node_width(index + 1, count));
        Self { index, share: ((alpha - low) / (high - low)).clamp(0.0, 1.0) }
    }

    /// The two nodes with their weights.
    pub(super) fn pair(self) -> [(usize, f32); 2] {
        [(self.index, 1.0 - self.share), (self.index + 1, self.share)]
    }
}

/// The width at a node of [`Place::width`]; the first is that of a mirror.
pub(super) fn node_width(index: usize, count: usize) -> f32 {
    (index as f32 / (count - 1) as f32).powi(2).max(error_bound::LEAST_WIDTH)
}

/// From a cosine to an even axis that resolves angles as grazing as `alpha` is wide: there facets shadow each other most.
///
/// The root of `alpha s^2 = cos (1 - s)`, over that of a cosine of 1.
pub(super) fn grazing_axis(cos: f32, alpha: f32) -> f32 {
    let root = |cos: f32| {
        let sum = cos + (cos * (cos + 4.0 * alpha)).sqrt();
        if sum > 0.0 { 2.0 * cos / sum } else { 1.0 }
    };
    if cos > 0.0 { root(cos) / root(1.0) } else { 0.0 }
}

/// The inverse of [`grazing_axis`], for a width above 0.
pub(super) fn grazing_cos(x: f32, alpha: f32) -> f32 {
    if x >= 1.0 {
        return 1.0;
    }
    let s = x * 2.0 / (1.0 + (1.0 + 4.0 * alpha).sqrt());
    alpha * s * s / (1.0 - s)
}

/// About how much less is lost at an angle of cosine `cos` than at a grazing one: tables hold what is left to tell.
pub(super) fn grazing_decay(cos: f32, alpha: f32) -> f32 {
    let sum = alpha * alpha + cos * cos;
    if sum > 0.0 { alpha * alpha / sum } else { 1.0 }
}

/// Steps of [`grazing_mean`] between two nodes.
const STEPS: usize = 16;

/// The mean over the hemisphere, weighted by the cosine, of what is known over [`grazing_decay`] at `count` even nodes of
/// [`grazing_axis`] and linear between them: for each of many steps the node before, the way to the next one, and the weight.
///
/// `widest` is the width by which the values decay.
pub(super) fn grazing_mean(count: usize, alpha: f32, widest: f32) -> impl Iterator<Item = (Place, f32)> {
    let last = (count - 1) * STEPS;
    let cos = move |k: f32| grazing_cos(k / last as f32, alpha);
    (0..last).map(move |k| {
        let share = ((k % STEPS) as f32 + 0.5) / STEPS as f32;
        let (low, middle, high) = (cos(k as f32), cos(k as f32 + 0.5), cos((k + 1) as f32));
        let weight = (high - low) * (high + low) * grazing_decay(middle, widest);
        (Place { index: k / STEPS, share }, weight)
    })
}
