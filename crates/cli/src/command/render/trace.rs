//! One frame, pass by pass, until it is done or a signal comes.

use crate::progress::Progress;
use heliostat_render::{Control, Prepared, RenderError, RenderStats, TileDone, TreeCache};
use heliostat_scene::{Frame, RenderSettings, Scene};
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// A picture and what it took.
#[derive(Debug)]
pub(crate) struct Traced {
    pub(crate) frame: Frame,
    pub(crate) stats: RenderStats,
    /// Whether every pixel has all its samples.
    pub(crate) finished: bool,
}

impl Traced {
    /// Whether there is nothing in the picture at all.
    pub(crate) fn is_empty(&self) -> bool {
        self.stats.samples == 0
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
    let prepared = Prepared::with_cache(scene, settings, cache)?;
    let mut film = prepared.film();
    let window = settings.pixels();
    let pixels = u64::from(window.width()) * u64::from(window.height());
    progress.trace(pixels * u64::from(settings.samples));
    let (mut finished, mut rays) = (true, 0);
    for pass in passes(settings.samples) {
        let before = pixels * u64::from(pass.start);
        let camera_rays = pixels * u64::from(pass.end - pass.start);
        let tell = |tile: TileDone| {
            let part = u128::from(camera_rays) * tile.done as u128 / tile.total.max(1) as u128;
            progress.reach(before + part as u64, rays + tile.rays);
        };
        finished = prepared.pass(&mut film, pass, &Control { cancel: stop, on_tile: &tell }).finished;
        if !finished {
            break;
        }
        rays = prepared.stats().rays.total();
    }
    let frame = prepared.frame(&film);
    Ok(Traced { frame, stats: prepared.stats(), finished })
}

/// One sample first, then twice as many each time: whoever stops a render has a whole picture soon, and few passes
/// are made.
fn passes(samples: u32) -> impl Iterator<Item = Range<u32>> {
    /// Camera rays per pixel of a pass at most: a signal waits for a tile of a pass.
    const LONGEST: u32 = 32;
    let longer = move |&end: &u32| (end < samples).then(|| end.saturating_add(end.min(LONGEST)));
    let ends = std::iter::successors(Some(1), longer);
    let mut start = 0;
    ends.map(move |end| {
        let pass = start..end.min(samples);
        start = pass.end;
        pass
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_tile_the_samples() {
        assert_eq!(passes(1).map(|p| (p.start, p.end)).collect::<Vec<_>>(), [(0, 1)]);
        assert_eq!(passes(16).collect::<Vec<_>>(), [0..1, 1..2, 2..4, 4..8, 8..16]);
        assert_eq!(passes(5).collect::<Vec<_>>(), [0..1, 1..2, 2..4, 4..5]);
        for samples in 1..200 {
            let all: Vec<u32> = passes(samples).flatten().collect();
            assert_eq!(all, (0..samples).collect::<Vec<_>>());
        }
        assert_eq!(passes(1000).map(|p| p.len()).max(), Some(32));
    }
}
