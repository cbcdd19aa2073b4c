//! Path guiding: paths learn where light comes from, and look there.
//!
//! Before the first sample, paths through the whole picture are followed for practice, in turns that double. What light each of
//! them found is laid down where it was scattered: a tree over places, whose leaves hold a tree over directions each. The next
//! turn draws its directions from both, surface and tree, and so learns better. Then the field is frozen: what is rendered by it is
//! without a bias, because every direction is weighed by the density of the mixture, and lights are asked against that same
//! density. Light that was found for practice is thrown away.
//!
//! # What is drawn
//! With probability `g = (1 - a) b` a direction from the tree, else what the surface draws, mirrors and clear glass included. `a` is
//! learnt by each leaf: it is the share for which the mixture comes closest to what light the surfaces there sent on. `b` is how
//! broad the surface scatters: no tree knows the directions of a narrow highlight as well as the surface itself.
//!
//! # Promise
//! Practice is a function of scene, seed, size of the picture and number of paths, not of threads, tiles, regions or passes. What
//! paths find is sorted by leaf, in the order of the paths, before it is added up.
//!
//! # Source
//! Müller, Gross, Novák, "Practical Path Guiding for Efficient Light-Transport Simulation", EGSR 2017; Müller, "Practical Path
//! Guiding in Production", in "Path Guiding in Production", SIGGRAPH Courses 2019, chapter 10 (box filters over directions, a
//! learnt share of the surface). What is laid down is not the light that comes but what the surface sends on of
//! it, weighed against what lights are asked for: of the targets that were measured it left the least noise. The root of its
//! mean square (Rath et al., "Variance-Aware Path Guiding", SIGGRAPH 2020) was no better here.

mod directions;
mod growth;
mod lead;
mod learn;
mod places;
#[cfg(test)]
mod tests;
mod trail;

pub(crate) use lead::Lead;
pub use learn::Course;
pub(crate) use learn::learn;
pub(crate) use trail::Trail;

use crate::counters::RayCounters;
use directions::Directions;
use glam::Vec3;
use heliostat_scene::RenderSettings;
use heliostat_scene::settings::{Guiding, IntegratorKind};
use places::Places;

/// Camera rays of the picture for each path of practice.
const RAYS_PER_PATH: u64 = 4;
/// Fewer paths learn nothing.
const LEAST_PATHS: u64 = 1 << 14;
/// More learn little more.
const MOST_PATHS: u64 = 1 << 22;

/// What settings ask of guiding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GuidingSettings {
    /// Paths that are followed for practice.
    paths: u32,
    seed: u64,
}

impl GuidingSettings {
    /// `None` where none is asked for.
    pub(crate) fn of(settings: &RenderSettings) -> Option<Self> {
        let (paths, seed) = (practice(settings), settings.seed);
        let is_asked = settings.guiding == Guiding::Learn && settings.integrator == IntegratorKind::Path;
        is_asked.then_some(Self { paths, seed })
    }
}

/// Paths for practice: as many as the settings say, else in proportion to the camera rays of the picture.
pub(crate) fn practice(settings: &RenderSettings) -> u32 {
    let pixels = u64::from(settings.width) * u64::from(settings.height);
    let natural = (pixels * u64::from(settings.samples) / RAYS_PER_PATH).clamp(LEAST_PATHS, MOST_PATHS);
    settings.guiding_paths.unwrap_or(natural as u32)
}

/// What paths have learnt of a scene: where light comes from, by places.
#[derive(Clone, Debug)]
pub struct Guide {
    places: Places,
    /// By the leaves of the places.
    lobes: Vec<Lobe>,
    /// Rays that learning took.
    rays: RayCounters,
}

/// Where light comes from around a place.
#[derive(Clone, Debug)]
struct Lobe {
    /// `None` where no light was found.
    directions: Option<Directions>,
    /// The probability that is left to a surface that scatters all around.
    own: f32,
}

impl Guide {
    /// One that knows nothing.
    fn new() -> Self {
        let lobe = Lobe { directions: None, own: growth::UNKNOWN };
        Self { places: Places::new(), lobes: vec![lobe], rays: RayCounters::default() }
    }

    /// How directions are drawn at a place by a surface that scatters light as broadly as `breadth` says, from 0 for a mirror to 1.
    /// `None` where the surface is better left alone.
    #[inline]
    pub(crate) fn lead(&self, p: Vec3, breadth: f32) -> Option<Lead<'_>> {
        if breadth <= 0.0 {
            return None;
        }
        let lobe = &self.lobes[self.places.leaf(p) as usize];
        lobe.directions.as_ref().map(|directions| Lead::new(directions, lobe.own, breadth))
    }

    /// Rays that learning took.
    pub(crate) fn rays(&self) -> RayCounters {
        self.rays
    }
}
