//! The way of a photon: from a lamp over mirrors and through clear glass to what scatters it.
//!
//! It goes as a path goes that comes the other way, and stays on every surface that scatters light once it was reflected or
//! refracted. What a path asks lamps for, straight light, leaves no photon.
//!
//! # Source
//! Jensen, "Global Illumination using Photon Maps", EGWR 1996: the map of caustics.

use super::map::{Bounces, Photon};
use crate::bsdf::Event;
use crate::integrator::{HOLES, survive};
use crate::light::emission::Emitted;
use crate::path_point::{Covering, PathPoint};
use crate::sampler::Sampler;
use crate::track::Track;
use crate::world::{Eye, Owner, SurfaceHit, World};
use heliostat_scene::Rgb;
use std::ops::ControlFlow;

/// A photon on its way.
pub(super) struct Flight<'w, 's> {
    world: &'w World<'s>,
    time: f32,
    track: Track,
    /// When it began.
    flux: Rgb,
    /// What is left of it.
    weight: Rgb,
    bounces: Bounces,
    /// Whether it was reflected or refracted: what only passes straight through is no caustic.
    is_caustic: bool,
}

impl<'w, 's> Flight<'w, 's> {
    pub(super) fn new(world: &'w World<'s>, emitted: &Emitted, time: f32) -> Self {
        Self {
            world,
            time,
            track: Track::free(world, emitted.ray, time),
            flux: emitted.flux,
            weight: Rgb::ONE,
            bounces: Bounces::default(),
            is_caustic: false,
        }
    }

    /// Follows it to its end, and leaves photons where it is scattered.
    pub(super) fn run(mut self, draws: &Sampler, photons: &mut Vec<Photon>) {
        let mut step = 0;
        while self.follow(draws.fork(step), photons).is_continue() {
            step += 1;
        }
    }

    /// Follows it to the next surface.
    fn follow(&mut self, mut draws: Sampler, photons: &mut Vec<Photon>) -> ControlFlow<()> {
        let world = self.world;
        let seen = self.track.seen(world, self.time, Eye::Any);
        let Some(surface) = &seen else { return ControlFlow::Break(()) };
        let Owner::Object { index, material } = surface.owner else { return ControlFlow::Break(()) };
        let dir = self.track.dir();

        // Go on where there is no surface.
        let covering = Covering::new(world, surface, material);
        let opacity = covering.opacity();
        let is_hole = opacity < 1.0 && draws.fork(HOLES).next_1d() >= opacity;
        if is_hole || covering.is_hidden(surface, &self.track.around) {
            self.pass(&covering, surface);
            return ControlFlow::Continue(());
        }

        // Stay on what scatters.
        self.absorb(covering.left_absorption(surface, dir), surface);
        let (mut room, around) = (None, self.track.around);
        let point = PathPoint::new(world, &covering, surface, dir, self.time, &around, &mut room);
        if self.is_caustic && point.is_matte() {
            let at = surface.hit.at;
            let flux = self.weight * self.flux;
            let to_light = -dir.normalize();
            photons.push(Photon { p: at.p, ng: at.ng, to_light, flux, bounces: self.bounces });
        }
        // What casts no shadow takes light, and lets it go on.
        if !world.scene().objects[index as usize].casts_shadow {
            self.track.pass(&covering, surface);
            return ControlFlow::Continue(());
        }

        // Go on by mirror and clear glass alone.
        let choice = draws.next_2d();
        let onward = point.sample(self.weight * self.flux, choice.y, draws.next_2d());
        let smooth = onward.filter(|way| way.sample.is_delta() && way.sample.event != Event::Subsurface);
        let Some(onward) = smooth else { return ControlFlow::Break(()) };
        self.weight *= point.adjoint(&onward, &around) * onward.sample.weight;
        self.is_caustic |= !onward.is_straight;
        self.bounces.count(onward.sample.event);
        self.track.take(&onward, &point);
        self.roulette(&mut draws)
    }

    /// Weakens it by the glass that it came through.
    fn absorb(&mut self, leaves: Option<Rgb>, surface: &SurfaceHit) {
        self.weight *= self.track.left(leaves, surface);
    }

    /// Goes on as if there were no surface.
    fn pass(&mut self, covering: &Covering<'_>, surface: &SurfaceHit) {
        self.absorb(None, surface);
        self.track.pass(covering, surface);
    }

    /// Ends it by chance if little is left of it, as paths are ended.
    fn roulette(&mut self, draws: &mut Sampler) -> ControlFlow<()> {
        self.weight /= survive(self.weight, self.bounces.total.into(), draws)?;
        ControlFlow::Continue(())
    }
}
