//! All ways of light in one screen of text: what [`super::Path`] finds faster must be what this finds.
//!
//! A ray sees what the surface gives off by itself, and what it sends on of the light from one direction, which the surface
//! draws. Radiance from there, found the same way, times value over density is what that adds up to in the mean:
//!
//! ```text
//! radiance = emission + radiance from a drawn direction * value / density
//! ```
//!
//! Only lights that no ray meets (points, single directions, invisible surfaces) have to be asked.
//!
//! # Source
//! Kajiya, "The Rendering Equation", SIGGRAPH 1986.

use super::first::on_light;
use super::next_event::from_lights;
use super::{CameraRay, FirstHit, Integrator, Sample};
use crate::bsdf::Event;
use crate::counters::RayCounters;
use crate::light::{self, Lookout};
use crate::path_point::{Covering, PathPoint};
use crate::sampler::Sampler;
use crate::track::Track;
use crate::world::{Eye, Owner, Sight, SurfaceHit, World};
use heliostat_scene::{RenderSettings, Rgb};

/// From so many scatterings on paths end by chance.
const CERTAIN: u32 = 4;
/// Most scatterings of a path.
const MOST: u32 = 1000;

/// Scattered rays alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSimple {
    transparent_background: bool,
}

/// A ray on its way from the camera.
#[derive(Clone, Copy, Debug)]
struct Leg {
    track: Track,
    /// Scatterings on the way here.
    depth: u32,
    /// From where lights were asked; `None` where nothing but mirrors and glass lies between here and the camera.
    asked: Option<Lookout>,
    sight: Sight,
    /// Whether it has only passed through things.
    passed_only: bool,
    after: Option<Event>,
    sampler: Sampler,
}

/// What every leg of a path may look at and add to.
struct Walk<'a, 'w> {
    world: &'a World<'w>,
    time: f32,
    counters: &'a mut RayCounters,
    transparent_background: bool,
    first: Option<FirstHit>,
    /// Whether the path left the scene where the background is to stay transparent.
    is_through: bool,
}

impl PathSimple {
    /// By the settings for the background.
    pub fn new(settings: &RenderSettings) -> Self {
        Self { transparent_background: settings.transparent_background }
    }
}

impl Integrator for PathSimple {
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        let transparent_background = self.transparent_background;
        let (first, is_through, time) = (None, false, ray.time);
        let mut walk = Walk { world, time, counters, transparent_background, first, is_through };
        let radiance = walk.radiance(Leg {
            track: Track::from_camera(world, ray),
            depth: 0,
            asked: None,
            sight: Sight::Straight,
            passed_only: true,
            after: None,
            sampler: sampler.fork(0),
        });
        Sample { radiance, alpha: if walk.is_through { 0.0 } else { 1.0 }, first: walk.first }
    }
}

impl Walk<'_, '_> {
    /// The radiance that a leg sees.
    fn radiance(&mut self, mut leg: Leg) -> Rgb {
        let world = self.world;
        let Some(surface) = &leg.track.seen(world, self.time, leg.eye()) else {
            return self.beyond(&leg);
        };
        let dir = leg.track.dir();
        let (object, material) = match surface.owner {
            Owner::Object { index, material } => (index, material),
            Owner::Light(light) => {
                self.first.get_or_insert_with(|| on_light(surface, dir));
                let shine = light::seen(&world.scene().lights[light as usize], surface.hit.at.ng, dir);
                let left = leg.track.left(None, surface);
                return if leg.has_asked_for(world, surface) { Rgb::ZERO } else { left * shine };
            }
        };

        // Holes let the ray through by chance.
        let covering = Covering::new(world, surface, material);
        let is_hole = leg.sampler.next_1d() >= covering.opacity();
        if is_hole || covering.is_hidden(surface, &leg.track.around) {
            self.counters.refraction += 1;
            let left = leg.track.left(None, surface);
            leg.track.pass(&covering, surface);
            return left * self.radiance(Leg { sampler: leg.sampler.fork(0), ..leg });
        }
        let mut room = None;
        let point = PathPoint::new(world, &covering, surface, dir, self.time, &leg.track.around, &mut room);
        self.first.get_or_insert_with(|| point.first_hit(object, material));
        let left = leg.track.left(covering.left_absorption(surface, dir), surface);

        let mut sum = Rgb::ZERO;
        if !leg.has_asked_for(world, surface) {
            sum += covering.emission(surface, dir);
        }
        if leg.after != Some(Event::Diffuse) {
            sum += covering.glow();
        }
        let by_chance = (leg.sampler.next_1d(), leg.sampler.next_2d());
        let unmet = |light: &light::LightSample, _: f32| f32::from(u8::from(light.pdf == f32::INFINITY));
        sum += from_lights(world, &point, leg.track.around.ruling(), by_chance, unmet, self.counters);
        sum += self.sent_on(&point, leg);
        left * sum
    }

    /// What a point sends on of the light from a direction that it draws.
    fn sent_on(&mut self, point: &PathPoint<'_>, mut leg: Leg) -> Rgb {
        let (layer, u) = (leg.sampler.next_1d(), leg.sampler.next_2d());
        let Some(onward) = point.sample(Rgb::ONE, layer, u) else { return Rgb::ZERO };
        let weight = onward.sample.weight;
        let survives = if leg.depth < CERTAIN { 1.0 } else { weight.max_element().min(0.9) };
        if leg.depth == MOST || leg.sampler.next_1d() >= survives {
            return Rgb::ZERO;
        }
        onward.count(self.counters);
        let mut track = leg.track;
        track.take(&onward, point);
        let asked = if onward.sample.is_delta() { None } else { Some(point.lookout()) };
        let radiance = self.radiance(Leg {
            track,
            depth: leg.depth + 1,
            asked: if onward.is_straight { leg.asked } else { asked },
            sight: leg.sight.after(onward.sample.is_delta()),
            passed_only: leg.passed_only && onward.sample.event == Event::Transmission,
            after: Some(onward.sample.event),
            sampler: leg.sampler.fork(1),
        });
        weight / survives * radiance
    }

    /// What comes from infinitely far.
    fn beyond(&mut self, leg: &Leg) -> Rgb {
        if leg.passed_only && self.transparent_background {
            self.is_through = true;
            return Rgb::ZERO;
        }
        let (lights, dir) = (self.world.light_table(), leg.track.dir().normalize());
        match &leg.asked {
            Some(from) => lights.beyond(from, dir, |_| 1.0),
            None if leg.passed_only => lights.seen(dir),
            None => lights.mirrored(dir),
        }
    }
}

impl Leg {
    /// Who looks along it.
    fn eye(&self) -> Eye {
        Eye::of_path(self.sight, self.asked.is_some())
    }

    /// Whether the light of that surface was asked for where the ray comes from.
    fn has_asked_for(&self, world: &World<'_>, surface: &SurfaceHit) -> bool {
        self.asked.is_some_and(|from| world.light_table().density(&from, surface) == f32::INFINITY)
    }
}
