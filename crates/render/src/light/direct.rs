//! The light of all sources at one point of a surface, with its shadows.

use super::area::FlatLamp;
use super::bundle::Bundle;
use super::{PreparedLight, Target};
use crate::counters::RayCounters;
use crate::horizon::Horizon;
use crate::material_eval::PhongPoint;
use crate::phong::{is_dark, reflect};
use crate::sampler::{Points, Sampler};
use crate::world::{Candidates, Hull, ShadowRays, World};
use glam::{Vec2, Vec3};
use heliostat_geometry::Departure;
use heliostat_scene::Rgb;

/// A point that is lit, seen from one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LitPoint<'a> {
    /// The point and what it can see.
    pub(crate) horizon: Horizon,
    /// Where shadow rays start.
    pub(crate) departure: Departure,
    /// Shading normal on the viewer's side.
    pub(crate) ns: Vec3,
    /// Unit direction to the viewer.
    pub(crate) view: Vec3,
    /// The surface.
    pub(crate) phong: &'a PhongPoint,
    /// What may throw a shadow on it.
    pub(crate) casters: Candidates,
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
        sum += if light.samples == 1 {
            let u = if light.is_extended { sampler.next_2d() } else { Vec2::ZERO };
            from_sample(world, light, point, u, point.casters, counters)
        } else {
            let samples = sampler.array_2d(light.samples);
            from_samples(world, light, point, samples, counters)
        };
    }
    sum
}

/// The mean over samples of a light: every point takes all of them, none decides by itself whether it lies in the
/// penumbra.
fn from_samples(
    world: &World<'_>,
    light: &PreparedLight<'_>,
    point: &LitPoint<'_>,
    samples: Points,
    counters: &mut RayCounters,
) -> Rgb {
    // Ask once for all samples what they have in common.
    let hull = light.hull(point.horizon.start.p, world.bounds());
    let shines = point.phong.specular != Rgb::ZERO && hull.as_ref().is_none_or(|hull| point.may_mirror(hull));
    if point.phong.diffuse == Rgb::ZERO && !shines {
        return Rgb::ZERO;
    }
    let blockers = match &hull {
        Some(hull) if hull.is_behind(point.horizon.start.p, point.horizon.smooth) => return Rgb::ZERO,
        Some(hull) => world.blockers(&point.horizon.start, point.casters, hull),
        None => point.casters,
    };
    let sum: Rgb = match light.flat_lamp() {
        Some(lamp) => from_flat_lamp(world, &lamp, point, samples, shines, blockers, counters),
        None => samples.map(|u| from_sample(world, light, point, u, blockers, counters)).sum(),
    };
    sum / light.samples as f32
}

/// The sum over samples of a flat lamp, by bundles of them.
fn from_flat_lamp(
    world: &World<'_>,
    lamp: &FlatLamp<'_>,
    point: &LitPoint<'_>,
    mut samples: Points,
    shines: bool,
    blockers: Candidates,
    counters: &mut RayCounters,
) -> Rgb {
    let mut sum = Rgb::ZERO;
    while samples.len() > 0 {
        let bundle = Bundle::draw(lamp, point, &mut samples, shines);
        if blockers.are_none() || bundle.lit == 0 {
            sum += bundle.answer(point);
            continue;
        }
        // Trace shadow rays only where there is something to lose.
        counters.shadow += u64::from(bundle.lit.count_ones());
        let (start, targets, wanted) = (point.departure, &bundle.targets, bundle.lit);
        let rays = ShadowRays { start, targets, reach: lamp.flat.reach(start.origin()), wanted };
        sum += bundle.answer_to(&world.transmittances(&rays, point.time, blockers), point);
    }
    sum * lamp.radiance
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
    let Some(sample) = light.sample(point.horizon.start.p, 0, u, point.time) else { return Rgb::ZERO };

    let share = point.horizon.facing(sample.to_light);
    if share <= 0.0 {
        return Rgb::ZERO;
    }

    // Trace the shadow ray only where there is something to lose.
    let answer = share * sample.arriving * point.phong.answer(point.ns, sample.to_light, point.view);
    if answer == Rgb::ZERO {
        return Rgb::ZERO;
    }
    if blockers.are_none() {
        return answer;
    }
    counters.shadow += 1;
    let ray = match sample.target {
        Target::Sky => point.departure.spawn(sample.to_light),
        Target::Point(p) => point.departure.spawn_to(p),
        Target::Surface(at) => point.horizon.start.spawn_to_surface(&at),
    };
    answer * world.transmittance_past(&ray, point.time, blockers)
}

impl LitPoint<'_> {
    /// Whether any highlight of a light in that hull is seen.
    fn may_mirror(&self, light: &Hull) -> bool {
        let mirror_dir = reflect(-self.view, self.ns);
        !is_dark(light.nearest_cosine(self.horizon.start.p, mirror_dir), self.phong.shininess)
    }
}
