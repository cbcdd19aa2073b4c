//! All ways of light, from the camera to the lights.
//!
//! A path runs from surface to surface by directions that the surfaces draw. At each of them a light is asked as well, and what
//! both find is weighed by how well each could find it. Paths that carry little end by chance; those that go on
//! carry more for it. [`super::PathSimple`] says the same in fewer words.
//!
//! # Source
//! Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach, "Robust Monte Carlo Methods for Light Transport Simulation", Stanford,
//! 1997; Arvo, Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990 (Russian roulette).

use super::first::on_light;
use super::next_event::{from_lights, heuristic, left_of};
use super::{CameraRay, FirstHit, Integrator, Sample};
use crate::bsdf::Event;
use crate::counters::RayCounters;
use crate::interiors::Interiors;
use crate::light::{self, Lookout};
use crate::path_point::{Covering, Onward, PathPoint};
use crate::sampler::Sampler;
use crate::world::{Eye, Owner, PassingRay, SurfaceHit, World};
use heliostat_scene::settings::DepthLimits;
use heliostat_scene::{RenderSettings, Rgb};
use std::ops::ControlFlow;

/// After so many scatterings paths end by chance. Sooner, glass and metal in a room got more noise for their time.
pub(super) const CERTAIN: u32 = 8;
/// The largest probability with which such a path goes on.
pub(super) const MOST_CERTAIN: f32 = 0.95;
/// The branch of the random numbers that decide about holes.
pub(super) const HOLES: u32 = 0;

/// Paths of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    limits: DepthLimits,
    clamp: f32,
    transparent_background: bool,
}

/// A path on its way.
#[derive(Clone, Copy, Debug)]
struct Way {
    passing: PassingRay,
    /// What it runs through.
    around: Interiors,
    /// What radiance from here is multiplied by.
    weight: Rgb,
    /// Where light was scattered last, and with what density it was sent here; `None` where only camera, mirrors and glass
    /// are behind: what it sees, nobody has asked for.
    scattered: Option<(Lookout, f32)>,
    /// What happened last.
    after: Option<Event>,
    depth: Depth,
    /// Whether it comes straight from the camera, cut-outs aside: invisible objects are not seen.
    from_camera: bool,
    /// Whether it has only passed through things: then it sees no background that is to stay transparent.
    passed_only: bool,
    /// Whether it looks for lights alone, and ends with the next surface.
    is_last: bool,
}

/// What a path has found.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    radiance: Rgb,
    /// Weight with which it left the scene where the background is to stay transparent.
    through: f32,
    first: Option<FirstHit>,
}

/// Scatterings so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Depth {
    pub(super) total: u32,
    diffuse: u32,
    glossy: u32,
    transmission: u32,
    volume: u32,
}

impl Path {
    /// By the settings for length, clamp and background.
    pub fn new(settings: &RenderSettings) -> Self {
        Self {
            limits: settings.depth_limits,
            clamp: settings.clamp_indirect.unwrap_or(f32::INFINITY),
            transparent_background: settings.transparent_background,
        }
    }
}

impl Integrator for Path {
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        let mut found = Found::default();
        let mut way = Way {
            passing: PassingRay::free(ray.ray).with_cone(ray.cone),
            around: world.around(ray.ray.origin, ray.time),
            weight: Rgb::ONE,
            scattered: None,
            after: None,
            depth: Depth::default(),
            from_camera: true,
            passed_only: true,
            is_last: false,
        };
        let mut step = 0;
        while self.follow(world, &mut way, sampler.fork(step), ray.time, &mut found, counters).is_continue() {
            step += 1;
        }
        Sample { radiance: found.radiance, alpha: 1.0 - found.through, first: found.first }
    }
}

impl Path {
    /// Follows a path to the next surface, adds what it finds there, and sends it on.
    fn follow(
        &self,
        world: &World<'_>,
        way: &mut Way,
        mut draws: Sampler,
        time: f32,
        found: &mut Found,
        counters: &mut RayCounters,
    ) -> ControlFlow<()> {
        // Find what the ray meets first.
        let Some(surface) = &world.seen_inside(&way.passing, way.around.last(), time, way.eye()) else {
            self.leave(world, way, found);
            return ControlFlow::Break(());
        };
        let dir = way.passing.ray.dir;
        let (object, material) = match surface.owner {
            Owner::Object { index, material } => (index, material),
            Owner::Light(light) => {
                let light = &world.scene().lights[light as usize];
                way.absorb(None, surface);
                let shine = light::seen(light, surface.hit.at.ng, dir);
                found.first.get_or_insert_with(|| on_light(surface, dir));
                self.add_light(world, way, surface, shine, found);
                return ControlFlow::Break(());
            }
        };

        // Go on where the surface is cut away.
        let covering = Covering::new(world, surface, material);
        let opacity = covering.opacity();
        if opacity < 1.0 && draws.fork(HOLES).next_1d() >= opacity {
            way.pass(&covering, surface, counters);
            return ControlFlow::Continue(());
        }
        if covering.is_hidden(surface, &way.around) {
            way.pass(&covering, surface, counters);
            return ControlFlow::Continue(());
        }

        // Add what it gives off by itself.
        way.absorb(covering.left_absorption(surface, dir), surface);
        self.add_light(world, way, surface, covering.emission(), found);
        if way.after != Some(Event::Diffuse) {
            found.radiance += way.weight * covering.glow();
        }
        if way.is_last && found.first.is_some() {
            return ControlFlow::Break(());
        }
        let mut room = None;
        let point = PathPoint::new(world, &covering, surface, dir, time, &way.around, &mut room);
        found.first.get_or_insert_with(|| point.first_hit(object, material));

        // Ask a light, and send the path on.
        let choices = draws.next_2d();
        if point.scatters() {
            let weight = |light: &light::LightSample, pdf: f32| heuristic(light.pdf, pdf);
            let by_chance = (choices.x, draws.next_2d());
            let light =
                way.weight * from_lights(world, &point, way.around.ruling(), by_chance, weight, counters);
            found.radiance += self.clamped(light, way.depth.total);
        }
        let onward = point.sample(&way.passing, choices.y, draws.next_2d());
        let Some(onward) = onward else { return ControlFlow::Break(()) };
        onward.count(counters);
        way.go_on(&onward, &point, &self.limits);
        way.roulette(&mut draws)
    }

