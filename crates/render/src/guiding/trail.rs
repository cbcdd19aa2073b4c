//! What a path leaves behind: where light was scattered, and how much of it has come from there in the end.

use super::lead::Odds;
use crate::path_point::{Onward, PathPoint};
use glam::{Vec2, Vec3};
use heliostat_geometry::warp::sphere_to_square;
use heliostat_scene::Rgb;

/// Scatterings of a path that are learnt from, at most: later ones carry little.
const MOST_STEPS: usize = 32;

/// The scatterings of a path so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trail {
    steps: Vec<Step>,
}

/// A scattering.
#[derive(Clone, Copy, Debug)]
struct Step {
    p: Vec3,
    /// Where the path went on.
    dir: Vec3,
    /// With what density.
    pdf: f32,
    /// What the surface sends on of light from there, about.
    value: f32,
    lead: Option<Odds>,
    /// What radiance from there is multiplied by.
    weight: Rgb,
    /// What the path had found before.
    found: Rgb,
}

/// Light that came to a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Record {
    /// Its leaf.
    pub(super) leaf: u32,
    pub(super) p: Vec3,
    /// The direction where it came from, on the unit square.
    pub(super) dir: Vec2,
    /// The density with which it was found.
    pub(super) pdf: f32,
    /// What the surface has sent on, over the density.
    pub(super) sent: f32,
    /// The densities of what it was drawn from, where something was learnt.
    pub(super) lead: Option<Odds>,
}

impl Trail {
    /// Notes that the path goes on from a point, by which what it finds is multiplied by `weight` from now on.
    pub(crate) fn add(&mut self, point: &PathPoint<'_>, onward: &Onward, weight: Rgb, found: Rgb) {
        let sample = &onward.sample;
        if sample.is_delta() || self.steps.len() == MOST_STEPS {
            return;
        }
        let dir = onward.dir;
        self.steps.push(Step {
            p: point.lookout().p,
            dir,
            pdf: sample.pdf,
            value: mean(sample.weight) * sample.pdf,
            lead: point.lead().map(|lead| lead.odds(dir, sample.pdf)),
            weight,
            found,
        });
    }

    /// What was learnt by a path that has found so much in all, without leaves.
    pub(super) fn records(&self, found: Rgb) -> impl Iterator<Item = Record> {
        self.steps.iter().filter_map(move |step| step.record(found))
    }
}

impl Step {
    /// `None` where no light came, or there is no number for it.
    fn record(&self, found: Rgb) -> Option<Record> {
        let Self { p, dir, pdf, value, lead, weight, .. } = *self;
        // Per channel: what is carried of one says nothing about light in another.
        let came = (found - self.found).max(Rgb::ZERO);
        let light = mean(Rgb::select(weight.cmpgt(Rgb::ZERO), came / weight, Rgb::ZERO));
        let sent = light * value / pdf;
        let record = Record { leaf: 0, p, dir: sphere_to_square(dir), pdf, sent, lead };
        (sent > 0.0 && sent.is_finite() && p.is_finite()).then_some(record)
    }
}

/// The mean of the channels.
fn mean(color: Rgb) -> f32 {
    color.element_sum() / 3.0
}
