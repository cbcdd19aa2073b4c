//! Axes on which tables are smooth.

#[cfg(test)]
use heliostat_geometry::error_bound;

/// From a cosine to an axis that resolves angles as grazing as `alpha` is wide: there facets shadow each other most.
///
/// The root of `alpha s^2 = cos (1 - s)`, over that of a cosine of 1.
pub(crate) fn grazing_axis(cos: f32, alpha: f32) -> f32 {
    let root = |cos: f32| {
        let sum = cos + (cos * (cos + 4.0 * alpha)).sqrt();
        if sum > 0.0 { 2.0 * cos / sum } else { 1.0 }
    };
    if cos > 0.0 { (root(cos) / root(1.0)).min(1.0) } else { 0.0 }
}

/// The inverse of [`grazing_axis`], for a width above 0.
pub(crate) fn grazing_cos(x: f32, alpha: f32) -> f32 {
    if x >= 1.0 {
        return 1.0;
    }
    let s = x * 2.0 / (1.0 + (1.0 + 4.0 * alpha).sqrt());
    (alpha * s * s / (1.0 - s)).min(1.0)
}

/// The width for which [`grazing_axis`] resolves a curve of reflectance seen through facets: curves change over tenths.
pub(crate) fn curve_width(alpha: f32) -> f32 {
    2.0 * alpha + 0.2
}

/// From a width in `[0, 1]` to an axis: the roughness.
pub(crate) fn width_axis(alpha: f32) -> f32 {
    alpha.clamp(0.0, 1.0).sqrt()
}

/// The inverse of [`width_axis`]; no mirror.
#[cfg(test)]
pub(crate) fn axis_width(x: f32) -> f32 {
    (x * x).max(error_bound::LEAST_WIDTH)
}

/// The largest index of refraction, or the inverse of the smallest, that tables tell from others.
const LARGEST: f32 = 3.0;

/// From an index of refraction, at least 1, to an axis: the cosine from which on light gets out of the denser side.
pub(crate) fn index_axis(ior: f32) -> f32 {
    critical(ior.clamp(1.0, LARGEST)) / critical(LARGEST)
}

/// The inverse of [`index_axis`].
#[cfg(test)]
pub(crate) fn axis_index(x: f32) -> f32 {
    1.0 / (1.0 - (x * critical(LARGEST)).powi(2)).sqrt()
}

fn critical(ior: f32) -> f32 {
    (1.0 - 1.0 / (ior * ior)).max(0.0).sqrt()
}
