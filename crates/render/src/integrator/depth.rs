//! Perpendicular distance as grey: white where the box around the scene begins, black where it ends.
//!
//! The distance itself is in the `Z` layer.

use super::{CameraRay, Integrator, Sample, first::first_hit};
use crate::counters::RayCounters;
use crate::sampler::Sampler;
use crate::world::World;
use heliostat_scene::Rgb;

/// Perpendicular distance as grey.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Depth;

impl Integrator for Depth {
    fn radiance(&self, world: &World<'_>, ray: &CameraRay, _: &mut Sampler, _: &mut RayCounters) -> Sample {
        first_hit(world, ray).map_or(Sample::NOTHING, |(_, first)| {
            // Depths of the box around the scene, from the camera on.
            let corners = world.bounds().corners().map(|corner| ray.perpendicular_depth(corner));
            let near = corners.into_iter().fold(f32::INFINITY, f32::min).max(0.0);
            let far = corners.into_iter().fold(near, f32::max);
            let share = (far - ray.perpendicular_depth(first.p)) / (far - near);
            // Without anything finite there is no scale: all is grey.
            let grey = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 };
            Sample::on(first, Rgb::splat(grey))
        })
    }
}
