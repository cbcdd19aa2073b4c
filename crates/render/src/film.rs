//! What the pixels have gathered: sums in `f64`, tile by tile.
//!
//! A tile owns its pixels, so that tiles are filled in parallel without locks. Within a pixel samples are added in the order of
//! their index; tiles, threads and the cutting of a render into passes leave no trace in the sums.

use crate::filter::PixelFilter;
use crate::integrator::FirstHit;
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;
use heliostat_scene::settings::PixelRect;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use std::ops::Range;

/// Side of a tile in pixels.
const TILE: u32 = 16;

/// Depth where nothing was hit.
pub(crate) const MISS_DEPTH: f32 = 1e10;

/// Sums over the samples of every pixel; starts empty, see [`crate::Prepared::film`].
#[derive(Clone, Debug)]
pub struct Film {
    window: PixelRect,
    tiles: Vec<Tile>,
    keep: Keep,
    /// Integrals of the positive and negative parts of the filter.
    masses: (f64, f64),
}

/// What a film keeps beside one sum of colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Keep {
    /// Sums of their own for samples that subtract.
    pub(crate) lobes: bool,
    /// Sums of albedo.
    pub(crate) albedo: bool,
    /// The sample nearest to the centre of each pixel.
    pub(crate) nearest: bool,
}

/// A few thousand pixels of a film.
#[derive(Clone, Debug)]
pub(crate) struct Tile {
    pub(crate) rect: PixelRect,
    /// Sample that follows the last one held; samples are added in rising order.
    next_sample: u32,
    /// Samples that each pixel has taken.
    samples: u32,
    positive: Stratum,
    /// Empty where the filter is nowhere negative.
    negative: Stratum,
    /// Empty unless asked for.
    nearest: Vec<Nearest>,
}

/// Sums of one sign of the filter.
#[derive(Clone, Debug, Default)]
struct Stratum {
    sums: Vec<Sum>,
    /// Empty unless asked for.
    albedo: Vec<[f64; 3]>,
}

/// Sum of radiance and alpha, and the number of samples in it.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    rgba: [f64; 4],
    count: u32,
}

/// The sample nearest to the centre of its pixel, in as few bytes as there are pixels many.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Squared distance from the centre; infinite while there is no sample.
    distance: f32,
    /// Depth, [`MISS_DEPTH`] on a miss.
    pub(crate) depth: f32,
    /// Shading normal, position and surface parameters; 0 on a miss.
    pub(crate) normal: Vec3,
    pub(crate) p: Vec3,
    pub(crate) uv: Vec2,
    /// Index + 1 of the object and its material; 0 for none.
    pub(crate) object: u32,
    pub(crate) material: u32,
}

impl Nearest {
    /// No sample, or one that met nothing.
    pub(crate) const NONE: Self = Self {
        distance: f32::INFINITY,
        depth: MISS_DEPTH,
        normal: Vec3::ZERO,
        p: Vec3::ZERO,
        uv: Vec2::ZERO,
        object: 0,
        material: 0,
    };

    fn of(shot: &Shot) -> Self {
        let none = Self { distance: shot.distance, depth: shot.depth, ..Self::NONE };
        let id = |index: Option<u32>| index.map_or(0, |index| index.saturating_add(1));
        shot.hit.map_or(none, |hit| Self {
            normal: hit.normal,
            p: hit.p,
            uv: hit.uv,
            object: id(hit.object),
            material: id(hit.material.map(|material| material.0)),
            ..none
        })
    }
}

/// One finished sample of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shot {
    pub(crate) radiance: Rgb,
    pub(crate) alpha: f32,
    pub(crate) depth: f32,
    pub(crate) hit: Option<FirstHit>,
    /// Whether the filter subtracts it.
    pub(crate) is_negative: bool,
    /// Squared distance from the centre of the pixel.
    pub(crate) distance: f32,
}

impl Shot {
    /// Whether every number in it is one.
    pub(crate) fn is_finite(&self) -> bool {
        let hit = self.hit.is_none_or(|hit| {
            let sum = hit.p + hit.normal + hit.albedo;
            // A sum is finite only where all of its terms are (overflow aside, which no honest scene reaches).
            sum.is_finite() && hit.uv.is_finite()
        });
        self.radiance.is_finite() && self.alpha.is_finite() && self.depth.is_finite() && hit
    }
}

impl Film {
    /// An empty film over `window`.
    pub(crate) fn new(window: PixelRect, filter: &PixelFilter, keep: Keep) -> Self {
        // In parallel: the system hands out memory at its first touch.
        let rects: Vec<_> = tile_rects(window).collect();
        let tiles = rects.into_par_iter().map(|rect| Tile::new(rect, keep)).collect();
        Self { window, tiles, keep, masses: filter.masses() }
    }

