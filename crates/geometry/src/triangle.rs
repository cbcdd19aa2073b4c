//! Ray against triangle, watertight: a ray never slips through the edge or vertex that triangles share.
//!
//! The test runs in the plane across the ray, where every vertex lands on one point whatever triangle it belongs
//! to, and the sign of an edge function is exact; so neighbours agree on which side of their edge the ray
//! passes. Both sides of a triangle are hit. This module knows one triangle; the arrays are in [`crate::mesh`].
//!
//! Distance and weights are not those of the `f32` verdict but worked out again in `f64`, where the ray truly meets the
//! plane, so that a ray that [`crate::Hit::spawn`] moved off the triangle sees it behind itself, at any scale.
//!
//! # Source
//! Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.

use crate::error_bound::{least_area, sheared_corner};
use crate::ray::{Interval, Ray};
use glam::{DVec3, Vec3, Vec3A, Vec3Swizzles, Vec4, Vec4Swizzles};

/// A ray with the shear that turns its direction into the third axis, worked out once per ray.
///
/// ```
/// use glam::Vec3;
/// use heliostat_geometry::triangle::{TriangleRay, intersect};
/// use heliostat_geometry::{Interval, Ray};
///
/// let ray = TriangleRay::new(&Ray::new(Vec3::new(0.25, 0.25, 2.0), Vec3::NEG_Z));
/// let hit = intersect(&ray, Interval::POSITIVE, [Vec3::ZERO, Vec3::X, Vec3::Y]).unwrap();
/// assert_eq!((hit.t, hit.barycentric), (2.0, [0.5, 0.25, 0.25]));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct TriangleRay {
    /// The axis (0, 1, 2) along which the direction is longest. All below are turned so that it is the last one.
    along: usize,
    origin: Vec3A,
    dir: Vec3A,
    /// Slopes of the direction along the first two axes over the last one, and one over the direction along that.
    slope: Vec3A,
}

impl TriangleRay {
    /// Prepares `ray`; worth it once per ray and space, not per triangle.
    #[inline(always)]
    pub fn new(ray: &Ray) -> Self {
        let along = Self::main_axis(ray.dir.into());
        Self::from_turned(along, turned(along, ray.origin.into()), turned(along, ray.dir.into()))
    }

    /// A ray whose coordinates were [`turned`], its [main axis](Self::main_axis) last.
    #[inline(always)]
    pub fn from_turned(along: usize, origin: Vec3A, dir: Vec3A) -> Self {
        Self { along, origin, dir, slope: Vec3A::new(dir.x, dir.y, 1.0) / dir.z }
    }

    /// The axis (0, 1, 2) along which a direction is longest; of several the first.
    #[inline(always)]
    pub fn main_axis(dir: Vec3A) -> usize {
        let size = dir.abs();
        let is_longest = size.cmpge(size.yzx()) & size.cmpge(size.zxy());
        (is_longest.bitmask() | 0b100).trailing_zeros() as usize
    }

    /// The axis along which the direction is longest.
    #[inline(always)]
    pub fn along(&self) -> usize {
        self.along
    }

    /// The origin in cyclic order, the axis along which the direction is longest last.
    #[inline(always)]
    pub fn origin(&self) -> Vec3A {
        self.origin
    }

    /// The direction in that order.
    #[inline(always)]
    pub fn dir(&self) -> Vec3A {
        self.dir
    }

    /// Slopes of the direction along the first two axes of that order over the last one, and one over the direction along that.
    #[inline(always)]
    pub fn slope(&self) -> Vec3A {
        self.slope
    }

    /// Where the corners land in the plane across the ray.
    ///
    /// It must stay a function of the ray and the corner alone: on that the watertightness rests.
    #[inline(always)]
    fn project(&self, [a, b, c]: [Vec3; 3]) -> Projected {
        let origin = self.origin;
        let z = Vec4::new(a.z, b.z, c.z, origin.z) - origin.z;
        let x = Vec4::new(a.x, b.x, c.x, origin.x) - origin.x;
        let y = Vec4::new(a.y, b.y, c.y, origin.y) - origin.y;
        let reach = x.abs().max(y.abs()).max(z.abs()).max_element();
        Projected { x: x - self.slope.x * z, y: y - self.slope.y * z, reach }
    }
}

