//! Tiles times samples: runs a pass over a film in parallel, with progress and cancel.
//!
//! Nothing here influences a pixel: tiles may finish in any order on any number of threads. The integrator is asked once
//! per sample; locks and atomics are touched once per tile.

use crate::camera_ray::CameraRays;
use crate::counters::RayCounters;
use crate::film::stopping::{Rule, Use};
use crate::film::{Film, MISS_DEPTH, Shot, Tile};
use crate::filter::PixelFilter;
use crate::integrator::Integrator;
use crate::sampler::{Pattern, branch};
use crate::world::World;
use glam::DVec2;
use heliostat_scene::Rgb;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
use std::ops::{AddAssign, Range};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

/// Samples per pixel that a tile takes before it looks whether the pass was cancelled.
const CHUNK: u32 = 16;

/// The caller's hand on a pass.
#[derive(Clone, Copy)]
pub struct Control<'a> {
    /// Once true, the pass ends within a few thousand camera rays per thread.
    pub cancel: &'a AtomicBool,
    /// Called after each tile, from any thread, several at once.
    pub on_tile: &'a (dyn Fn(TileDone) + Sync),
}

impl std::fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Control").field("cancel", self.cancel).finish_non_exhaustive()
    }
}

/// Progress of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileDone {
    /// Tiles of the pass that are done, this one included.
    pub done: usize,
    /// Tiles of the pass.
    pub total: usize,
    /// Rays of all kinds that the pass has traced so far.
    pub rays: u64,
}

/// How a pass ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassOutcome {
    /// Whether every pixel has its samples. If not, the pass was cancelled: some tiles hold fewer samples than others,
    /// the film remains good for [`crate::Prepared::frame`], and the same pass again takes what is missing.
    pub finished: bool,
    /// Camera samples that the pass has added to the film.
    pub samples: u64,
}

/// Counts of a pass.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    pub(crate) rays: RayCounters,
    pub(crate) samples: u64,
    pub(crate) non_finite: u64,
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.rays += other.rays;
        self.samples += other.samples;
        self.non_finite += other.non_finite;
    }
}

/// All that the samples of a pixel depend on.
pub(crate) struct Shooter<'a> {
    pub(crate) world: &'a World<'a>,
    pub(crate) integrator: &'a dyn Integrator,
    pub(crate) camera: &'a CameraRays,
    pub(crate) filter: &'a PixelFilter,
    pub(crate) pattern: Pattern,
    /// When pixels end, if noise decides.
    pub(crate) rule: Option<Rule>,
}

/// Adds `samples` to every pixel of the film, tiles in parallel on the threads of the current pool.
pub(crate) fn run(
    shooter: &Shooter<'_>,
    film: &mut Film,
    samples: &Range<u32>,
    control: &Control<'_>,
) -> (PassOutcome, Tally) {
    let total = film.tiles().len();
    let (done, rays) = (AtomicUsize::new(0), AtomicU64::new(0));
    let tally = film
        .tiles_mut()
        .par_iter_mut()
        // One tile at a time, so that one slow corner of the picture is shared by all threads.
        .with_max_len(1)
        .map(|tile| {
            let (finished, tally) = shooter.fill(tile, samples, control.cancel);
            if !finished {
                return tally;
            }
            let rays = rays.fetch_add(tally.rays.total(), Ordering::Relaxed) + tally.rays.total();
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            (control.on_tile)(TileDone { done, total, rays });
            tally
        })
        // Integers: their sum does not depend on the order.
        .reduce(Tally::default, |mut a, b| {
            a += b;
            a
        });
    let finished = done.into_inner() == total;
    (PassOutcome { finished, samples: tally.samples }, tally)
}

impl Shooter<'_> {
    /// Adds the samples that a tile does not hold yet; whether it got to the end of them.
    fn fill(&self, tile: &mut Tile, samples: &Range<u32>, cancel: &AtomicBool) -> (bool, Tally) {
        let mut tally = Tally::default();
        loop {
            if cancel.load(Ordering::Relaxed) {
                return (false, tally);
            }
            if tile.is_settled() {
                return (true, tally);
            }
            let look = self.rule.map_or(u32::MAX, |rule| rule.next_look(tile.samples()));
            let chunk = tile.claim(samples, CHUNK.min(look - tile.samples()));
            if chunk.is_empty() {
                return (true, tally);
            }
            self.fill_chunk(tile, &chunk, &mut tally);
            if let Some(rule) = self.rule.filter(|_| tile.samples() == look) {
                tile.look(&rule);
            }
        }
    }

    /// Adds a few samples to every pixel of a tile.
    fn fill_chunk(&self, tile: &mut Tile, samples: &Range<u32>, tally: &mut Tally) {
        let rect = tile.rect;
        let keeps_hits = tile.keeps_hits();
        let pixels = (rect.y0..rect.y1).flat_map(|y| (rect.x0..rect.x1).map(move |x| [x, y]));
        for (i, pixel) in pixels.enumerate() {
            let purpose = tile.purpose(i);
            if purpose == Use::None {
                continue;
            }
            for sample in samples.clone() {
                let shot = self.shoot(pixel, sample, &mut tally.rays);
                tally.samples += 1;
                if shot.is_finite() {
                    tile.add(i, &if keeps_hits { shot } else { Shot { hit: None, ..shot } }, purpose);
                } else {
                    tally.non_finite += 1;
                }
            }
        }
    }

    /// One sample of one pixel.
    fn shoot(&self, pixel: [u32; 2], sample: u32, rays: &mut RayCounters) -> Shot {
        let at = self.filter.sample(&self.pattern, pixel, sample);
        let empty = Shot {
            radiance: Rgb::ZERO,
            alpha: 0.0,
            depth: MISS_DEPTH,
            hit: None,
            is_negative: at.is_negative,
            distance: at.offset.length_squared() as f32,
        };
        let sampler = self.pattern.sampler(pixel, sample);
        let mut draws = sampler.fork(branch::CAMERA);
        let (lens, time) = (draws.next_2d(), draws.next_1d());
        let centre = DVec2::new(f64::from(pixel[0]), f64::from(pixel[1])) + 0.5;
        let Some(ray) = self.camera.ray(centre + at.offset, lens, time) else { return empty };
        rays.camera += 1;
        let mut draws = sampler.fork(branch::INTEGRATOR);
        let found = self.integrator.radiance(self.world, &ray, &mut draws, rays);
        Shot {
            radiance: found.radiance,
            alpha: found.alpha,
            depth: found.first.map_or(MISS_DEPTH, |hit| self.camera.depth(&ray, hit.p)),
            hit: found.first,
            ..empty
        }
    }
}
