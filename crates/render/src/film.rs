//! What the pixels have gathered: sums in `f64`, tile by tile.
//!
//! A tile owns its pixels, so that tiles are filled in parallel without locks. Within a pixel samples are added in the order of
//! their index; tiles, threads and the cutting of a render into passes leave no trace in the sums.

mod batches;
pub(crate) mod stopping;
mod tile;

pub(crate) use tile::Tile;

use crate::filter::PixelFilter;
use crate::integrator::FirstHit;
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;
use heliostat_scene::settings::PixelRect;
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};
use stopping::{Measure, Rule};

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
    /// The spread of the samples.
    pub(crate) batches: bool,
    /// Which pixels have enough samples; needs `batches`.
    pub(crate) blocks: bool,
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
        pixels * Tile::bytes(keep) as u64
    }

    /// The pixels it holds, in the whole picture.
    pub fn window(&self) -> PixelRect {
        self.window
    }

    /// The fewest and the most samples that a pixel has in the picture; they differ after a cancelled pass, and where pixels end
    /// at a given noise.
    pub fn samples(&self) -> (u32, u32) {
        let pixels = |tile: &Tile| (0..tile.pixels()).map(|i| tile.used(i)).fold((u32::MAX, 0), widen);
        let range = self.tiles.iter().map(pixels).fold((u32::MAX, 0), |(a, b), (c, d)| (a.min(c), b.max(d)));
        (range.0.min(range.1), range.1)
    }

    /// Samples of a pixel in the picture, on average.
    pub fn mean_samples(&self) -> f64 {
        let (mut sum, mut pixels) = (0_u64, 0_u64);
        for tile in &self.tiles {
            sum += (0..tile.pixels()).map(|i| u64::from(tile.used(i))).sum::<u64>();
            pixels += tile.pixels() as u64;
        }
        sum as f64 / pixels.max(1) as f64
    }

    /// Pixels of its window.
    pub(crate) fn pixels(&self) -> u64 {
        u64::from(self.window.width()) * u64::from(self.window.height())
    }

    /// Pixels of the tiles that want more samples.
    pub fn open_pixels(&self) -> u64 {
        self.tiles.iter().filter(|tile| !tile.is_settled()).map(|tile| tile.pixels() as u64).sum()
    }

    /// Whether no pixel wants any more samples: each has reached the noise that was asked for.
    pub fn is_settled(&self) -> bool {
        self.tiles.iter().all(Tile::is_settled)
    }

    /// The error of a pixel relative to its brightness, as the root of the mean of the squares over all pixels; `None` where it is not
    /// known, because nobody has asked for noise or variance, or because there are too few samples.
    pub(crate) fn error(&self, measure: &Measure) -> Option<f64> {
        let tile = |tile: &Tile| (0..tile.pixels()).map(|i| tile.error(i, measure)).sum::<Option<f64>>();
        // In the order of the tiles, so that the sum does not depend on threads.
        let tiles: Vec<_> = self.tiles.par_iter().map(tile).collect();
        let pixels: usize = self.tiles.iter().map(Tile::pixels).sum();
        let sum = tiles.into_iter().sum::<Option<f64>>()?;
        Some((sum / pixels.max(1) as f64).sqrt())
    }

    /// The samples that all pixels will have taken when they have reached the noise of `rule`, or `most` samples.
    pub(crate) fn forecast(&self, rule: &Rule, most: u32) -> f64 {
        let tiles: Vec<_> = self.tiles.par_iter().map(|tile| tile.forecast(rule, most)).collect();
        tiles.into_iter().sum()
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

fn widen((least, most): (u32, u32), samples: u32) -> (u32, u32) {
    (least.min(samples), most.max(samples))
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
mod tests;
