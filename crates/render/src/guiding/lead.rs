//! How directions are drawn at one point: by the surface, or from what was learnt around it.
//!
//! # Source
//! Vorba et al., "On-line Learning of Parametric Mixture Models for Light Transport Simulation", SIGGRAPH 2014, section 6: the
//! mixture, by one sample.

use super::directions::Directions;
use crate::bsdf::{BsdfSample, Event, View};
use glam::{Vec2, Vec3};
use heliostat_geometry::OrthonormalFrame;
use heliostat_scene::Rgb;

/// What leads paths on from a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lead<'a> {
    directions: &'a Directions,
    breadth: f32,
    /// The probability with which it is followed.
    share: f32,
}

/// Densities of a direction at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Odds {
    /// By the surface.
    surface: f32,
    /// By what was learnt.
    learnt: f32,
    breadth: f32,
}

impl Odds {
    #[cfg(test)]
    pub(super) fn new(surface: f32, learnt: f32, breadth: f32) -> Self {
        Self { surface, learnt, breadth }
    }

    /// The density in a mixture that leaves so much to a surface that scatters all around.
    pub(super) fn mixed(&self, own: f32) -> f32 {
        let share = share(own, self.breadth);
        (1.0 - share) * self.surface + share * self.learnt
    }
}

/// The probability with which what was learnt is followed.
fn share(own: f32, breadth: f32) -> f32 {
    (1.0 - own) * breadth
}

impl<'a> Lead<'a> {
    /// One that leaves the share `own` to a surface that scatters all around.
    #[inline]
    pub(super) fn new(directions: &'a Directions, own: f32, breadth: f32) -> Self {
        Self { directions, breadth, share: share(own, breadth) }
    }

    /// The density of a direction that the surface draws with the density `pdf`.
    #[inline]
    pub(crate) fn pdf(&self, dir: Vec3, pdf: f32) -> f32 {
        (1.0 - self.share) * pdf + self.share * self.directions.pdf(dir)
    }

    /// The densities of a direction that was drawn with the density `pdf`.
    pub(super) fn odds(&self, dir: Vec3, pdf: f32) -> Odds {
        let learnt = self.directions.pdf(dir);
        let surface = ((pdf - self.share * learnt) / (1.0 - self.share)).max(0.0);
        Odds { surface, learnt, breadth: self.breadth }
    }

    /// How much likelier a direction is than by the surface alone that was drawn with the density `pdf`; 1 where the surface hardly
    /// draws it at all.
    pub(crate) fn likelier(&self, dir: Vec3, pdf: f32) -> f32 {
        let Odds { surface, .. } = self.odds(dir, pdf);
        if surface > 0.0 { pdf / surface } else { 1.0 }
    }

    /// A direction, in the frame of the surface, for a path that carries so much: by what was learnt where `layer` falls below its share, else by the surface.
    #[inline]
    pub(crate) fn sample(
        &self,
        view: &View<'_>,
        frame: &OrthonormalFrame,
        carried: Rgb,
        layer: f32,
        u: Vec2,
    ) -> Option<BsdfSample> {
        let own = 1.0 - self.share;
        if layer < self.share {
            return self.sample_learnt(view, frame, layer / self.share, u);
        }
        let layer = ((layer - self.share) / own).min(1.0_f32.next_down());
        let sample = view.sample(carried, layer, u)?;
        if sample.is_delta() {
            return Some(BsdfSample { weight: sample.weight / own, ..sample });
        }
        let pdf = self.pdf(frame.to_world(sample.wi), sample.pdf);
        Some(BsdfSample { weight: sample.pdf / pdf * sample.weight, pdf, ..sample })
    }

    /// A direction by what was learnt. It is told as scattered by one of the layers that might have drawn it, by their densities:
    /// limits of depth and caustics by photons then mean what they mean without guiding.
    fn sample_learnt(
        &self,
        view: &View<'_>,
        frame: &OrthonormalFrame,
        choice: f32,
        u: Vec2,
    ) -> Option<BsdfSample> {
        let dir = self.directions.sample(u);
        let wi = frame.to_local(dir);
        let (value, surface) = view.eval(wi);
        if value == Rgb::ZERO || surface <= 0.0 {
            return None;
        }
        let pdf = self.pdf(dir, surface);
        let event = match choice * surface < view.matte_pdf(wi) {
            true => Event::Diffuse,
            false if wi.z > 0.0 => Event::Glossy,
            false => Event::Transmission,
        };
        Some(BsdfSample { wi, weight: value / pdf, pdf, event })
    }
}
