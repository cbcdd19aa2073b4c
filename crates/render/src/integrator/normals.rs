//! Shading normals as colours: `(n + 1) / 2` in world space, turned to the viewer. Shows wrong normals at once.

use super::{CameraRay, Integrator, Sample, first::first_hit};
use crate::counters::RayCounters;
use crate::sampler::Sampler;
use crate::world::World;
use heliostat_scene::Rgb;

/// Shading normals as colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Normals;

impl Integrator for Normals {
    fn radiance(&self, world: &World<'_>, ray: &CameraRay, _: &mut Sampler, _: &mut RayCounters) -> Sample {
        first_hit(world, ray)
            .map_or(Sample::NOTHING, |(_, first)| Sample::on(first, 0.5 * (first.normal + Rgb::ONE)))
    }
}
