//! Axes on which tables are smooth.

#[cfg(test)]
use heliostat_geometry::error_bound;

/// From a cosine to an axis that resolves angles as grazing as `alpha` is wide: there facets shadow each other most.
pub(crate) fn grazing_axis(cos: f32, alpha: f32) -> f32 {
    end_axis(cos, 1.0, alpha)
}

/// The inverse of [`grazing_axis`], for a width above 0.
pub(crate) fn grazing_cos(x: f32, alpha: f32) -> f32 {
    if x >= 1.0 { 1.0 } else { axis_end(x, 1.0, alpha).min(1.0) }
}

/// From a distance in `[0, length]` to an axis that resolves what happens as near to 0 as `width`.
///
/// The root of `width s^2 = distance (1 - s)`, over that of the length.
pub(crate) fn end_axis(distance: f32, length: f32, width: f32) -> f32 {
    if distance > 0.0 { (end_root(distance, width) / end_root(length, width)).min(1.0) } else { 0.0 }
}

/// The inverse of [`end_axis`], for a width above 0.
pub(crate) fn axis_end(x: f32, length: f32, width: f32) -> f32 {
    let s = x * end_root(length, width);
    width * s * s / (1.0 - s)
}

fn end_root(distance: f32, width: f32) -> f32 {
    let sum = distance + (distance * (distance + 4.0 * width)).sqrt();
    if sum > 0.0 { 2.0 * distance / sum } else { 1.0 }
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

/// The cosine from which on light gets out of the denser side of a boundary.
pub(crate) fn critical(ior: f32) -> f32 {
    (1.0 - 1.0 / (ior * ior)).max(0.0).sqrt()
}
