//! All ways of light, from the camera to the lights.
//!
//! A path runs from surface to surface by directions that the surfaces draw. At each of them a light is asked as well, and what
//! both find is weighed by how well each could find it. Paths that carry little end by chance; those that go on
//! carry more for it. [`super::PathSimple`] says the same in fewer words.
//!
//! # Source
//! Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach, "Robust Monte Carlo Methods for Light Transport Simulation", Stanford,
//! 1997.

use super::first::on_light;
use super::next_event::{from_lights, heuristic};
use super::roulette::survive;
use super::{CameraRay, FirstHit, Integrator, Sample};
use crate::bsdf::Event;
use crate::counters::RayCounters;
use crate::guiding::{Course, Guide, GuidingSettings, Trail, learn};
use crate::light::{self, Lookout};
use crate::path_point::{Covering, Onward, PathPoint};
use crate::photons::{Bounces, PhotonMap, PhotonSettings, Photons};
use crate::sampler::Sampler;
use crate::track::Track;
use crate::world::{Eye, Owner, Sight, SurfaceHit, World};
use heliostat_scene::settings::DepthLimits;
use heliostat_scene::{RenderSettings, Rgb};
use std::ops::{ControlFlow, Range};

/// The branch of the random numbers that decide about holes.
pub(crate) const HOLES: u32 = 0;

/// Paths of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    limits: DepthLimits,
    clamp: f32,
    transparent_background: bool,
    photons: Option<PhotonSettings>,
    guiding: Option<GuidingSettings>,
}

/// Paths of some samples, with photons and guided where that is asked for.
struct Paths<'a> {
    path: &'a Path,
    photons: Option<&'a Photons>,
    guide: Option<&'a Guide>,
}

/// Paths that are guided, or hold the photons of their samples.
struct Ready<'a> {
    path: &'a Path,
    photons: Option<Photons>,
    guide: Option<&'a Guide>,
}

/// A path on its way.
#[derive(Clone, Copy, Debug)]
struct Way {
    track: Track,
    /// What radiance from here is multiplied by.
    weight: Rgb,
    /// How much likelier guiding has made it than surfaces alone would have.
    likelier: f32,
    /// Where light was scattered last, and with what density it was sent here; `None` where only camera, mirrors and glass
    /// are behind: what it sees, nobody has asked for.
    scattered: Option<(Lookout, f32)>,
    /// What happened last.
    after: Option<Event>,
    /// How it comes from the last matte layer, for photons.
    since_matte: Since,
    depth: Depth,
    /// How it comes from the camera.
    sight: Sight,
    /// Whether it has only passed through things: then it sees no background that is to stay transparent.
    passed_only: bool,
    /// Whether it looks for lights alone, and ends with the next surface.
    is_last: bool,
}

/// What has happened since a path was scattered by a matte layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Since {
    /// It was scattered otherwise, or never.
    Never,
    /// Nothing.
    Nothing,
    /// It was reflected by mirrors or refracted by clear glass: light that it meets is a caustic.
    Smooth,
}

/// What a path has found.
#[derive(Clone, Debug, Default)]
struct Found {
    radiance: Rgb,
    /// Weight with which it left the scene where the background is to stay transparent.
    through: f32,
    first: Option<FirstHit>,
    /// What it leaves behind, where it is followed for practice.
    trail: Option<Trail>,
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
            photons: PhotonSettings::of(settings),
            guiding: GuidingSettings::of(settings),
        }
    }

    /// The paths of some samples, guided if they are.
    fn ready<'a>(
        &'a self,
        guide: Option<&'a Guide>,
        world: &World<'_>,
        samples: Range<u32>,
    ) -> Option<Box<dyn Integrator + 'a>> {
        let photons = Some(self.photons?.photons(world, samples)?);
        Some(Box::new(Ready { path: self, photons, guide }))
    }
}

