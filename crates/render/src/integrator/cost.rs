//! The work of the index as a heat map: nodes, leaves and primitive tests of both levels for the camera ray.
//!
//! Blue is little, red is much; the scale is logarithmic, so that no scene leaves it.

use super::{CameraRay, Integrator, Sample};
use crate::counters::RayCounters;
use crate::sampler::Sampler;
use crate::world::World;
use glam::{Vec3, Vec4};
use heliostat_index::TraversalCost;
use heliostat_scene::Rgb;
use heliostat_scene::color::srgb_to_linear;

/// Steps at the red end of the scale; at the other end is the one step of a ray that passes everything by.
const FULL_SCALE: f32 = 256.0;

/// The work of the index as a heat map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost;

impl Integrator for Cost {
    fn radiance(&self, world: &World<'_>, ray: &CameraRay, _: &mut Sampler, _: &mut RayCounters) -> Sample {
        let mut cost = TraversalCost::default();
        // The picture shows rays that miss, too.
        world.camera_hit_counted(&ray.ray, ray.time, &mut cost);
        let steps = (cost.nodes + cost.leaves + cost.tests) as f32;
        let radiance = turbo(steps.max(1.0).ln() / FULL_SCALE.ln());
        Sample { radiance, alpha: 1.0, first: super::first::first_hit(world, ray).map(|(_, first)| first) }
    }
}

/// The colour map Turbo at `x` in `[0, 1]`, in linear light.
///
/// # Source
/// Mikhailov, "Turbo, An Improved Rainbow Colormap for Visualization", Google AI Blog, 2019; the polynomial fit there.
fn turbo(x: f32) -> Rgb {
    let x = x.clamp(0.0, 1.0);
    let low = Vec4::new(1.0, x, x * x, x * x * x);
    let high = (low.z * low.z, low.z * low.w);
    let channel = |c: [f32; 6]| Vec4::new(c[0], c[1], c[2], c[3]).dot(low) + c[4] * high.0 + c[5] * high.1;
    let encoded = Vec3::new(
        channel([0.135_721_38, 4.615_392_6, -42.660_323, 132.131_08, -152.942_4, 59.286_38]),
        channel([0.091_402_61, 2.194_188_4, 4.842_966_6, -14.185_033, 4.277_298_6, 2.829_566]),
        channel([0.106_673_3, 12.641_946, -60.582_048, 110.362_77, -89.903_11, 27.348_25]),
    );
    encoded.clamp(Vec3::ZERO, Vec3::ONE).map(srgb_to_linear)
}

#[cfg(test)]
mod tests {
    use super::turbo;
    use heliostat_scene::color::linear_to_srgb;

    #[test]
    fn turbo_meets_the_published_table() {
        // Entries 128 and 255 of the 256 colours that the fit follows within 0.1.
        let table = [(128.0 / 255.0, [0.643_62, 0.989_99, 0.233_56]), (1.0, [0.479_6, 0.015_83, 0.010_55])];
        for (x, expected) in table {
            let got = turbo(x).map(linear_to_srgb).to_array();
            for (got, expected) in got.iter().zip(expected) {
                assert!((got - expected).abs() < 0.1, "{x}: {got} {expected}");
            }
        }
    }
}
