//! A ray and the range of distances it looks at.

use glam::{DVec3, Vec3};

/// A closed range of ray parameters `[min, max]`; empty when `min > max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Smallest parameter inside.
    pub min: f32,
    /// Largest parameter inside; may be infinite.
    pub max: f32,
}

impl Interval {
    /// From the origin to infinity.
    pub const POSITIVE: Self = Self { min: 0.0, max: f32::INFINITY };

    /// Whether `t` lies inside; false for NaN.
    #[inline]
    pub fn contains(self, t: f32) -> bool {
        self.min <= t && t <= self.max
    }

    /// The part that both cover; may be empty.
    #[must_use]
    #[inline]
    pub fn intersect(self, other: Self) -> Self {
        Self { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// Whether no parameter lies inside.
    #[inline]
    pub fn is_empty(self) -> bool {
        // Written so that a NaN end counts as empty.
        let holds_some = self.min <= self.max;
        !holds_some
    }
}

/// A half line `origin + t * dir` for `t` in `range`.
///
/// `dir` need not be a unit vector; `t` counts in lengths of `dir`, so an affine transform of the ray keeps `t`.
///
/// ```
/// use glam::Vec3;
/// use heliostat_geometry::Ray;
///
/// let ray = Ray::new(Vec3::ZERO, Vec3::new(0.0, 0.0, -2.0)).until(10.0);
/// assert_eq!(ray.at(3.0), Vec3::new(0.0, 0.0, -6.0));
/// assert!(ray.range.contains(10.0) && !ray.range.contains(10.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where `t = 0`.
    pub origin: Vec3,
    /// Direction; not zero, not necessarily unit.
    pub dir: Vec3,
    /// Parameters at which a hit counts.
    pub range: Interval,
}

impl Ray {
    /// A ray over all of `t >= 0`.
    #[inline]
    pub fn new(origin: Vec3, dir: Vec3) -> Self {
        Self { origin, dir, range: Interval::POSITIVE }
    }

    /// The point at parameter `t`.
    #[inline]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + t * self.dir
    }

    /// The same ray that ends at `t_max`.
    #[must_use]
    pub fn until(self, t_max: f32) -> Self {
        Self { range: Interval { max: t_max, ..self.range }, ..self }
    }

    /// Whether origin and direction are finite and the direction is not zero.
    pub fn is_valid(&self) -> bool {
        self.origin.is_finite() && self.dir.is_finite() && self.dir != Vec3::ZERO
    }
}

/// A ray in the local space of an analytic shape, in double precision.
///
/// Shapes solve for their roots in `f64`, so that the rounding of the roots vanishes beside that of the `f32`
/// origin; see [`crate::shape`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalRay {
    /// Where `t = 0`, in local space.
    pub origin: DVec3,
    /// Direction in local space; not necessarily unit.
    pub dir: DVec3,
    /// Parameters at which a hit counts.
    pub range: Interval,
}

impl LocalRay {
    /// The point at parameter `t`.
    #[inline]
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.dir
    }

    /// Whether a root counts: it lies in the range once it is rounded to the `f32` that callers compare.
    #[inline]
    pub fn accepts(&self, t: f64) -> bool {
        // The sign is judged before rounding: a root behind the origin stays behind it. A root beyond all `f32`
        // is nowhere.
        let rounded = t as f32;
        t > 0.0 && rounded < f32::INFINITY && self.range.contains(rounded)
    }
}

impl From<&Ray> for LocalRay {
    fn from(ray: &Ray) -> Self {
        Self { origin: ray.origin.as_dvec3(), dir: ray.dir.as_dvec3(), range: ray.range }
    }
}
