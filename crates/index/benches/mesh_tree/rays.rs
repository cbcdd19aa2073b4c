//! Rays as a renderer asks them: those of a picture, side by side, and those between any two places.

use glam::Vec3;
use heliostat_geometry::strategies::Random;
use heliostat_geometry::{Interval, Ray};

/// Rays through the pixels of a square picture, so many a side, which shows the unit sphere from above.
pub(crate) fn coherent(side: u32) -> Vec<Ray> {
    let eye = Vec3::new(0.5, 1.8, 2.2);
    let view = -eye.normalize();
    let right = view.cross(Vec3::Y).normalize();
    let up = right.cross(view);
    let at = |k: u32| ((k as f32 + 0.5) / side as f32 - 0.5) * 0.8;
    (0..side * side).map(|i| Ray::new(eye, view + at(i % side) * right - at(i / side) * up)).collect()
}

/// Segments between random points of the cube around the unit sphere: `t` ends at 1.
pub(crate) fn incoherent(count: u32) -> Vec<Ray> {
    let mut random = Random::new(2);
    let range = Interval { min: 0.0, max: 1.0 };
    (0..count)
        .map(|_| {
            let (from, to) = (random.cube(), random.cube());
            Ray { range, ..Ray::new(from, to - from) }
        })
        .collect()
}
