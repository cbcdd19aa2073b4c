//! Openness to the sky: the share of the hemisphere, weighted by the cosine, that nothing covers within a distance.
//!
//! # Source
//! Zhukov, Iones, Kronin, "An Ambient Light Illumination Model", EGWR 1998.

use super::{CameraRay, Integrator, Sample, first::first_hit};
use crate::counters::RayCounters;
use crate::sampler::Sampler;
use crate::world::World;
use heliostat_geometry::OrthonormalFrame;
use heliostat_geometry::warp::square_to_cosine_hemisphere;
use heliostat_scene::{RenderSettings, Rgb};

/// Openness to the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmbientOcclusion {
    samples: u32,
    distance: f32,
}

impl AmbientOcclusion {
    /// By the settings for the number and the length of rays.
    pub fn new(settings: &RenderSettings) -> Self {
        Self { samples: settings.ao_samples.max(1), distance: settings.ao_distance }
    }
}

impl Integrator for AmbientOcclusion {
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        let Some((surface, first)) = first_hit(world, ray) else { return Sample::NOTHING };
        let frame = OrthonormalFrame::around(first.normal);
        let at = surface.hit.at;
        let ng = if at.ng.dot(ray.ray.dir) < 0.0 { at.ng } else { -at.ng };
        let mut open = Rgb::ZERO;
        for u in sampler.array_2d(self.samples) {
            let dir = frame.to_world(square_to_cosine_hemisphere(u));
            // A bent normal's hemisphere reaches below the surface: that part is covered.
            if dir.dot(ng) > 0.0 {
                counters.ao += 1;
                open += world.transmittance(&at.spawn(dir).until(self.distance), ray.time);
            }
        }
        Sample::on(first, open / self.samples as f32)
    }
}
