//! Light that comes straight from a light to a point: asked of the lights, and weighed against what scattered rays find.

use crate::counters::RayCounters;
use crate::light::LightSample;
use crate::path_point::PathPoint;
use crate::world::{Inside, World};
use glam::Vec2;
use heliostat_scene::Rgb;

/// The weight of a draw with density `own` where another way of drawing would have had the density `other`.
///
/// # Source
/// Veach, Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995: the power heuristic.
#[inline]
pub(super) fn heuristic(own: f32, other: f32) -> f32 {
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}

/// The share of light that is left after a way through something with an absorption per metre.
///
/// # Source
/// The law of Bouguer, Lambert and Beer.
#[inline]
pub(crate) fn left_of(absorption: Rgb, way: f32) -> Rgb {
    if absorption == Rgb::ZERO { Rgb::ONE } else { (-way * absorption).exp() }
}

/// Light from one light, chosen by `choice`, that the point sends to the viewer. `weight` says what counts of a sample for the
/// density with which scattered rays find it.
#[inline]
pub(super) fn from_lights(
    world: &World<'_>,
    point: &PathPoint<'_>,
    inside: Option<&Inside>,
    (choice, u): (f32, Vec2),
    weight: impl Fn(&LightSample, f32) -> f32,
    counters: &mut RayCounters,
) -> Rgb {
    let from = point.lookout();
    let Some(light) = world.light_table().draw(&from, choice, u) else { return Rgb::ZERO };
    let (value, pdf) = point.eval(light.to_light);
    let answer = weight(&light, pdf) * value * light.arriving;
    if answer == Rgb::ZERO {
        return Rgb::ZERO;
    }
    counters.shadow += 1;
    let ray = point.shadow_ray(light.to_light, &light.target);
    let shown = answer * world.transmittance(&ray, from.time);
    match inside {
        // A light inside the same glass; where light passes its surface, shadow rays know of it.
        Some(inside) if inside.bends && ray.range.max.is_finite() => {
            shown * left_of(inside.absorption, ray.dir.length())
        }
        _ => shown,
    }
}
