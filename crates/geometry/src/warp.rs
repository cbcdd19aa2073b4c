//! Maps from the unit square to the domains that rays are drawn from, each with its density.
//!
//! Every map is pure: the random numbers are its argument, in `[0, 1)`. Maps are area-preserving up to the constant
//! or cosine that the density names, and keep neighbours together, so that stratified samples stay stratified.
//! Directions are around `+z`; [`crate::OrthonormalFrame`] turns them. Maps onto shapes are in [`crate::shape`].

use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_4, PI, TAU};

/// A uniform point in the unit disk, the square's centre in the middle and its border on the rim.
///
/// ```
/// use glam::Vec2;
/// use heliostat_geometry::warp::{disk_to_square, square_to_disk};
///
/// assert_eq!(square_to_disk(Vec2::splat(0.5)), Vec2::ZERO);
/// let u = Vec2::new(0.3, 0.8);
/// assert!(disk_to_square(square_to_disk(u)).distance(u) < 1e-6);
/// ```
///
/// # Source
/// Shirley, Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997.
#[inline(always)]
pub fn square_to_disk(u: Vec2) -> Vec2 {
    let offset = 2.0 * u - Vec2::ONE;
    // Each quarter of the square, from diagonal to diagonal, goes to a quarter of the disk. Choices instead of branches,
    // so that a loop over many points runs in lanes.
    let is_wide = offset.x.abs() > offset.y.abs();
    let (radius, other) = if is_wide { (offset.x, offset.y) } else { (offset.y, offset.x) };
    let share = if radius == 0.0 { 0.0 } else { other / radius };
    let (sin, cos) = sin_cos_of_eighth(share);
    radius * if is_wide { Vec2::new(cos, sin) } else { Vec2::new(sin, cos) }
}

/// Sine and cosine of `share` of an eighth of a turn, for `share` in `[-1, 1]`.
///
/// The series of Taylor up to the power from which on nothing is left in an `f32`: what follows is below
/// `(pi / 4)^10 / 10!`, less than half of the unit roundoff. Several times faster than the functions for all angles.
#[inline(always)]
fn sin_cos_of_eighth(share: f32) -> (f32, f32) {
    let x = FRAC_PI_4 * share;
    let x2 = x * x;
    let sin = 1.0
        - x2 * (1.0 / 6.0)
            * (1.0 - x2 * (1.0 / 20.0) * (1.0 - x2 * (1.0 / 42.0) * (1.0 - x2 * (1.0 / 72.0))));
    let cos =
        1.0 - x2 * 0.5 * (1.0 - x2 * (1.0 / 12.0) * (1.0 - x2 * (1.0 / 30.0) * (1.0 - x2 * (1.0 / 56.0))));
    (x * sin, cos)
}

/// The inverse of [`square_to_disk`].
pub fn disk_to_square(p: Vec2) -> Vec2 {
    let radius = p.length();
    if radius == 0.0 {
        return Vec2::splat(0.5);
    }
    // Each quarter of the square, from diagonal to diagonal, went to a quarter of the disk.
    let offset = if p.x.abs() > p.y.abs() {
        let x = radius.copysign(p.x);
        Vec2::new(x, x * (p.y / p.x).atan() / FRAC_PI_4)
    } else {
        let y = radius.copysign(p.y);
        Vec2::new(y * (p.x / p.y).atan() / FRAC_PI_4, y)
    };
    (0.5 * (offset + Vec2::ONE)).clamp(Vec2::ZERO, Vec2::ONE)
}

/// Density of [`square_to_disk`] per unit of area.
pub const DISK_PDF: f32 = FRAC_1_PI;

/// A direction over `z >= 0` with density proportional to its cosine with `+z`.
///
/// # Source
/// Malley's method: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, A.5.3.
pub fn square_to_cosine_hemisphere(u: Vec2) -> Vec3 {
    let p = square_to_disk(u);
    p.extend((1.0 - p.length_squared()).max(0.0).sqrt())
}

/// The inverse of [`square_to_cosine_hemisphere`].
pub fn cosine_hemisphere_to_square(dir: Vec3) -> Vec2 {
    disk_to_square(dir.truncate())
}

/// Density of [`square_to_cosine_hemisphere`] per steradian, for a unit direction.
pub fn cosine_hemisphere_pdf(dir: Vec3) -> f32 {
    dir.z.max(0.0) * FRAC_1_PI
}

/// A uniform direction over `z >= 0`.
///
/// The disk is lifted onto the hemisphere by Lambert's equal-area projection.
pub fn square_to_hemisphere(u: Vec2) -> Vec3 {
    let p = square_to_disk(u);
    let height = p.length_squared().min(1.0);
    ((2.0 - height).sqrt() * p).extend(1.0 - height)
}

/// The inverse of [`square_to_hemisphere`].
pub fn hemisphere_to_square(dir: Vec3) -> Vec2 {
    disk_to_square(dir.truncate() / (1.0 + dir.z.max(0.0)).sqrt())
}

/// Density of [`square_to_hemisphere`] per steradian, for a unit direction.
pub fn hemisphere_pdf(dir: Vec3) -> f32 {
    if dir.z < 0.0 { 0.0 } else { 0.5 * FRAC_1_PI }
}

