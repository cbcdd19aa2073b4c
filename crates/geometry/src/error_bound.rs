//! The one place that knows how wrong a float can be.
//!
//! Every tolerance of the project is derived here from the unit roundoff; no other file holds an epsilon.
//!
//! # Source
//! Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 6.8 (`gamma`, origin offsets);
//! Wächter and Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, 2019.

use crate::ray::Interval;
use glam::{DMat3, DVec3, Mat3, Vec3, Vec3A};

/// Half the distance between 1 and the next `f32`: the largest relative error of one rounded operation.
pub const UNIT_ROUNDOFF: f32 = f32::EPSILON * 0.5;

/// The least width of a distribution of microfacets that is not taken for a mirror, as the tangent of an angle: the square root
/// of [`UNIT_ROUNDOFF`].
///
/// A half vector is known to a few roundings, which by this width is a few thousandths of the lobe; narrower ones would be
/// drawn with rounding alone.
pub const LEAST_WIDTH: f32 = 0.000_244_140_62;

/// About how wrong the tables of how much light rough surfaces reflect may be; a layer that lets less pass is closed.
pub const TABLE_ERROR: f32 = 0.001;

/// Bound of the relative error of `n` rounded operations in a row: `n u / (1 - n u)`.
#[inline]
pub const fn gamma(n: u32) -> f32 {
    let nu = n as f32 * UNIT_ROUNDOFF;
    nu / (1.0 - nu)
}

/// Bound of the relative error of `n` rounded `f64` operations in a row.
pub const fn gamma_f64(n: u32) -> f64 {
    let nu = n as f64 * (f64::EPSILON * 0.5);
    nu / (1.0 - nu)
}

/// Bound of the error, per axis, of a point computed in `f64` on a triangle, and of the distance of a ray from
/// there to the plane of the triangle.
///
/// Two products and sums along the edges make the point; the cross product and the scalar product of the next
/// intersection add eight operations, on lengths of up to twice the largest coordinate.
pub fn triangle_point(corners: [Vec3; 3]) -> f64 {
    let extent = corners[0].abs().max(corners[1].abs()).max(corners[2].abs()).max_element();
    gamma_f64(16) * 2.0 * f64::from(extent)
}

/// Bound of the error, per axis, of a point computed in `f64` on an analytic shape whose largest coordinate is
/// `extent`, and of the next root along a ray from there.
///
/// Root finders work on coordinates shifted to the shape, so that their errors are a few dozen roundings of numbers
/// as large as the shape.
pub fn shape_point(extent: f64) -> f64 {
    gamma_f64(64) * extent
}

/// Grows the slab distances `near <= far` by the error of `(plane - origin) / dir`, outward on both sides.
///
/// A NaN from `0 / 0` cannot occur: the caller treats a zero direction by itself.
pub fn grow_slab(near: f32, far: f32) -> Interval {
    // Factors rather than sums, so that infinite distances stay infinite.
    let slack = 2.0 * gamma(3);
    let (shorter, longer) = (1.0 - slack, 1.0 + slack);
    let min = near * if near > 0.0 { shorter } else { longer };
    let max = far * if far > 0.0 { longer } else { shorter };
    Interval { min, max }
}

/// Bound of the rounding of the scalar product of `axis` with sums of up to eight vectors, themselves rounded once, whose
/// absolute values add up to `reach`.
pub fn projection(reach: Vec3, axis: Vec3) -> f32 {
    gamma(16) * reach.dot(axis.abs()) + f32::MIN_POSITIVE
}

/// By how much, per axis, a box grows whose content is met by rays that were mapped into its space, where `reach` is the
/// largest magnitude of its coordinates.
///
/// The origin of such a ray is rounded once more, in proportion to its own coordinates: as far as these are those of the
/// box, this holds it, and as far as it lies away from the box, [`cell_padding`] does.
pub fn mapped_ray(reach: f32) -> f32 {
    gamma(8) * reach
}

/// Bound of the rounding of `p`, a point computed in `f64` and rounded once, that a ray will see again in the
/// space of its object.
///
/// `extent` is, per axis, the largest magnitude that takes part in that second rounding: the absolute value of
/// the linear map times the absolute value of the point in object space (0 where the spaces are the same).
///
/// `slack` is what the arithmetic in `f64` before that left, per axis; it matters where the coordinates of `p` are
/// much smaller than the numbers they came from.
pub fn rounded_point(p: Vec3, extent: Vec3, slack: DVec3) -> Vec3 {
    gamma(2) * (p.abs() + extent + slack.as_vec3()) + slack.as_vec3() + Vec3::splat(f32::MIN_POSITIVE)
}

