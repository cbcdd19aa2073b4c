//! A ray against many boxes, one by one.

use glam::Vec3;
use heliostat_geometry::error_bound::{cell_padding, inverse_direction};
use heliostat_geometry::{Aabb, Ray};

/// A ray with what all boxes need worked out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slabs {
    origin: Vec3,
    inverse: Vec3,
    origin_reach: f32,
}

impl Slabs {
    #[inline]
    pub(super) fn new(ray: &Ray) -> Self {
        let inverse = inverse_direction(ray.dir);
        Self { origin: ray.origin, inverse, origin_reach: ray.origin.abs().max_element() }
    }

    /// Whether the ray may meet a box in its range; false only where it does not.
    ///
    /// # Source
    /// Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986; distances are grown by their rounding as in Ize,
    /// "Robust BVH Ray Traversal", JCGT 2013.
    #[inline]
    pub(super) fn may_meet(&self, ray: &Ray, bounds: &Aabb) -> bool {
        let reach = self.origin_reach + bounds.min.abs().max(bounds.max.abs()).max_element();
        let a = (bounds.min - self.origin) * self.inverse;
        let b = (bounds.max - self.origin) * self.inverse;
        let padding = cell_padding(reach, reach) * self.inverse.abs();
        let near = (a.min(b) - padding).max_element().max(ray.range.min);
        let far = (a.max(b) + padding).min_element().min(ray.range.max);
        // A NaN, from an infinite box, does not say that it misses.
        let misses = near > far;
        !misses
    }
}
