//! All ways of light, those through media and below surfaces with them.
//!
//! The same as [`super::Path`] at surfaces. Between them a ray flies through what fills the space, and may be scattered there: a
//! light is asked from that point as from one of a surface, and the path goes on by the phase function. Light that a surface
//! lets in walks below it until it comes out ([`under`]). Lamps in fog are asked from a second point of each way ([`beside`]).
//!
//! # Coverage
//! A medium covers as much of a transparent background as it takes from light on its way through. Layers of data look
//! through media: they show the first surface.
//!
//! # Source
//! As [`super::path`]; Miller, Georgiev, Jarosz, "A Null-Scattering Path Integral Formulation of Light Transport", SIGGRAPH 2019;
//! Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 14.2.

mod beside;
mod found;
mod shadow;
mod under;
mod way;

use super::first::{first_from, on_light};
use super::path::HOLES;
use super::{CameraRay, Integrator, Sample};
use crate::bsdf::Event;
use crate::counters::RayCounters;
use crate::light::{self, Lookout};
use crate::path_point::{Covering, PathPoint};
use crate::sampler::Sampler;
use crate::track::Track;
use crate::world::{Owner, PassingRay, SurfaceHit, World};
use beside::Stretch;
use found::Found;
use heliostat_geometry::Ray;
use heliostat_scene::RenderSettings;
use heliostat_scene::settings::DepthLimits;
use shadow::{Ask, ray_to};
use std::ops::ControlFlow;
use under::Walk;
use way::Way;

/// Branches of the random numbers, beside that of holes.
const FLIGHT: u32 = 1;
const SHADOW: u32 = 2;
const WALK: u32 = 3;
const OUTSIDE: u32 = 4;
const LAMP: u32 = 5;

/// Paths of light through media.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolPath {
    limits: DepthLimits,
    clamp: f32,
    transparent_background: bool,
}

/// Where and when a step is made, and what is counted on it.
struct Step<'a, 'w, 's> {
    world: &'w World<'s>,
    time: f32,
    draws: Sampler,
    counters: &'a mut RayCounters,
}

impl VolPath {
    /// By the settings for length, clamp and background.
    pub fn new(settings: &RenderSettings) -> Self {
        Self {
            limits: settings.depth_limits,
            clamp: settings.clamp_indirect.unwrap_or(f32::INFINITY),
            transparent_background: settings.transparent_background,
        }
    }
}

impl Integrator for VolPath {
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        let mut found = Found::default();
        let mut way = Way::new(Track::from_camera(world, ray));
        for number in 0.. {
            let mut step = Step { world, time: ray.time, draws: sampler.fork(number), counters };
            if self.follow(&mut step, &mut way, &mut found).is_break() {
                break;
            }
        }
        Sample { radiance: found.radiance, alpha: 1.0 - found.through, first: found.first }
    }
}

impl VolPath {
    /// Follows a path to where it is scattered next, adds what it finds there, and sends it on.
    fn follow(&self, step: &mut Step<'_, '_, '_>, way: &mut Way, found: &mut Found) -> ControlFlow<()> {
        let (world, time) = (step.world, step.time);
        let seen = way.track.seen(world, time, way.eye());
        if seen.is_none() {
            // Where nothing is met, bodies that end somewhere were left unnoticed.
            way.track.around.retain(|inside| !world.bounds_of(inside.thing).is_finite());
        }
        if let Some(matter) = world.matter(&way.track.around) {
            let end = seen.map_or(f32::INFINITY, |surface| surface.hit.t);
            if let Some(through) = way.through(&matter, end) {
                let stretch = Stretch::new(world, matter.medium, through);
                if let Some(t) = self.fly(step, way, &stretch, found) {
                    return self.scatter(step, way, &stretch, t, found);
                }
            }
        }
        let Some(surface) = &seen else {
            self.leave(world, way, found);
            return ControlFlow::Break(());
        };
        let dir = way.track.dir();
        let (object, material) = match surface.owner {
            Owner::Object { index, material } => (index, material),
            Owner::Light(light) => {
                let light = &world.scene().lights[light as usize];
                way.absorb(None, surface);
                found.first.get_or_insert_with(|| on_light(surface, dir));
                self.add_light(world, way, surface, light::seen(light, surface.hit.at.ng, dir), found);
                return ControlFlow::Break(());
            }
        };

        // Go on where there is no surface.
        let covering = Covering::new(world, surface, material);
        let opacity = covering.opacity();
        let is_hole = opacity < 1.0 && step.draws.fork(HOLES).next_1d() >= opacity;
        if is_hole || covering.is_hidden(surface, &way.track.around) {
            step.counters.refraction += 1;
            way.pass(&covering, surface);
            return ControlFlow::Continue(());
        }

        // Add what it gives off by itself.
        way.absorb(covering.left_absorption(surface, dir), surface);
        self.add_light(world, way, surface, covering.emission(surface, dir), found);
        if way.after != Some(Event::Diffuse) {
            found.radiance += way.settled() * covering.glow();
        }
        if way.is_last && found.first.is_some() {
            return ControlFlow::Break(());
        }
        let mut room = None;
        let around = way.track.around;
        let point = PathPoint::new(world, &covering, surface, dir, time, &around, &mut room);
        found.first.get_or_insert_with(|| point.first_hit(object, material));
        self.scatter_at(step, way, &covering, &point, surface, found)
    }