impl Integrator for Path {
    /// Without photons, and not guided: a caustic is found by chance, or not.
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        Paths { path: self, photons: None, guide: None }.radiance(world, ray, sampler, counters)
    }

    fn learn(&self, world: &World<'_>, course: &Course<'_>) -> Option<Guide> {
        // No photons are sent, but what would come as photons is left out.
        let photons = self.photons.and_then(|photons| photons.photons(world, 0..0));
        let follow = |ray: &CameraRay, sampler: &mut Sampler, guide: &Guide, counters: &mut RayCounters| {
            let mut found = Found { trail: Some(Trail::default()), ..Found::default() };
            let paths = Paths { path: self, photons: photons.as_ref(), guide: Some(guide) };
            paths.find(world, ray, sampler, &mut found, counters);
            (found.radiance, found.trail.unwrap_or_default())
        };
        learn(self.guiding?, course, &follow)
    }

    fn led<'a>(&'a self, guide: &'a Guide) -> Option<Box<dyn Integrator + 'a>> {
        Some(Box::new(Ready { path: self, photons: None, guide: Some(guide) }))
    }

    fn samples_at_once(&self) -> Option<u32> {
        self.photons.map(|photons| photons.at_once())
    }

    fn for_samples<'a>(&'a self, world: &World<'_>, samples: Range<u32>) -> Option<Box<dyn Integrator + 'a>> {
        self.ready(None, world, samples)
    }
}

impl Integrator for Ready<'_> {
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        let Self { path, photons, guide } = self;
        Paths { path, photons: photons.as_ref(), guide: *guide }.radiance(world, ray, sampler, counters)
    }

    fn samples_at_once(&self) -> Option<u32> {
        self.path.samples_at_once()
    }

    fn for_samples<'a>(&'a self, world: &World<'_>, samples: Range<u32>) -> Option<Box<dyn Integrator + 'a>> {
        self.path.ready(self.guide, world, samples)
    }
}

impl Paths<'_> {
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        let mut found = Found::default();
        self.find(world, ray, sampler, &mut found, counters);
        Sample { radiance: found.radiance, alpha: 1.0 - found.through, first: found.first }
    }

    /// Follows a path to its end.
    fn find(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &Sampler,
        found: &mut Found,
        counters: &mut RayCounters,
    ) {
        let mut way = Way {
            track: Track::from_camera(world, ray),
            weight: Rgb::ONE,
            likelier: 1.0,
            scattered: None,
            after: None,
            since_matte: Since::Never,
            depth: Depth::default(),
            sight: Sight::Straight,
            passed_only: true,
            is_last: false,
        };
        let mut step = 0;
        while self.follow(world, &mut way, sampler.fork(step), ray.time, found, counters).is_continue() {
            step += 1;
        }
    }

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
        let Some(surface) = &way.track.seen(world, time, way.eye()) else {
            self.leave(world, way, found);
            return ControlFlow::Break(());
        };
        let dir = way.track.dir();
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
        let is_hole = opacity < 1.0 && draws.fork(HOLES).next_1d() >= opacity;
        if is_hole || covering.is_hidden(surface, &way.track.around) {
            way.pass(&covering, surface, counters);
            return ControlFlow::Continue(());
        }

        // Add what it gives off by itself.
        way.absorb(covering.left_absorption(surface, dir), surface);
        self.add_light(world, way, surface, covering.emission(surface, dir), found);
        if way.after != Some(Event::Diffuse) {
            found.radiance += way.weight * covering.glow();
        }
        if way.is_last && found.first.is_some() {
            return ControlFlow::Break(());
        }
        let mut room = None;
        let point = PathPoint::new(world, &covering, surface, dir, time, &way.track.around, &mut room)
            .led(self.guide);
        found.first.get_or_insert_with(|| point.first_hit(object, material));

        // Ask a light, and send the path on.
        let choices = draws.next_2d();
        if point.scatters() {
            let weight = |light: &light::LightSample, pdf: f32| heuristic(light.pdf, pdf);
            let by_chance = (choices.x, draws.next_2d());
            let light = way.weight
                * from_lights(world, &point, way.track.around.ruling(), by_chance, weight, counters);
            found.radiance += self.path.clamped(light, way.depth.total);
        }
        if let Some(map) = self.photons.and_then(|photons| photons.of(draws.sample())) {
            let light = way.weight * self.caustic(map, &point, surface, &way.depth);
            found.radiance += self.path.clamped(light, way.depth.total);
        }
        let onward = point.sample(way.weight, choices.y, draws.next_2d());
        let Some(onward) = onward else { return ControlFlow::Break(()) };
        onward.count(counters);
        way.go_on(&onward, &point, &self.path.limits);
        if let Some(trail) = &mut found.trail {
            trail.add(&point, &onward, way.weight, found.radiance);
        }
        way.roulette(&mut draws)
    }

    /// Adds the light of a surface that shines, by the share that asking for it has left over.
    #[inline]
    fn add_light(&self, world: &World<'_>, way: &Way, surface: &SurfaceHit, shine: Rgb, found: &mut Found) {
        if shine == Rgb::ZERO {
            return;
        }
        let is_caustic = way.since_matte == Since::Smooth;
        if is_caustic && self.photons.is_some_and(|photons| photons.are_of(world, surface)) {
            return;
        }
        let share = way
            .scattered
            .map_or(1.0, |(from, pdf)| heuristic(pdf, world.light_table().density(&from, surface)));
        found.radiance += self.path.clamped(share * way.weight * shine, way.depth.total.saturating_sub(1));
    }

    /// Adds what comes from infinitely far, or leaves it transparent.
    fn leave(&self, world: &World<'_>, way: &Way, found: &mut Found) {
        if self.path.transparent_background && way.passed_only {
            found.through = way.weight.element_sum() / 3.0;
            return;
        }
        let (lights, dir) = (world.light_table(), way.track.dir().normalize());
        let radiance = match &way.scattered {
            Some((from, pdf)) => lights.beyond(from, dir, |other| heuristic(*pdf, other)),
            None if way.passed_only => lights.seen(dir),
            None if way.since_matte == Since::Smooth && self.photons.is_some_and(Photons::are_from_afar) => {
                lights.mirrored_sky(dir)
            }
            None => lights.mirrored(dir),
        };
        found.radiance += self.path.clamped(way.weight * radiance, way.depth.total.saturating_sub(1));
    }

    /// What a matte layer sends on of the photons near a point, over what has arrived at it: radiance where paths carry 1.
    fn caustic(&self, map: &PhotonMap, point: &PathPoint<'_>, surface: &SurfaceHit, depth: &Depth) -> Rgb {
        if !point.is_matte() {
            return Rgb::ZERO;
        }
        let (at, mut sum) = (&surface.hit.at, Rgb::ZERO);
        map.near(at.p, at.ng, |photon, density| {
            let cos = photon.to_light.dot(at.ng).abs();
            if cos > 0.0 && depth.admits(&photon.bounces, &self.path.limits) {
                // The cosine of the value belongs to radiance; photons have it already, by the geometric normal.
                sum += density / cos * photon.flux * point.matte(photon.to_light);
            }
        });
        sum
    }
}