/// A triangle seen along a ray: a lane for each corner, the last lane is 0.
struct Projected {
    x: Vec4,
    y: Vec4,
    /// The largest coordinate of a corner, seen from the origin of the ray.
    reach: f32,
}

/// The coordinates in cyclic order, axis `along` (0, 1, 2) last: what [`TriangleRay::from_turned`] takes.
#[inline(always)]
pub fn turned(along: usize, v: Vec3A) -> Vec3A {
    match along {
        0 => v.yzx(),
        1 => v.zxy(),
        _ => v,
    }
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Ray parameter.
    pub t: f32,
    /// Weights of the corners a, b, c; each in `[0, 1]`, their sum 1 up to rounding.
    pub barycentric: [f32; 3],
}

/// Where `ray` meets the triangle `corners`, from either side, at a `t > 0` inside `range`.
///
/// `range` stands beside the ray because it shrinks during a search. Triangles without area, corners that are not
/// finite and rays without direction give `None`.
#[inline]
pub fn intersect(ray: &TriangleRay, range: Interval, corners: [Vec3; 3]) -> Option<TriangleHit> {
    let corners = corners.map(|corner| turned(ray.along, corner.into()).into());
    // Look down the ray: the origin becomes (0, 0), and the ray the point there.
    let seen = ray.project(corners);
    let Projected { x, y, .. } = seen;
    // Twice the signed areas that the point spans with the edges opposite to a, b, c. The two products are rounded in
    // the same direction as they compare, so a sign is right or the difference is 0.
    let areas = x.zxyw() * y.yzxw() - y.zxyw() * x.yzxw();
    // The point is outside when it lies left of one edge and right of another.
    if areas.cmplt(Vec4::ZERO).any() && areas.cmpgt(Vec4::ZERO).any() {
        return None;
    }

    // What is left is likely a hit: decide it with products that `f64` holds exactly.
    let [u, v, w] = exact_areas(&seen);
    if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
        return None;
    }
    let hit = match intersect_inside(ray, corners) {
        Some(hit) if hit.t > 0.0 && !is_flat(corners) => hit,
        Some(_) => return None,
        None => hit_at_rim(ray, corners, &seen, [u, v, w])?,
    };
    range.contains(hit.t).then_some(hit)
}

/// Twice the areas that the point (0, 0) spans with the edges opposite to the corners, from exact products.
#[inline(always)]
fn exact_areas(&Projected { x, y, .. }: &Projected) -> [f64; 3] {
    let (x, y) = (x.as_dvec4(), y.as_dvec4());
    (x.zxyw() * y.yzxw() - y.zxyw() * x.yzxw()).xyz().to_array()
}

/// What [`intersect`] says of a triangle with an area that is known to be hit, for less; `None` where rounding might put
/// the hit outside, and only [`intersect`] can tell.
///
/// The coordinates of the corners are [`turned`] as those of the ray. Anything may come of other triangles.
#[inline(always)]
pub fn intersect_inside(ray: &TriangleRay, corners: [Vec3; 3]) -> Option<TriangleHit> {
    let [a, b, c] = corners;
    let (origin, dir) = (ray.origin, ray.dir.as_dvec3());
    // As `project` does, with all digits: a lane for each corner, the last lane is 0.
    let z = Vec4::new(a.z, b.z, c.z, origin.z).as_dvec4() - f64::from(origin.z);
    let x = Vec4::new(a.x, b.x, c.x, origin.x).as_dvec4() - f64::from(origin.x);
    let y = Vec4::new(a.y, b.y, c.y, origin.y).as_dvec4() - f64::from(origin.y);
    let inverse = 1.0 / dir.z;
    let x = x - dir.x * inverse * z;
    let y = y - dir.y * inverse * z;
    let products = x.zxyw() * y.yzxw();
    let areas = products - y.zxyw() * x.yzxw();
    let differ = (areas.x.to_bits() ^ areas.y.to_bits()) | (areas.x.to_bits() ^ areas.z.to_bits());
    let is_inside = differ >> (u64::BITS - 1) == 0;
    // Where the products all but cancel, on slivers and edge on, rounding turns the weights.
    let area = areas.x + areas.y + areas.z;
    let size = products.abs();
    let is_sharp = area.abs() > least_area(size.x + size.y + size.z);
    // The mean of the depths, weighted by the areas.
    let weights = areas * (1.0 / area);
    let depths = weights * z;
    let t = ((depths.x + depths.y + depths.z) * inverse) as f32;
    let barycentric = weights.xyz().as_vec3().to_array();
    // Without an area the mean is not a number.
    (is_inside & is_sharp & (t.abs() < f32::INFINITY)).then_some(TriangleHit { t, barycentric })
}