    /// Bytes that a film of `pixels` pixels takes, the tiles' own bookkeeping aside.
    pub(crate) fn bytes(pixels: u64, keep: Keep) -> u64 {
        let stratum = size_of::<Sum>() + if keep.albedo { size_of::<[f64; 3]>() } else { 0 };
        let strata = if keep.lobes { 2 } else { 1 };
        let nearest = if keep.nearest { size_of::<Nearest>() } else { 0 };
        pixels * (strata * stratum + nearest) as u64
    }

    /// The pixels it holds, in the whole picture.
    pub fn window(&self) -> PixelRect {
        self.window
    }

    /// The fewest and the most samples that a pixel has taken; they differ after a cancelled pass.
    pub fn samples(&self) -> (u32, u32) {
        let samples = || self.tiles.iter().map(|tile| tile.samples);
        (samples().min().unwrap_or(0), samples().max().unwrap_or(0))
    }

    /// What it keeps beside one sum of colour.
    pub(crate) fn kept(&self) -> Keep {
        self.keep
    }

    pub(crate) fn tiles(&self) -> &[Tile] {
        &self.tiles
    }

    pub(crate) fn tiles_mut(&mut self) -> &mut [Tile] {
        &mut self.tiles
    }

    /// Integrals of the positive and negative parts of the filter.
    pub(crate) fn masses(&self) -> (f64, f64) {
        self.masses
    }
}

impl Tile {
    fn new(rect: PixelRect, keep: Keep) -> Self {
        let pixels = rect.width() as usize * rect.height() as usize;
        let stratum = || Stratum {
            sums: vec![Sum::default(); pixels],
            albedo: if keep.albedo { vec![[0.0; 3]; pixels] } else { Vec::new() },
        };
        Self {
            rect,
            next_sample: 0,
            samples: 0,
            positive: stratum(),
            negative: if keep.lobes { stratum() } else { Stratum::default() },
            nearest: if keep.nearest { vec![Nearest::NONE; pixels] } else { Vec::new() },
        }
    }

    /// Whether layers need more of a sample than its colour.
    pub(crate) fn keeps_hits(&self) -> bool {
        !self.nearest.is_empty() || !self.positive.albedo.is_empty()
    }

    /// The next samples of a pass that this tile does not hold yet, at most `most`; they count as held from now on.
    pub(crate) fn claim(&mut self, samples: &Range<u32>, most: u32) -> Range<u32> {
        let start = samples.start.max(self.next_sample);
        let new = start..samples.end.min(start.saturating_add(most));
        if !new.is_empty() {
            self.samples += new.end - new.start;
            self.next_sample = new.end;
        }
        new
    }

    /// Adds a sample to pixel `i` of the tile; samples come in rising order.
    pub(crate) fn add(&mut self, i: usize, shot: &Shot) {
        let stratum = if shot.is_negative { &mut self.negative } else { &mut self.positive };
        let sum = &mut stratum.sums[i];
        let rgba = shot.radiance.extend(shot.alpha).as_dvec4().to_array();
        (0..4).for_each(|c| sum.rgba[c] += rgba[c]);
        sum.count += 1;
        if let (Some(sum), Some(hit)) = (stratum.albedo.get_mut(i), &shot.hit) {
            let albedo = hit.albedo.as_dvec3().to_array();
            (0..3).for_each(|c| sum[c] += albedo[c]);
        }
        // Ties go to the sample that came first.
        if let Some(nearest) = self.nearest.get_mut(i).filter(|nearest| shot.distance < nearest.distance) {
            *nearest = Nearest::of(shot);
        }
    }

    /// Red, green, blue and alpha of pixel `i`; zero where no sample is.
    pub(crate) fn rgba(&self, i: usize, masses: (f64, f64)) -> [f32; 4] {
        self.combine(i, masses, |stratum| stratum.sums[i].rgba)
    }

    /// Albedo of pixel `i`; zero where none was kept.
    pub(crate) fn albedo(&self, i: usize, masses: (f64, f64)) -> [f32; 3] {
        self.combine(i, masses, |stratum| stratum.albedo.get(i).copied().unwrap_or_default())
    }

    /// The sample nearest to the centre of pixel `i`.
    pub(crate) fn nearest(&self, i: usize) -> Nearest {
        self.nearest.get(i).copied().unwrap_or(Nearest::NONE)
    }