    /// Asks a light for a point of a surface, and sends the path on.
    fn scatter_at(
        &self,
        step: &mut Step<'_, '_, '_>,
        way: &mut Way,
        covering: &Covering<'_>,
        point: &PathPoint<'_>,
        surface: &SurfaceHit,
        found: &mut Found,
    ) -> ControlFlow<()> {
        let choice = step.draws.next_2d();
        self.add_asked(step, way, point, choice.x, found);
        let u = step.draws.next_2d();
        let onward = point.sample(way.settled(), choice.y, u);
        let Some(onward) = onward else { return ControlFlow::Break(()) };
        if onward.sample.event == Event::Subsurface {
            let carried = way.settled() * onward.sample.weight;
            let (Some(thing), Some(medium)) = (surface.thing(), covering.below(surface)) else {
                return ControlFlow::Break(());
            };
            let walk = Walk { world: step.world, thing, medium: &medium, time: step.time };
            let mut inside = way.track;
            inside.take(&onward, point);
            let come_out = walk.follow(inside.passing, carried, &mut step.draws.fork(WALK));
            let Some((exit, carried)) = come_out else { return ControlFlow::Break(()) };
            way.settle(carried);
            return self.come_out(step, way, &exit, found);
        }
        onward.count(step.counters);
        way.go_on(&onward, point, &self.limits);
        way.roulette(&mut step.draws)
    }

    /// Lets a path out that has walked below a surface.
    fn come_out(
        &self,
        step: &mut Step<'_, '_, '_>,
        way: &mut Way,
        exit: &SurfaceHit,
        found: &mut Found,
    ) -> ControlFlow<()> {
        let Some(material) = exit.material() else { return ControlFlow::Break(()) };
        let covering = Covering::new(step.world, exit, material);
        let mut room = None;
        let point = PathPoint::outside(step.world, &covering, exit, step.time, &mut room);
        step.draws = step.draws.fork(OUTSIDE);
        let choice = step.draws.next_2d();
        self.add_asked(step, way, &point, choice.x, found);
        let u = step.draws.next_2d();
        let onward = point.sample(way.settled(), choice.y, u);
        let Some(onward) = onward else { return ControlFlow::Break(()) };
        onward.count(step.counters);
        way.track.passing = PassingRay::free(way.track.passing.ray);
        way.go_on(&onward, &point, &self.limits);
        way.roulette(&mut step.draws)
    }

    /// Adds the light of one light that a point of a surface sends on.
    fn add_asked(
        &self,
        step: &mut Step<'_, '_, '_>,
        way: &Way,
        point: &PathPoint<'_>,
        choice: f32,
        found: &mut Found,
    ) {
        if !point.scatters() {
            return;
        }
        let Some(light) = step.world.light_table().draw(&point.lookout(), choice, step.draws.next_2d())
        else {
            return;
        };
        let (value, pdf) = point.eval(light.to_light);
        let ray = point.shadow_ray(light.to_light, &light.target);
        let ask = Ask { light: &light, ray, carried: way.settled() * value, pdf };
        found.radiance += self.clamped(ask.answer(step, &way.track.around), way.depth.all());
    }

    /// Flies through a medium: the distance at which the path is scattered, `None` where it gets through.
    fn fly(
        &self,
        step: &mut Step<'_, '_, '_>,
        way: &mut Way,
        stretch: &Stretch<'_, '_>,
        found: &mut Found,
    ) -> Option<f32> {
        if stretch.asks_lamps && !way.is_last {
            let glow = stretch.glow(step, way.settled(), &way.track.around);
            found.radiance += self.clamped(glow, way.depth.all());
        }
        way.fly(stretch.medium, &stretch.way, &mut step.draws.fork(FLIGHT))
    }

    /// Asks a light for a point of a medium, and sends the path on from there.
    fn scatter(
        &self,
        step: &mut Step<'_, '_, '_>,
        way: &mut Way,
        stretch: &Stretch<'_, '_>,
        t: f32,
        found: &mut Found,
    ) -> ControlFlow<()> {
        if way.passed_only && found.first.is_none() {
            found.first = first_from(step.world, way.track.passing, step.time).map(|(_, first)| first);
        }
        way.settle(way.settled());
        if way.is_last || !way.weight.is_finite() {
            return ControlFlow::Break(());
        }
        step.counters.scatter += 1;
        let (dir, p) = (stretch.way.dir, stretch.way.at(t));
        let from = Lookout::in_medium(p, step.time);
        let (choice, phase) = (step.draws.next_2d(), &stretch.medium.phase);
        let drawn = step.world.light_table().draw_one(&from, choice.x, step.draws.next_2d());
        if let Some((lamp, light)) = drawn {
            let pdf = phase.density(dir, light.to_light);
            let left = if stretch.asks_lamps { stretch.left(step, lamp, t) } else { 1.0 };
            let ask = Ask { light: &light, ray: ray_to(p, &light), carried: left * pdf * way.weight, pdf };
            found.radiance += self.clamped(ask.answer(step, &way.track.around), way.depth.all());
        }
        let (to, pdf) = phase.sample(dir, step.draws.next_2d());
        way.scattered_by_medium(from, PassingRay::free(Ray::new(p, to)), pdf, &self.limits);
        way.roulette(&mut step.draws)
    }
}
