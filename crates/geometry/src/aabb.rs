//! Axis-aligned boxes.

use crate::ray::{Interval, Ray};
use glam::Vec3;

/// A closed axis-aligned box. Empty when any `min` lies above its `max`; sides may be infinite.
///
/// ```
/// use glam::Vec3;
/// use heliostat_geometry::{Aabb, Ray};
///
/// let bounds = Aabb::of_points([Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0)]);
/// assert_eq!((bounds.surface_area(), bounds.longest_axis()), (22.0, 2));
/// assert!(bounds.clip(&Ray::new(Vec3::new(0.5, 1.0, 9.0), Vec3::NEG_Z)).is_some());
/// assert!(bounds.clip(&Ray::new(Vec3::new(0.5, 1.0, 9.0), Vec3::Z)).is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Lower corner.
    pub min: Vec3,
    /// Upper corner.
    pub max: Vec3,
}

impl Aabb {
    /// The box of nothing: the neutral element of [`Aabb::union`].
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// All of space.
    pub const EVERYTHING: Self = Self { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY };

    /// The smallest box around `points`; empty for no points.
    pub fn of_points(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::grow)
    }

    /// The smallest box around this and `point`.
    #[must_use]
    pub fn grow(self, point: Vec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box that both cover; may be empty.
    #[must_use]
    pub fn intersect(self, other: Self) -> Self {
        Self { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// Whether no point lies inside.
    pub fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether both corners are finite.
    pub fn is_finite(self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// Whether `point` lies inside or on the border.
    pub fn contains(self, point: Vec3) -> bool {
        self.min.cmple(point).all() && point.cmple(self.max).all()
    }

    /// Whether `other` lies wholly inside; true for an empty `other`.
    pub fn contains_box(self, other: Self) -> bool {
        other.is_empty() || (self.min.cmple(other.min).all() && other.max.cmple(self.max).all())
    }

    /// Lengths of the sides; negative on an empty box.
    pub fn size(self) -> Vec3 {
        self.max - self.min
    }

    /// The middle.
    pub fn centre(self) -> Vec3 {
        // Halves first, so that huge boxes do not overflow.
        0.5 * self.min + 0.5 * self.max
    }

    /// Radius of the sphere around the box, 0 when empty.
    pub fn radius(self) -> f32 {
        if self.is_empty() { 0.0 } else { 0.5 * self.size().length() }
    }

    /// Sum of the areas of the six faces, in `f64`; 0 when empty.
    pub fn surface_area(self) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        let d = self.max.as_dvec3() - self.min.as_dvec3();
        2.0 * (d.x * d.y + d.y * d.z + d.z * d.x)
    }

    /// Volume, in `f64`; 0 when empty.
    pub fn volume(self) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        let d = self.max.as_dvec3() - self.min.as_dvec3();
        d.x * d.y * d.z
    }

    /// The axis (0, 1, 2) of the longest side; the first of equals.
    pub fn longest_axis(self) -> usize {
        let d = self.size();
        if d.x >= d.y && d.x >= d.z {
            0
        } else if d.y >= d.z {
            1
        } else {
            2
        }
    }

    /// The eight corners.
    pub fn corners(self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let pick = |bit: usize, low: f32, high: f32| if i & bit == 0 { low } else { high };
            Vec3::new(
                pick(1, self.min.x, self.max.x),
                pick(2, self.min.y, self.max.y),
                pick(4, self.min.z, self.max.z),
            )
        })
    }

    /// The part of the ray's range that lies in the box, grown so that rounding never loses a hit inside.
    ///
    /// # Source
    /// Ize, "Robust BVH Ray Traversal", JCGT 2013: the far distances are grown by `2 gamma(3)`. A ray that runs
    /// in the plane of a face counts as inside.
    pub fn clip(self, ray: &Ray) -> Option<Interval> {
        let mut range = ray.range;
        for axis in 0..3 {
            let (origin, dir) = (ray.origin[axis], ray.dir[axis]);
            if dir == 0.0 {
                if origin < self.min[axis] || origin > self.max[axis] {
                    return None;
                }
                continue;
            }
            // The near plane is on the side the ray comes from; on an empty box it lies beyond the far one.
            let (near, far) = if dir > 0.0 { (self.min, self.max) } else { (self.max, self.min) };
            let (near, far) = ((near[axis] - origin) / dir, (far[axis] - origin) / dir);
            range = range.intersect(crate::error_bound::grow_slab(near, far));
            if range.is_empty() {
                return None;
            }
        }
        Some(range)
    }
}