/// The hit of a ray that meets a triangle where its corners are seen, but so near to an edge, or so near to seeing it edge on,
/// that it may truly miss; `None` where it is seen edge on or lies behind the origin.
#[cold]
#[inline(never)]
fn hit_at_rim(
    ray: &TriangleRay,
    corners: [Vec3; 3],
    seen: &Projected,
    areas: [f64; 3],
) -> Option<TriangleHit> {
    let area = areas[0] + areas[1] + areas[2];
    // A triangle seen edge on covers nothing; infinities and NaN end here too.
    let scale = 1.0 / area;
    if !scale.is_normal() {
        return None;
    }
    let weights = [areas[0] * scale, areas[1] * scale, areas[2] * scale];
    let t = plane_distance(ray, corners, weights, seen.reach)? as f32;
    let barycentric = [weights[0] as f32, weights[1] as f32, weights[2] as f32];
    (t < f32::INFINITY).then_some(TriangleHit { t, barycentric })
}

/// The distance to the plane of a triangle that the line of the ray is known to meet; `None` behind the origin. `reach` is the
/// largest coordinate of a corner, seen from the origin.
fn plane_distance(ray: &TriangleRay, corners: [Vec3; 3], weights: [f64; 3], reach: f32) -> Option<f64> {
    let (origin, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
    let normal = normal(corners);
    if normal == DVec3::ZERO {
        return None;
    }
    let a = corners[0].as_dvec3() - origin;

    // Where the test across the ray saw the hit, along the sheared axis: a place of the triangle itself.
    let inverse = 1.0 / dir.z;
    let at = corners.map(|corner| (f64::from(corner.z) - origin.z) * inverse);
    let seen = weights[0] * at[0] + weights[1] * at[1] + weights[2] * at[2];
    let nearest = at[0].min(at[1]).min(at[2]);
    let farthest = at[0].max(at[1]).max(at[2]);

    // The sign of the quotient decides only when the triangle reaches back to the origin: a triangle that is wholly
    // ahead is hit, or a ray along a silhouette could leave a closed mesh.
    let facing = normal.dot(dir);
    let t = normal.dot(a) / facing;
    let is_ahead = nearest > 0.0;
    if facing == 0.0 {
        return is_ahead.then_some(seen);
    }
    // The plane of a triangle seen almost edge on may be met far from it: hold the quotient to the place where the
    // triangle was seen, give or take the displacement of its corners, and to the triangle.
    let slack = f64::from(sheared_corner(reach)) * inverse.abs();
    let held = t.max(seen - slack).min(seen + slack).max(nearest).min(farthest);
    (t > 0.0 || is_ahead).then_some(held)
}

/// A normal whose length is twice the area.
#[inline(always)]
fn normal(corners: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = corners;
    let a = a.as_dvec3();
    (b.as_dvec3() - a).cross(c.as_dvec3() - a)
}

/// Whether a triangle has no area, so that [`intersect`] never hits it.
pub fn is_flat(corners: [Vec3; 3]) -> bool {
    normal(corners) == DVec3::ZERO
}