impl Path {
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
        Eye::of_path(self.sight, self.scattered.is_some())
    }

    /// Weakens it by the glass that it came through.
    fn absorb(&mut self, leaves: Option<Rgb>, surface: &SurfaceHit) {
        self.weight *= self.track.left(leaves, surface);
    }

    /// Goes on as if there were no surface.
    fn pass(&mut self, covering: &Covering<'_>, surface: &SurfaceHit, counters: &mut RayCounters) {
        counters.refraction += 1;
        self.absorb(None, surface);
        self.track.pass(covering, surface);
    }

    /// Sends it on.
    fn go_on(&mut self, onward: &Onward, point: &PathPoint<'_>, limits: &DepthLimits) {
        let sample = &onward.sample;
        self.track.take(onward, point);
        self.weight *= sample.weight;
        self.likelier *= point.likelier(sample);
        self.after = Some(sample.event);
        self.sight = self.sight.after(sample.is_delta());
        self.passed_only &= sample.event == Event::Transmission;
        if !onward.is_straight {
            self.since_matte = match (sample.is_delta(), self.since_matte) {
                (false, _) if sample.event == Event::Diffuse => Since::Nothing,
                (false, _) | (true, Since::Never) => Since::Never,
                (true, Since::Nothing | Since::Smooth) => Since::Smooth,
            };
            self.scattered = if sample.is_delta() { None } else { Some((point.lookout(), sample.pdf)) };
        }
        self.is_last |= self.depth.grow(sample.event, limits);
    }

    /// Ends it by chance if it carries little.
    #[inline]
    fn roulette(&mut self, draws: &mut Sampler) -> ControlFlow<()> {
        // What is led to where the light is weighs little, and matters all the same; what guiding would rather have left out weighs
        // much, and must not become rarer and brighter still.
        self.weight /= survive(self.likelier.max(1.0) * self.weight, self.depth.total, draws)?;
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

    /// Whether a path that is scattered here by a matte layer may go on as the photon came.
    fn admits(&self, bounces: &Bounces, limits: &DepthLimits) -> bool {
        let Bounces { total, glossy, transmission } = *bounces;
        // The last scattering before a light may be one too many of all.
        self.total + u32::from(total) <= limits.total
            && self.diffuse < limits.diffuse
            && self.glossy + u32::from(glossy) <= limits.glossy
            && self.transmission + u32::from(transmission) <= limits.transmission
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