    /// Adds the light of a surface that shines, by the share that asking for it has left over.
    #[inline]
    fn add_light(&self, world: &World<'_>, way: &Way, surface: &SurfaceHit, shine: Rgb, found: &mut Found) {
        if shine == Rgb::ZERO {
            return;
        }
        let share = way
            .scattered
            .map_or(1.0, |(from, pdf)| heuristic(pdf, world.light_table().density(&from, surface)));
        found.radiance += self.clamped(share * way.weight * shine, way.depth.total.saturating_sub(1));
    }

    /// Adds what comes from infinitely far, or leaves it transparent.
    fn leave(&self, world: &World<'_>, way: &Way, found: &mut Found) {
        if self.transparent_background && way.passed_only {
            found.through = way.weight.element_sum() / 3.0;
            return;
        }
        let (lights, dir) = (world.light_table(), way.passing.ray.dir.normalize());
        let radiance = match &way.scattered {
            Some((from, pdf)) => lights.beyond(from, dir, |other| heuristic(*pdf, other)),
            None if way.passed_only => lights.seen(dir),
            None => lights.mirrored(dir),
        };
        found.radiance += self.clamped(way.weight * radiance, way.depth.total.saturating_sub(1));
    }

    /// Light that was scattered so often before, weakened to what is let through of indirect light.
    #[inline]
    fn clamped(&self, light: Rgb, scatterings: u32) -> Rgb {
        let most = light.max_element();
        if scatterings > 0 && most > self.clamp { self.clamp / most * light } else { light }
    }
}

impl Way {
    /// Who looks along it.
    fn eye(&self) -> Eye {
        match (self.from_camera, &self.scattered) {
            (true, _) => Eye::Camera,
            (false, Some(_)) => Eye::Scattered,
            (false, None) => Eye::Any,
        }
    }

    /// Weakens it by the glass that it came through: the one that it is in, or one that it leaves and was not known to be
    /// in, because the camera stands in it, or one thing in another.
    fn absorb(&mut self, left: Option<Rgb>, surface: &SurfaceHit) {
        let absorption = self.around.ruling().map(|inside| inside.absorption).or(left);
        if let Some(absorption) = absorption {
            self.weight *= left_of(absorption, surface.hit.t * self.passing.ray.dir.length());
        }
    }

    /// Goes on as if there were no surface.
    fn pass(&mut self, covering: &Covering<'_>, surface: &SurfaceHit, counters: &mut RayCounters) {
        counters.refraction += 1;
        let dir = self.passing.ray.dir;
        self.absorb(None, surface);
        self.passing = self.passing.behind(surface, dir);
        self.around.change(&covering.straight_change(surface, dir));
    }

    /// Sends it on.
    fn go_on(&mut self, onward: &Onward, point: &PathPoint<'_>, limits: &DepthLimits) {
        let sample = &onward.sample;
        self.passing = onward.passing;
        self.around.change(&onward.change);
        self.weight *= sample.weight;
        self.after = Some(sample.event);
        self.from_camera = false;
        self.passed_only &= sample.event == Event::Transmission;
        if !onward.is_straight {
            self.scattered = if sample.is_delta() { None } else { Some((point.lookout(), sample.pdf)) };
        }
        self.is_last |= self.depth.grow(sample.event, limits);
    }

    /// Ends it by chance if it carries little.
    #[inline]
    fn roulette(&mut self, draws: &mut Sampler) -> ControlFlow<()> {
        if self.depth.total > CERTAIN {
            let survives = self.weight.max_element().min(MOST_CERTAIN);
            if draws.next_1d() >= survives {
                return ControlFlow::Break(());
            }
            self.weight /= survives;
        }
        ControlFlow::Continue(())
    }
}

impl Depth {
    /// Counts a scattering; whether that was one too many.
    #[inline]
    pub(super) fn grow(&mut self, event: Event, limits: &DepthLimits) -> bool {
        let (count, limit) = match event {
            Event::Diffuse | Event::Subsurface => (&mut self.diffuse, limits.diffuse),
            Event::Glossy => (&mut self.glossy, limits.glossy),
            Event::Transmission => (&mut self.transmission, limits.transmission),
        };
        *count += 1;
        self.total += 1;
        *count > limit || self.total > limits.total
    }

    /// Counts a scattering by a medium; whether that was one too many.
    pub(super) fn grow_volume(&mut self, limits: &DepthLimits) -> bool {
        self.volume += 1;
        self.volume > limits.volume
    }

    /// Scatterings of all kinds.
    pub(super) fn all(&self) -> u32 {
        self.total + self.volume
    }
}
