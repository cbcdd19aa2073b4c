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
pub(super) fn grazing_axis(cos: f32, alpha: f32) -> f32 {
    let sum = cos + alpha;
    if sum > 0.0 { (cos * (1.0 + alpha) / sum).sqrt() } else { 1.0 }
}

/// The inverse of [`grazing_axis`].
pub(super) fn grazing_cos(x: f32, alpha: f32) -> f32 {
    let x = x * x;
    x * alpha / ((1.0 - x) + alpha)
}