    /// The two strata of a pixel, each averaged and weighed by its part of the filter.
    ///
    /// While one of them has no sample, early in a render, the other stands for the pixel.
    fn combine<const N: usize>(
        &self,
        i: usize,
        (a, b): (f64, f64),
        sum: impl Fn(&Stratum) -> [f64; N],
    ) -> [f32; N] {
        let mean = |stratum: &Stratum| {
            let count = stratum.sums.get(i).map_or(0, |sum| sum.count);
            (count > 0).then(|| sum(stratum).map(|v| v / f64::from(count)))
        };
        match (mean(&self.positive), mean(&self.negative)) {
            (Some(p), Some(n)) => std::array::from_fn(|c| (a * p[c] - b * n[c]) as f32),
            (Some(only), None) | (None, Some(only)) => only.map(|v| v as f32),
            (None, None) => [0.0; N],
        }
    }
}

/// The tiles of a window, row by row; borders lie on multiples of the tile size in the whole picture.
fn tile_rects(window: PixelRect) -> impl Iterator<Item = PixelRect> {
    let starts = |from: u32, to: u32| (from / TILE..to.div_ceil(TILE)).map(|tile| tile * TILE);
    starts(window.y0, window.y1).flat_map(move |y| {
        starts(window.x0, window.x1).map(move |x| PixelRect {
            x0: x.max(window.x0),
            y0: y.max(window.y0),
            x1: x.saturating_add(TILE).min(window.x1),
            y1: y.saturating_add(TILE).min(window.y1),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::settings::Filter;

    #[test]
    fn tiles_cover_each_pixel_once() {
        for (x0, y0, x1, y1) in
            [(0, 0, 1, 1), (0, 0, 64, 32), (5, 17, 40, 50), (31, 0, 33, 16), (0, 0, 100, 7)]
        {
            let window = PixelRect { x0, y0, x1, y1 };
            let mut seen = vec![0; (window.width() * window.height()) as usize];
            for rect in tile_rects(window) {
                assert!(rect.width() <= TILE && rect.height() <= TILE);
                for (x, y) in (rect.y0..rect.y1).flat_map(|y| (rect.x0..rect.x1).map(move |x| (x, y))) {
                    seen[((y - y0) * window.width() + x - x0) as usize] += 1;
                }
            }
            assert!(seen.iter().all(|&n| n == 1), "{window:?}");
        }
    }

    fn shot(value: f32, is_negative: bool, distance: f32) -> Shot {
        Shot { radiance: Rgb::splat(value), alpha: 1.0, depth: value, hit: None, is_negative, distance }
    }

    fn film(filter: Filter, radius: f32) -> Film {
        let filter = PixelFilter::new(filter, radius, 16);
        let keep = Keep { lobes: filter.has_negative_lobes(), albedo: false, nearest: true };
        Film::new(PixelRect { x0: 0, y0: 0, x1: 1, y1: 1 }, &filter, keep)
    }

    #[test]
    fn strata_are_averaged_apart() {
        let mut film = film(Filter::Lanczos, 3.0);
        let (a, b) = film.masses();
        for (value, is_negative) in [(1.0, false), (3.0, false), (0.5, true)] {
            film.tiles_mut()[0].add(0, &shot(value, is_negative, 0.0));
        }
        let rgba = film.tiles()[0].rgba(0, film.masses());
        let want = (2.0 * a - 0.5 * b) as f32;
        assert_eq!(rgba, [want, want, want, (a - b) as f32]);
    }

    #[test]
    fn a_pixel_with_one_stratum_or_none_is_still_a_mean() {
        let mut film = film(Filter::Lanczos, 3.0);
        assert_eq!(film.tiles()[0].rgba(0, film.masses()), [0.0; 4]);
        film.tiles_mut()[0].add(0, &shot(0.25, true, 0.0));
        assert_eq!(film.tiles()[0].rgba(0, film.masses()), [0.25, 0.25, 0.25, 1.0]);
    }

    #[test]
    fn the_sample_nearest_to_the_centre_wins_and_the_first_of_equals() {
        let mut film = film(Filter::Box, 0.5);
        for (depth, distance) in [(1.0, 0.5), (2.0, 0.25), (3.0, 0.25), (4.0, 0.3)] {
            film.tiles_mut()[0].add(0, &shot(depth, false, distance));
        }
        assert_eq!(film.tiles()[0].nearest(0).depth, 2.0);
    }

    #[test]
    fn samples_are_claimed_once() {
        let mut film = film(Filter::Box, 0.5);
        let tile = &mut film.tiles_mut()[0];
        assert_eq!(tile.claim(&(0..4), 16), 0..4);
        assert!(tile.claim(&(0..4), 16).is_empty());
        assert_eq!(tile.claim(&(2..6), 16), 4..6);
        assert!(tile.claim(&(0..3), 16).is_empty());
        assert_eq!(tile.claim(&(10..14), 3), 10..13);
        assert_eq!(tile.claim(&(10..14), 3), 13..14);
        assert_eq!(tile.claim(&(u32::MAX - 1..u32::MAX), 3), u32::MAX - 1..u32::MAX);
        assert_eq!(film.samples(), (11, 11));
    }
}
