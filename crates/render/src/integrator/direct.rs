//! Light that comes straight from the lights to what the camera sees: paths of one scattering.

use super::path::Path;
use super::{CameraRay, Integrator, Sample};
use crate::counters::RayCounters;
use crate::sampler::Sampler;
use crate::world::World;
use heliostat_scene::RenderSettings;
use heliostat_scene::settings::{Caustics, DepthLimits};

/// Direct light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direct(Path);

impl Direct {
    /// By the settings for the background.
    pub fn new(settings: &RenderSettings) -> Self {
        let depth_limits = DepthLimits { total: 0, ..DepthLimits::default() };
        Self(Path::new(&RenderSettings {
            depth_limits,
            clamp_indirect: None,
            caustics: Caustics::Paths,
            ..settings.clone()
        }))
    }
}

impl Integrator for Direct {
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        self.0.radiance(world, ray, sampler, counters)
    }
}
