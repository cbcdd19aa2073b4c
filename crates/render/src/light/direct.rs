//! The light of all sources at one point of a surface, with its shadows.

use super::{LightSample, PreparedLight, Target};
use crate::counters::RayCounters;
use crate::material_eval::PhongPoint;
use crate::sampler::Sampler;
use crate::world::{Candidates, World};
use glam::{Vec2, Vec3};
use heliostat_geometry::{Ray, SurfacePoint};
use heliostat_scene::Rgb;

/// A point that is lit, seen from one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LitPoint<'a> {
    /// Where shadow rays start; its normal is turned to the viewer.
    pub(crate) start: SurfacePoint,
    /// The smooth normal on the viewer's side, without relief: light from behind it is not seen.
    pub(crate) smooth: Vec3,
    /// Whether `start` was lifted off the facet onto the smooth surface that the facets stand for.
    pub(crate) lifted: bool,
    /// Shading normal on the viewer's side.
    pub(crate) ns: Vec3,
    /// Unit direction to the viewer.
    pub(crate) view: Vec3,
    /// The surface.
    pub(crate) phong: &'a PhongPoint,
    /// The object that the point is on.
    pub(crate) own: Option<u32>,
    /// Over the shutter.
    pub(crate) time: f32,
}

/// The light that all sources but the ambient ones send to the viewer by way of the point.
pub(crate) fn lighting(
    world: &World<'_>,
    point: &LitPoint<'_>,
    sampler: &mut Sampler,
    counters: &mut RayCounters,
) -> Rgb {
    if point.phong.diffuse == Rgb::ZERO && point.phong.specular == Rgb::ZERO {
        return Rgb::ZERO;
    }
    let mut sum = Rgb::ZERO;
    for light in world.lights() {
        if light.samples == 1 {
            let u = if light.is_extended { sampler.next_2d() } else { Vec2::ZERO };
            sum += from_sample(world, light, point, u, Candidates::All, counters);
        } else {
            // Every point takes all samples: none decides by itself whether it lies in the penumbra.
            let hull = light.hull(point.start.p, world.bounds());
            let blockers =
                hull.map_or(Candidates::All, |hull| world.blockers(&point.start, point.own, hull));
            let mut parts = Rgb::ZERO;
            for u in sampler.array_2d(light.samples) {
                parts += from_sample(world, light, point, u, blockers, counters);
            }
            sum += parts / light.samples as f32;
        }
    }
    sum
}

/// What one sample of a light adds.
#[inline]
fn from_sample(
    world: &World<'_>,
    light: &PreparedLight<'_>,
    point: &LitPoint<'_>,
    u: Vec2,
    blockers: Candidates,
    counters: &mut RayCounters,
) -> Rgb {
    let Some(sample) = light.sample(point.start.p, u, point.time) else { return Rgb::ZERO };

    // Light from behind the surface is not seen, whatever the shading normal says.
    let above = point.smooth.dot(sample.to_light) > 0.0
        && (point.lifted || point.start.ng.dot(sample.to_light) > 0.0);
    if !above {
        return Rgb::ZERO;
    }

    // Trace the shadow ray only where there is something to lose.
    let answer = sample.arriving * point.phong.answer(point.ns, sample.to_light, point.view);
    if answer == Rgb::ZERO {
        return Rgb::ZERO;
    }
    if blockers.are_none() {
        return answer;
    }
    counters.shadow += 1;
    answer * world.transmittance_past(&shadow_ray(&point.start, &sample), point.time, blockers)
}

/// The ray from a point to where its light comes from.
fn shadow_ray(start: &SurfacePoint, sample: &LightSample) -> Ray {
    match sample.target {
        Target::Sky => start.spawn(sample.to_light),
        Target::Point(p) => start.spawn_to(p),
        Target::Surface(at) => start.spawn_to_surface(&at),
    }
}
