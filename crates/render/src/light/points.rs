//! Lamps that are points and weaken with the distance, for ways through media past them: chosen by their power.

use super::choice::{Piece, Reach};
use super::{LightSample, LightTable, Lookout, PreparedLight, Source, sums};
use crate::medium::flight::Way;
use glam::Vec3;

/// The choice among lamps that are points.
#[derive(Debug)]
pub(super) struct Points {
    /// Running sums of the probabilities of all lights, 0 for those of other kinds; empty where there are no such lamps.
    sums: Vec<f64>,
}

impl Points {
    pub(super) fn new(lights: &[PreparedLight<'_>]) -> Self {
        let power = |light: &PreparedLight<'_>| match &light.source {
            Source::Point(point) if point.falls_off() => match point.reach() {
                Reach::Near(cluster) => f64::from(cluster.power()),
                Reach::Far(_) => 0.0,
            },
            Source::Point(_) | Source::Directional(_) | Source::Area(_) | Source::Sun(..) => 0.0,
        };
        let all: f64 = lights.iter().map(power).sum();
        let is_lit = all > 0.0 && all.is_finite();
        let shares = lights.iter().filter(|_| is_lit).map(|light| power(light) / all);
        Self { sums: sums::running(shares).collect() }
    }
}

impl LightTable<'_> {
    /// Whether there are lamps that are points.
    #[inline]
    pub(crate) fn has_lamps(&self) -> bool {
        !self.points.sums.is_empty()
    }

    /// The number of a lamp that is a point, by its power, and where it is; `None` without such lamps.
    pub(crate) fn pick_lamp(&self, u: f32) -> Option<(usize, Vec3)> {
        let (light, _) = self.has_lamps().then(|| sums::pick(&self.points.sums, u))?;
        Some((light, self.lamp(light)?.0))
    }

    /// Where a light is, and the probability of [`Self::pick_lamp`]; `None` for lights that are no points.
    pub(crate) fn lamp(&self, light: usize) -> Option<(Vec3, f32)> {
        match &self.lights.get(light)?.source {
            Source::Point(point) if point.falls_off() => {
                Some((point.position(), sums::share(&self.points.sums, light) as f32))
            }
            Source::Point(_) | Source::Directional(_) | Source::Area(_) | Source::Sun(..) => None,
        }
    }

    /// The part of a way that a lamp may light.
    pub(crate) fn lit_by_lamp(&self, light: usize, way: &Way) -> Way {
        match &self.lights[light].source {
            Source::Point(point) => point.lit(way),
            Source::Directional(_) | Source::Area(_) | Source::Sun(..) => *way,
        }
    }

    /// The light of a lamp for a point; `None` where nothing comes this way.
    pub(crate) fn of_lamp(&self, light: usize, p: Vec3) -> Option<LightSample> {
        match &self.lights[light].source {
            Source::Point(point) => point.sample(p),
            Source::Directional(_) | Source::Area(_) | Source::Sun(..) => None,
        }
    }

    /// The probability with which [`Self::draw_one`] chooses a light of one piece.
    pub(crate) fn odds(&self, from: &Lookout, light: usize) -> f32 {
        self.sampler.probability(from, Piece { light, piece: 0 })
    }
}
