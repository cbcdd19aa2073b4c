//! A path on its way through surfaces and media.

use crate::bsdf::Event;
use crate::integrator::path::Depth;
use crate::integrator::roulette::survive;
use crate::light::Lookout;
use crate::medium::lead::Lead;
use crate::medium::{PreparedMedium, flight};
use crate::path_point::{Covering, Onward, PathPoint};
use crate::sampler::Sampler;
use crate::track::Track;
use crate::world::{Eye, Matter, PassingRay, Sight, SurfaceHit};
use heliostat_scene::Rgb;
use heliostat_scene::settings::DepthLimits;
use std::ops::ControlFlow;

/// A path on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) track: Track,
    /// What radiance from here is multiplied by, over the chances of the flight.
    pub(super) weight: Rgb,
    /// The flight since the last scattering, where there was a medium on it.
    lead: Option<Lead>,
    /// Where light was scattered last, and with what density it was sent here; `None` where only camera, mirrors and glass
    /// are behind.
    pub(super) scattered: Option<(Lookout, f32)>,
    /// What happened last.
    pub(super) after: Option<Event>,
    pub(super) depth: Depth,
    /// How it comes from the camera.
    sight: Sight,
    /// Whether it has only passed through things: then it sees no background that is to stay transparent.
    pub(super) passed_only: bool,
    /// Whether it looks for lights alone, and ends with the next surface.
    pub(super) is_last: bool,
}

impl Way {
    /// From the camera.
    pub(super) fn new(track: Track) -> Self {
        Self {
            track,
            weight: Rgb::ONE,
            lead: None,
            scattered: None,
            after: None,
            depth: Depth::default(),
            sight: Sight::Straight,
            passed_only: true,
            is_last: false,
        }
    }

    /// Who looks along it.
    pub(super) fn eye(&self) -> Eye {
        Eye::of_path(self.sight, self.scattered.is_some())
    }

    /// Its way through a medium up to `end` lengths of the ray; `None` where the medium has ended before.
    pub(super) fn through(&self, matter: &Matter<'_, '_>, end: f32) -> Option<flight::Way> {
        let ray = self.track.passing.ray;
        let length = ray.dir.length();
        let (dir, from, to) = (ray.dir / length, 0.0, end * length);
        let way = matter.clip(flight::Way { origin: ray.origin, dir, from, to });
        (way.from < way.to).then_some(way)
    }

    /// Flies on that way: the distance at which it is scattered, `None` where it gets through.
    pub(super) fn fly(
        &mut self,
        medium: &PreparedMedium<'_>,
        way: &flight::Way,
        draws: &mut Sampler,
    ) -> Option<f32> {
        let mut lead = self.lead.or_else(|| Lead::new(self.weight, draws.next_1d()))?;
        let t = medium.fly(way, &mut lead, &mut self.weight, draws);
        self.lead = Some(lead);
        t
    }

    /// What radiance from here is multiplied by.
    #[inline]
    pub(super) fn settled(&self) -> Rgb {
        self.lead.map_or(self.weight, |lead| self.weight / lead.own())
    }

    /// The densities of the flight and of a shadow ray on the same way.
    #[inline]
    pub(super) fn chances(&self) -> (f32, f32) {
        self.lead.map_or((1.0, 1.0), |lead| (lead.own(), lead.asked()))
    }

    /// Ends a flight with that weight.
    pub(super) fn settle(&mut self, weight: Rgb) {
        self.weight = weight;
        self.lead = None;
    }

    /// Weakens it by the glass that it came through.
    pub(super) fn absorb(&mut self, leaves: Option<Rgb>, surface: &SurfaceHit) {
        self.weight *= self.track.left(leaves, surface);
    }

    /// Goes on as if there were no surface.
    pub(super) fn pass(&mut self, covering: &Covering<'_>, surface: &SurfaceHit) {
        self.absorb(None, surface);
        self.track.pass(covering, surface);
    }

    /// Sends it on from a surface.
    pub(super) fn go_on(&mut self, onward: &Onward, point: &PathPoint<'_>, limits: &DepthLimits) {
        let sample = &onward.sample;
        if !onward.is_straight {
            self.settle(self.settled());
            self.scattered = if sample.is_delta() { None } else { Some((point.lookout(), sample.pdf)) };
        }
        self.track.take(onward, point);
        self.weight *= sample.weight;
        self.after = Some(sample.event);
        self.sight = self.sight.after(sample.is_delta());
        self.passed_only &= sample.event == Event::Transmission;
        self.is_last |= self.depth.grow(sample.event, limits);
    }

    /// Sends it on from a point of a medium, along a ray drawn with that density.
    pub(super) fn scattered_by_medium(
        &mut self,
        from: Lookout,
        passing: PassingRay,
        pdf: f32,
        limits: &DepthLimits,
    ) {
        self.track.passing = passing;
        self.scattered = Some((from, pdf));
        // Surfaces that light nothing do not light media either.
        self.after = Some(Event::Diffuse);
        self.sight = Sight::Lost;
        self.passed_only = false;
        self.is_last |= self.depth.grow_volume(limits);
    }

    /// Ends it by chance if it carries little. In a medium that scatters all no light is lost, and no path ends by chance; between
    /// surfaces that reflect all, some must.
    pub(super) fn roulette(&mut self, draws: &mut Sampler) -> ControlFlow<()> {
        self.weight /= survive(self.settled(), self.depth.total, draws)?;
        ControlFlow::Continue(())
    }
}
