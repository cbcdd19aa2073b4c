//! Surface parameters as colours: red is the fraction of u, green that of v.

use super::{CameraRay, Integrator, Sample, first::first_hit};
use crate::counters::RayCounters;
use crate::sampler::Sampler;
use crate::world::World;

/// Surface parameters as colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Uv;

impl Integrator for Uv {
    fn radiance(&self, world: &World<'_>, ray: &CameraRay, _: &mut Sampler, _: &mut RayCounters) -> Sample {
        first_hit(world, ray).map_or(Sample::NOTHING, |(_, first)| {
            // Fractions, but 1 stays 1, so that the far border of a shape does not turn black.
            let fraction = |v: f32| if v == 1.0 { 1.0 } else { v - v.floor() };
            Sample::on(first, first.uv.map(fraction).extend(0.0))
        })
    }
}
