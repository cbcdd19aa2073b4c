//! The truth: every primitive, for every ray.

use crate::query::{Found, Nearest, RayIndex};
use heliostat_geometry::Ray;

/// An index that skips nothing. Linear in the number of primitives, and beyond doubt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BruteForce {
    primitives: u32,
}

impl BruteForce {
    /// Over primitives `0..primitives`.
    pub fn new(primitives: u32) -> Self {
        Self { primitives }
    }
}

impl RayIndex for BruteForce {
    fn closest_hit<T>(
        &self,
        ray: &Ray,
        mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
    ) -> Option<Found<T>> {
        let mut nearest = Nearest::new(ray);
        for primitive in 0..self.primitives {
            nearest.test(primitive, &mut hit);
        }
        nearest.found
    }

    fn any_hit(&self, ray: &Ray, mut hit: impl FnMut(u32, &Ray) -> bool) -> bool {
        (0..self.primitives).any(|primitive| hit(primitive, ray))
    }

    fn for_each_hit(&self, _ray: &Ray, visit: impl FnMut(u32)) {
        (0..self.primitives).for_each(visit);
    }
}