/// A uniform direction: `u.x` turns around z, `u.y` falls from `+z` to `-z`.
pub fn square_to_sphere(u: Vec2) -> Vec3 {
    let z = 1.0 - 2.0 * u.y;
    // `1 - z^2` in a form that keeps its digits at the poles.
    let ring = 2.0 * (u.y * (1.0 - u.y)).max(0.0).sqrt();
    (ring * Vec2::from_angle(TAU * u.x)).extend(z)
}

/// The inverse of [`square_to_sphere`].
pub fn sphere_to_square(dir: Vec3) -> Vec2 {
    let turn = dir.y.atan2(dir.x) / TAU;
    Vec2::new(if turn < 0.0 { turn + 1.0 } else { turn }, (0.5 - 0.5 * dir.z).clamp(0.0, 1.0))
}

/// Density of [`square_to_sphere`] per steradian.
pub const SPHERE_PDF: f32 = 0.25 * FRAC_1_PI;

/// Barycentric weights of a uniform point in a triangle; the density is one over its area.
///
/// # Source
/// Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
pub fn square_to_triangle(u: Vec2) -> [f32; 3] {
    let (a, b) = if u.x < u.y {
        let a = 0.5 * u.x;
        (a, u.y - a)
    } else {
        let b = 0.5 * u.y;
        (u.x - b, b)
    };
    [a, b, (1.0 - a - b).max(0.0)]
}

/// The inverse of [`square_to_triangle`].
pub fn triangle_to_square(weights: [f32; 3]) -> Vec2 {
    let [a, b, _] = weights;
    if a < b { Vec2::new(2.0 * a, b + a) } else { Vec2::new(a + b, 2.0 * b) }
}

/// A uniform point in the regular polygon with `sides` corners on the unit circle, one of them at `(1, 0)`.
///
/// This is the opening of an iris with that many blades. Fewer than 3 sides give the disk.
///
/// ```
/// use glam::Vec2;
/// use heliostat_geometry::warp::{polygon_pdf, square_to_polygon};
///
/// assert_eq!(square_to_polygon(Vec2::new(0.5, 0.0), 6), Vec2::ZERO);
/// // The square on its corner has area 2.
/// assert!((polygon_pdf(4) - 0.5).abs() < 1e-6);
/// ```
pub fn square_to_polygon(u: Vec2, sides: u32) -> Vec2 {
    if sides < 3 {
        return square_to_disk(u);
    }
    // One slice per side; in it, the distance from the centre by a square root and the place along the side.
    let turn = u.x * sides as f32;
    let slice = turn.floor().min(sides as f32 - 1.0);
    let corner = |k: f32| Vec2::from_angle(TAU * k / sides as f32);
    u.y.sqrt() * corner(slice).lerp(corner(slice + 1.0), turn - slice)
}

/// The inverse of [`square_to_polygon`].
pub fn polygon_to_square(p: Vec2, sides: u32) -> Vec2 {
    if sides < 3 {
        return disk_to_square(p);
    }
    let step = TAU / sides as f32;
    let angle = p.y.atan2(p.x);
    let slice = ((if angle < 0.0 { angle + TAU } else { angle }) / step).floor().min(sides as f32 - 1.0);
    let (first, second) = (Vec2::from_angle(step * slice), Vec2::from_angle(step * (slice + 1.0)));
    // p = x * first + y * second, by Cramer's rule.
    let area = first.perp_dot(second);
    let (x, y) = (p.perp_dot(second) / area, first.perp_dot(p) / area);
    let scale = x + y;
    let along = if scale > 0.0 { y / scale } else { 0.0 };
    Vec2::new(((slice + along) / sides as f32).clamp(0.0, 1.0), (scale * scale).clamp(0.0, 1.0))
}

/// Density of [`square_to_polygon`] per unit of area.
pub fn polygon_pdf(sides: u32) -> f32 {
    if sides < 3 { DISK_PDF } else { 2.0 / (sides as f32 * (TAU / sides as f32).sin()) }
}

/// A uniform direction within `angle` radians of `+z`; `angle` in `(0, pi]`.
pub fn square_to_cone(u: Vec2, angle: f32) -> Vec3 {
    // Count from the pole, where `1 - cos` keeps its digits for the narrowest cone.
    let p = square_to_disk(u);
    let height = p.length_squared().min(1.0) * cone_height(angle);
    let ring = (cone_height(angle) * (2.0 - height)).max(0.0).sqrt();
    (ring * p).extend(1.0 - height)
}

/// The inverse of [`square_to_cone`], for a unit direction inside the cone.
pub fn cone_to_square(dir: Vec3, angle: f32) -> Vec2 {
    // `1 - z` from the ring where z is near 1.
    let ring_squared = dir.truncate().length_squared();
    let height = if dir.z > 0.0 { ring_squared / (1.0 + dir.z) } else { 1.0 - dir.z };
    let radius = (height / cone_height(angle)).min(1.0).sqrt();
    disk_to_square(radius * dir.truncate().normalize_or_zero())
}

/// Density of [`square_to_cone`] per steradian inside the cone.
pub fn cone_pdf(angle: f32) -> f32 {
    1.0 / (TAU * cone_height(angle))
}

/// The height of the spherical cap: `1 - cos(angle)`, without cancellation.
fn cone_height(angle: f32) -> f32 {
    2.0 * (0.5 * angle.min(PI)).sin().powi(2)
}
