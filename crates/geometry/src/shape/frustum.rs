//! The root finder that cylinder and cone share: a straight, round body between two heights.

use super::Root;
use crate::ray::LocalRay;
use glam::DVec3;

/// Number of the curved side.
pub(super) const SIDE: u8 = 0;
/// Number of the cap at the bottom.
pub(super) const BOTTOM: u8 = 1;
/// Number of the cap at the top.
pub(super) const TOP: u8 = 2;

/// The body around the y axis from `y = 0` to `y = height` with radius `radius + slope * y`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frustum {
    pub(super) radius: f64,
    pub(super) slope: f64,
    pub(super) height: f64,
    pub(super) capped: bool,
}

/// Where a line is inside the double cone that the side belongs to.
#[derive(Clone, Copy, Debug)]
struct Inside {
    first: f64,
    second: f64,
    /// Inside between the two, else outside between them.
    between: bool,
}

impl Inside {
    #[inline]
    fn contains(self, t: f64) -> bool {
        let between = self.first <= t && t <= self.second;
        if self.between { between } else { t <= self.first || self.second <= t }
    }
}

impl Frustum {
    /// The nearest root that the ray accepts.
    ///
    /// Cap and side roots are told apart by comparing the same four numbers, so that no ray finds a crack at the
    /// rim between them.
    #[inline]
    pub(super) fn hit(&self, ray: &LocalRay) -> Option<Root> {
        // Count distances from the point closest to the middle: far origins then cost no digits.
        let centre = DVec3::new(0.0, 0.5 * self.height, 0.0);
        let a = ray.dir.length_squared();
        let shift = (centre - ray.origin).dot(ray.dir) / a;
        let from = ray.origin + shift * ray.dir;
        let widest = self.radius.max(self.radius + self.slope * self.height);
        let reach_squared = widest * widest + centre.y * centre.y;
        if (from - centre).length_squared() > reach_squared {
            return None;
        }

        // The part of the line between the two heights.
        let (low, high) = if ray.dir.y == 0.0 {
            if from.y < 0.0 || from.y > self.height {
                return None;
            }
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            let (bottom, top) = (-from.y / ray.dir.y, (self.height - from.y) / ray.dir.y);
            if ray.dir.y > 0.0 { (bottom, top) } else { (top, bottom) }
        };
        if shift + high <= 0.0 {
            return None;
        }

        let inside = self.inside(from, ray.dir)?;
        let (near_cap, far_cap) = if ray.dir.y > 0.0 { (BOTTOM, TOP) } else { (TOP, BOTTOM) };
        let side = |t: f64| (low <= t && t <= high).then_some((t, SIDE));
        let cap = |t: f64, part| (self.capped && inside.contains(t)).then_some((t, part));
        // In the order along the ray: the slab is entered first and left last.
        [cap(low, near_cap), side(inside.first), side(inside.second), cap(high, far_cap)]
            .into_iter()
            .flatten()
            .map(|(t, part)| Root { t: shift + t, part })
            .find(|root| ray.accepts(root.t))
    }

    /// Where the line `from + t * dir` is inside the double cone; `None` when nowhere.
    #[inline]
    fn inside(&self, from: DVec3, dir: DVec3) -> Option<Inside> {
        // x^2 + z^2 <= (radius + slope * y)^2 along the line: a t^2 + 2 b t + c <= 0.
        let radius = self.radius + self.slope * from.y;
        let growth = self.slope * dir.y;
        let a = dir.x * dir.x + dir.z * dir.z - growth * growth;
        let b = from.x * dir.x + from.z * dir.z - radius * growth;
        let c = from.x * from.x + from.z * from.z - radius * radius;
        if a == 0.0 && b == 0.0 {
            // Along the axis of a cylinder.
            let always = Inside { first: f64::NEG_INFINITY, second: f64::INFINITY, between: true };
            return (c <= 0.0).then_some(always);
        }
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            // A steep line that misses the apex by less than rounding is inside all the way.
            let always = Inside { first: f64::INFINITY, second: f64::INFINITY, between: false };
            return (a < 0.0).then_some(always);
        }
        let q = -b - discriminant.sqrt().copysign(b);
        let (t0, t1) = if q == 0.0 {
            (0.0, 0.0)
        } else {
            // A line along the slope has one root; adding 0 sends the other to the infinity that `a > 0` means.
            (q / (a + 0.0), c / q)
        };
        Some(Inside { first: t0.min(t1), second: t0.max(t1), between: a >= 0.0 })
    }
}
