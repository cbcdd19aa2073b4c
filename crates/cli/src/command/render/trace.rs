//! One frame, pass by pass, until it is done, its time is over or a signal comes.

use crate::progress::Progress;
use heliostat_render::{Control, Film, Prepared, RenderError, RenderStats, TileDone, TreeCache};
use heliostat_scene::{Frame, RenderSettings, Scene};
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// A picture and what it took.
#[derive(Debug)]
pub(crate) struct Traced {
    pub(crate) frame: Frame,
    pub(crate) stats: RenderStats,
    /// Whether every pixel has all its samples, or time is over between two passes.
    pub(crate) finished: bool,
    /// Samples of a pixel in the picture, on average.
    pub(crate) mean_samples: f64,
    /// Error of a pixel relative to its brightness, root mean square; `None` where it is not known.
    pub(crate) error: Option<f64>,
}

impl Traced {
    /// Whether there is nothing in the picture at all.
    pub(crate) fn is_empty(&self) -> bool {
        self.stats.samples == 0
    }

    /// What was reached, in a line.
    pub(crate) fn quality(&self) -> String {
        let samples = format!("Samples: {:.1} per pixel", self.mean_samples);
        match self.error {
            Some(error) => format!("{samples}, error: {:.3} %", 100.0 * error),
            None => samples,
        }
    }
}

/// Renders; `stop` ends it at the next tile.
pub(crate) fn trace(
    scene: &Scene,
    settings: &RenderSettings,
    cache: &mut TreeCache,
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<Traced, RenderError> {
    let started = Instant::now();
    let prepared = Prepared::with_cache(scene, settings, cache)?;
    let mut film = prepared.film();
    let mut clock = Clock { started, limit: settings.time, sample_seconds: 0.0 };
    progress.trace(prepared.forecast(&film) as u64);
    let (mut finished, mut end, most) = (true, 0, settings.most_samples());
    while finished && end < most && !film.is_settled() && !clock.is_over() {
        let pass = clock.shorten(next_pass(end, most));
        end = pass.end;
        let (begun, samples) = (Instant::now(), f64::from(pass.end - pass.start));
        finished = add_pass(&prepared, &mut film, pass, progress, stop);
        clock.sample_seconds = begun.elapsed().as_secs_f64() / samples;
        let (done, forecast) = (prepared.stats().samples as f64, prepared.forecast(&film));
        progress.aim(clock.total(done).unwrap_or(f64::INFINITY).min(forecast).max(done) as u64);
    }
    let (mean_samples, error) = (film.mean_samples(), prepared.error(&film));
    let frame = prepared.frame(&film);
    Ok(Traced { frame, stats: prepared.stats(), finished, mean_samples, error })
}

/// Adds a pass and tells how far it is; whether it came to its end.
fn add_pass(
    prepared: &Prepared<'_>,
    film: &mut Film,
    pass: Range<u32>,
    progress: &Progress,
    stop: &AtomicBool,
) -> bool {
    let before = prepared.stats();
    let camera_rays = film.open_pixels() * u64::from(pass.end - pass.start);
    let tell = |tile: TileDone| {
        let part = u128::from(camera_rays) * tile.done as u128 / tile.total.max(1) as u128;
        progress.reach(before.samples + part as u64, before.rays.total() + tile.rays);
    };
    prepared.pass(film, pass, &Control { cancel: stop, on_tile: &tell }).finished
}

/// One sample first, then twice as many each time: whoever stops a render has a whole picture soon, and few passes
/// are made.
fn next_pass(start: u32, most: u32) -> Range<u32> {
    /// Camera rays per pixel of a pass at most: a signal waits for a tile of a pass.
    const LONGEST: u32 = 32;
    start..start.saturating_add(start.clamp(1, LONGEST)).min(most)
}

/// The time that a frame may take.
#[derive(Clone, Copy, Debug)]
struct Clock {
    started: Instant,
    /// Seconds.
    limit: Option<f64>,
    /// Seconds that a sample of all pixels took in the last pass.
    sample_seconds: f64,
}

impl Clock {
    fn left(&self) -> Option<f64> {
        Some(self.limit? - self.started.elapsed().as_secs_f64())
    }

    fn is_over(&self) -> bool {
        self.left().is_some_and(|left| left <= 0.0)
    }

    /// The part of a pass that should fit into the time that is left, and one sample at least.
    fn shorten(&self, pass: Range<u32>) -> Range<u32> {
        match self.left() {
            Some(left) if self.sample_seconds > 0.0 => fitting(pass, left / self.sample_seconds),
            _ => pass,
        }
    }

    /// The samples that there will be when time is over, if it goes on as until now.
    fn total(&self, done: f64) -> Option<f64> {
        let elapsed = self.started.elapsed().as_secs_f64();
        Some(done * (self.limit? / elapsed).max(1.0))
    }
}

/// The first samples of a pass, as many as fit, and one at least.
fn fitting(pass: Range<u32>, samples: f64) -> Range<u32> {
    pass.start..pass.end.min(pass.start.saturating_add(samples.max(1.0) as u32))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passes(most: u32) -> Vec<Range<u32>> {
        let next = |pass: &Range<u32>| (pass.end < most).then(|| next_pass(pass.end, most));
        std::iter::successors(Some(next_pass(0, most)), next).collect()
    }

    #[test]
    fn passes_tile_the_samples() {
        assert_eq!(passes(1).iter().map(|p| (p.start, p.end)).collect::<Vec<_>>(), [(0, 1)]);
        assert_eq!(passes(16), [0..1, 1..2, 2..4, 4..8, 8..16]);
        assert_eq!(passes(5), [0..1, 1..2, 2..4, 4..5]);
        for samples in 1..200 {
            let all: Vec<u32> = passes(samples).into_iter().flatten().collect();
            assert_eq!(all, (0..samples).collect::<Vec<_>>());
        }
        assert_eq!(passes(1000).iter().map(Range::len).max(), Some(32));
    }

    #[test]
    fn a_pass_is_cut_to_the_time_that_is_left() {
        assert_eq!(fitting(8..16, 3.9), 8..11);
        assert_eq!(fitting(8..16, 0.0), 8..9);
        assert_eq!(fitting(8..16, 1e30), 8..16);
    }
}