/// Bound of the error, per axis, with which a point returns from world space to local space and back, in `f64`, by maps
/// whose absolute values are `linear` and `inverse`.
///
/// `magnitude` is the absolute world position plus the absolute translation. Twelve operations each for the map,
/// its inverse, and the inverse's own error, each amplified by at most the absolute map times the absolute inverse.
#[inline]
pub fn round_trip(linear: DMat3, inverse: DMat3, magnitude: DVec3) -> DVec3 {
    round_trip_by_shift(linear * (inverse * magnitude))
}

/// [`round_trip`] by a translation.
#[inline]
pub fn round_trip_by_shift(magnitude: DVec3) -> DVec3 {
    gamma_f64(36) * magnitude
}

/// Whether a vector is as near to unit length as one that was divided by its length.
#[inline]
pub fn is_unit(v: DVec3) -> bool {
    (v.length_squared() - 1.0).abs() <= gamma_f64(16)
}

/// Whether two vectors are at right angles, up to the rounding with which they came from `f64`.
pub fn is_square(a: Vec3, b: Vec3) -> bool {
    a.dot(b).abs() <= gamma(8) * a.length() * b.length()
}

/// A matrix with the absolute value of every element.
pub fn abs(m: DMat3) -> DMat3 {
    DMat3::from_cols(m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs())
}

/// Bound of the error of a coordinate near `v` on a flat face, as interpolated in `f32` from corners of that size or
/// brought there by a transform and rounded: how far a point of the face `x = v` may seem to lie from it.
pub fn on_face(v: f32) -> f32 {
    gamma(16) * v.abs().max(1.0)
}

/// Bound of the error, per axis, with which a ray along `segment` arrives at its end at `t = 1`.
///
/// One rounding where the direction is made, one of the length that is compared with 1, and one where the direction is
/// seen from the space of a mesh; a rotation can bring the error of any axis into any other.
pub fn segment_end(segment: Vec3) -> Vec3 {
    Vec3::splat(gamma(8) * segment.abs().max_element())
}

/// Moves `p` along the unit normal `n`, to the side that `dir` points to, out of the box of error `p_err`.
///
/// The result is rounded away from `p`, so that even a bound below one ulp moves the point.
#[inline]
pub fn offset_origin(p: Vec3, p_err: Vec3, n: Vec3, dir: Vec3) -> Vec3 {
    let along = dir.dot(n);
    // Where rounding could turn a grazing ray to the wrong side, in `f64`, in which products are exact.
    let is_grazing = along.abs() <= gamma(4) * dir.abs().dot(n.abs());
    let is_behind = if is_grazing { dir.as_dvec3().dot(n.as_dvec3()) < 0.0 } else { along < 0.0 };
    offset_along(p, p_err, if is_behind { -n } else { n })
}

/// [`offset_origin`] to the side of the normal.
#[inline]
pub fn offset_along(p: Vec3, p_err: Vec3, n: Vec3) -> Vec3 {
    let offset = n.abs().dot(p_err) * n;
    let moved = p + offset;
    // A step of at least one ulp, without a look at the bits, and never subnormal: near 0 that takes a processor long.
    let step = moved.abs().max(Vec3::splat(f32::MIN_POSITIVE / f32::EPSILON)) * f32::EPSILON;
    let away = |offset: f32, step: f32| if offset == 0.0 { 0.0 } else { step.copysign(offset) };
    moved + Vec3::new(away(offset.x, step.x), away(offset.y, step.y), away(offset.z, step.z))
}

/// Bound, in lengths, of how far beside its place the watertight triangle test sees a point of a triangle.
///
/// `reach` is the largest coordinate of a corner, seen from the ray's origin. Per corner: one rounding of the
/// subtraction of the origin, on the corner across the ray and on the corner along it; two of the slope, one of its
/// product, one of the last subtraction.
#[inline]
pub fn sheared_corner(reach: f32) -> f32 {
    gamma(6) * reach
}

/// The least area of a triangle whose `f64` areas, differences of products that add up to `products`, tell where it is hit to more
/// digits than an `f32` holds.
///
/// The six products are rounded twice each; divided by the area that is the part of the triangle by which the hit moves, and this
/// keeps it below an eighth of the unit roundoff.
#[inline]
pub fn least_area(products: f64) -> f64 {
    gamma_f64(12) * products * (8.0 / f64::from(UNIT_ROUNDOFF))
}

/// Bound, in lengths, of how far beside the true ray the rounded one may seem to run where it is compared with a
/// plane, or a triangle, up to `distance` from its origin. `size` is the size of the triangle. Linear in both.
///
/// Distances and sizes are the largest along one axis; no other coordinates matter, because floats are given and
/// subtracted exactly but for one rounding of the difference. The distance to a plane,
/// `(plane - origin) * (1 / dir)`, has 3 roundings, its growth by this bound 2 more, and the distance of a hit is
/// rounded once. The watertight triangle test sees its corners, up to `distance + size` away, displaced by
/// [`sheared_corner`]: by so much the true ray may pass beside a triangle that is hit. The hit lies on the true ray, at a
/// distance worked out in `f64` where that meets the plane; only where it passes beside the triangle, the distance is held
/// to within as much of the place where the hit was seen (see [`crate::triangle`]).
///
/// # Source
/// Higham, "Accuracy and Stability of Numerical Algorithms", 2nd edition, section 3.1, applied to the terms above.
#[inline]
pub fn cell_padding(distance: f32, size: f32) -> f32 {
    gamma(6) * distance + 2.0 * sheared_corner(distance + size)
}

/// Bound of the error, per axis, of a corner that comes from cutting a triangle in `f64` by up to six planes one after
/// the other. `extent` is the largest magnitude of a coordinate.
///
/// Each cut adds four operations, on lengths of up to twice the extent.
pub fn clipped_corner(extent: f32) -> f64 {
    gamma_f64(24) * 2.0 * f64::from(extent)
}

/// The reciprocals of a direction, per axis.
///
/// A component so small that over any distance it moves the ray by less than a hundred-millionth of that, a zero of either
/// sign included, is replaced by the smallest that counts: products with planes stay numbers. The displacement vanishes in
/// [`cell_padding`].
#[inline(always)]
pub fn inverse_direction(dir: Vec3A) -> Vec3A {
    let size = dir.abs();
    if is_tiny(size.max_element()) {
        inverse_of_tiny(dir)
    } else {
        1.0 / size.max(Vec3A::splat(LEAST_COMPONENT)).copysign(dir)
    }
}

/// What counts as nothing in a direction.
const LEAST_COMPONENT: f32 = 1e-20;

/// Whether a direction whose largest component is `size` is not much longer than what counts as nothing in it.
#[inline(always)]
pub fn is_tiny(size: f32) -> bool {
    let is_long = size > 1e8 * LEAST_COMPONENT;
    !is_long
}

/// [`inverse_direction`] along one axis of a direction that is not [tiny](is_tiny).
#[inline(always)]
pub fn inverse_component(component: f32) -> f32 {
    let size = component.abs();
    let size = if size > LEAST_COMPONENT { size } else { LEAST_COMPONENT };
    1.0 / size.copysign(component)
}

/// [`inverse_direction`] of one that is not much longer than what counts as nothing there.
#[cold]
#[inline(never)]
fn inverse_of_tiny(dir: Vec3A) -> Vec3A {
    let size = dir.abs();
    let smallest = UNIT_ROUNDOFF * UNIT_ROUNDOFF * size.max_element();
    1.0 / size.max(Vec3A::splat(smallest)).copysign(dir)
}

/// Bound of the rounding, in `f32`, of the discriminant of a line and a sphere: `r^2 d^2 - |l x d|^2` with the radius `r`, the
/// vector `l` from a point of the line to the centre, `distance` long, and the direction `d`; per unit of `d^2`.
///
/// It holds where the discriminant is near 0, and so `|l x d|` near `r |d|`. Each component of the cross product has three
/// roundings on `|l| |d|` at most, the one of `l` included; its square counts them twice, and the last terms are those of the
/// squares.
pub fn line_and_sphere(distance: f32, radius: f32) -> f32 {
    let across = gamma(8) * distance;
    2.0 * across * radius + across * across + gamma(8) * radius * radius
}

/// Bound of the distance, per axis, between the points of a segment in the space of a shape and those that `f32` makes of
/// it: its start was mapped in `f64` and is rounded once, its direction, up to `reach` long per axis, is mapped by the
/// rounded map `linear`. `size` is the largest coordinate of the shape, whose own rounding counts as well.
pub fn local_segment(origin: Vec3, linear: Mat3, reach: Vec3, size: Vec3) -> f32 {
    let mapped =
        linear.x_axis.abs() * reach.x + linear.y_axis.abs() * reach.y + linear.z_axis.abs() * reach.z;
    gamma(8) * (origin.abs() + mapped + size).max_element() + f32::MIN_POSITIVE
}

/// Bound, per axis and in lengths, of the error of the distance to a plane as `plane * inverse - origin * inverse`, where
/// `extent` is the sum of the magnitudes of plane and origin.
///
/// The inverse, the product with the origin, a margin added to it, and the difference are rounded once each.
#[inline]
pub fn slab_padding(extent: Vec3A) -> Vec3A {
    gamma(6) * extent
}
