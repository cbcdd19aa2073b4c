//! A few hundred pixels of a film.

use super::batches::Batches;
use super::stopping::{BLOCK, Block, LEAST_BATCHES, Measure, Rule, Use};
use super::{Keep, Nearest, Shot};
use heliostat_scene::settings::PixelRect;
use std::ops::Range;

/// A few hundred pixels of a film.
#[derive(Clone, Debug)]
pub(crate) struct Tile {
    pub(crate) rect: PixelRect,
    /// Sample that follows the last one held; samples are added in rising order.
    next_sample: u32,
    /// Samples that each pixel has taken, where it has not ended before.
    samples: u32,
    /// Which pixels have enough, block by block; empty where all take the same number.
    blocks: Vec<Block>,
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
    /// Of all samples taken, kept or not; empty unless asked for.
    batches: Vec<Batches>,
}

/// Sum of radiance and alpha, and the number of samples in it.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    rgba: [f64; 4],
    count: u32,
}

impl Stratum {
    fn new(pixels: usize, keep: Keep) -> Self {
        Self {
            sums: vec![Sum::default(); pixels],
            albedo: if keep.albedo { vec![[0.0; 3]; pixels] } else { Vec::new() },
            batches: if keep.batches { vec![Batches::EMPTY; pixels] } else { Vec::new() },
        }
    }

    /// Bytes of a pixel.
    fn bytes(keep: Keep) -> usize {
        let albedo = if keep.albedo { size_of::<[f64; 3]>() } else { 0 };
        let batches = if keep.batches { size_of::<Batches>() } else { 0 };
        size_of::<Sum>() + albedo + batches
    }

    /// The variance of the mean of pixel `i`; `None` while it is not known, 0 without samples.
    fn variance(&self, i: usize) -> Option<[f64; 3]> {
        let count = self.sums.get(i).map_or(0, |sum| sum.count);
        if count == 0 {
            return Some([0.0; 3]);
        }
        self.batches.get(i).and_then(|batches| batches.variance(count))
    }
}

impl Tile {
    pub(super) fn new(rect: PixelRect, keep: Keep) -> Self {
        let pixels = rect.width() as usize * rect.height() as usize;
        let blocks = rect.width().div_ceil(BLOCK) * rect.height().div_ceil(BLOCK);
        Self {
            rect,
            next_sample: 0,
            samples: 0,
            blocks: if keep.blocks { vec![Block::OPEN; blocks as usize] } else { Vec::new() },
            positive: Stratum::new(pixels, keep),
            negative: if keep.lobes { Stratum::new(pixels, keep) } else { Stratum::default() },
            nearest: if keep.nearest { vec![Nearest::NONE; pixels] } else { Vec::new() },
        }
    }

    /// Bytes of a pixel.
    pub(super) fn bytes(keep: Keep) -> usize {
        let strata = if keep.lobes { 2 } else { 1 };
        strata * Stratum::bytes(keep) + if keep.nearest { size_of::<Nearest>() } else { 0 }
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

    /// How many pixels it has.
    pub(crate) fn pixels(&self) -> usize {
        self.positive.sums.len()
    }

    /// Samples that each pixel has taken, where it has not ended before.
    pub(crate) fn samples(&self) -> u32 {
        self.samples
    }

    /// Whether no pixel wants any more samples.
    pub(crate) fn is_settled(&self) -> bool {
        !self.blocks.is_empty() && !self.blocks.iter().any(Block::is_open)
    }

    /// What a further sample of pixel `i` is for.
    pub(crate) fn purpose(&self, i: usize) -> Use {
        if self.blocks.is_empty() {
            return Use::Kept;
        }
        let (block, colour) = self.block_of(i);
        self.blocks[block].purpose(colour)
    }

    /// The samples that pixel `i` has in the picture.
    pub(super) fn used(&self, i: usize) -> u32 {
        if self.blocks.is_empty() {
            return self.samples;
        }
        let (block, colour) = self.block_of(i);
        self.blocks[block].used(colour, self.samples)
    }

    /// The block of pixel `i`, and which colour of the chessboard it has.
    fn block_of(&self, i: usize) -> (usize, usize) {
        let (width, i) = (self.rect.width(), i as u32);
        let (x, y) = (i % width, i / width);
        let block = y / BLOCK * width.div_ceil(BLOCK) + x / BLOCK;
        (block as usize, ((self.rect.x0 + x + self.rect.y0 + y) % 2) as usize)
    }

    /// Adds a sample to pixel `i` of the tile; samples come in rising order.
    pub(crate) fn add(&mut self, i: usize, shot: &Shot, purpose: Use) {
        let stratum = if shot.is_negative { &mut self.negative } else { &mut self.positive };
        if let Some(batches) = stratum.batches.get_mut(i) {
            batches.add(shot.radiance);
        }
        if purpose != Use::Kept {
            return;
        }
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

    /// Ends the pixels that have enough samples; called at the looks of the rule.
    pub(crate) fn look(&mut self, rule: &Rule) {
        let errors = self.errors(rule);
        for (block, errors) in self.blocks.iter_mut().zip(errors) {
            block.look(rule, errors, self.samples);
        }
    }

    /// The mean squared error of either colour of each block by all samples taken; `None` where it is not known.
    fn errors(&self, rule: &Rule) -> Vec<[Option<f64>; 2]> {
        let mut sums = vec![[(Some(0.0), 0_u32); 2]; self.blocks.len()];
        for i in 0..self.pixels() {
            let (block, colour) = self.block_of(i);
            if self.blocks[block].is_open() {
                let (sum, count) = &mut sums[block][colour];
                *sum = sum.and_then(|sum: f64| Some(sum + self.error_of_all(i, rule.measure())?));
                *count += 1;
            }
        }
        let mean = |(sum, count): (Option<f64>, u32)| sum.filter(|_| count > 0).map(|s| s / f64::from(count));
        sums.into_iter().map(|colours| colours.map(mean)).collect()
    }

    /// The squared error of pixel `i` if it used all samples taken; `None` while there are too few.
    fn error_of_all(&self, i: usize, measure: &Measure) -> Option<f64> {
        let known = |stratum: &Stratum| {
            let Some(batches) = stratum.batches.get(i) else { return Some(([0.0; 3], [0.0; 3])) };
            let enough = batches.full() >= LEAST_BATCHES;
            let variance = if enough { batches.variance(batches.count()) } else { None };
            Some((batches.mean(), variance?))
        };
        let ((p, pv), (n, nv)) = (known(&self.positive)?, known(&self.negative)?);
        let (a, b) = measure.masses;
        let mean = std::array::from_fn(|c| a * p[c] - b * n[c]);
        Some(measure.relative(mean, std::array::from_fn(|c| a * a * pv[c] + b * b * nv[c])))
    }

    /// The squared error of pixel `i` as it is in the picture, relative to its brightness; `None` while it is not known.
    pub(super) fn error(&self, i: usize, measure: &Measure) -> Option<f64> {
        let rgba = self.rgba(i, measure.masses);
        let mean = std::array::from_fn(|c| f64::from(rgba[c]));
        Some(measure.relative(mean, self.variance(i, measure.masses)?))
    }

    /// The samples that the pixels will have taken when all have ended.
    pub(super) fn forecast(&self, rule: &Rule, most: u32) -> f64 {
        let errors = self.errors(rule);
        let pixel = |i: usize| {
            let (block, colour) = self.block_of(i);
            let taken = self.taken(i);
            if !self.blocks[block].is_open() {
                return taken;
            }
            let needed = errors[block][1 - colour].map_or(0.0, |error| rule.needed(error, self.samples));
            needed.clamp(taken, f64::from(most.max(self.samples)))
        };
        (0..self.pixels()).map(pixel).sum()
    }

    /// The samples that pixel `i` has taken, those that are only looked at included.
    fn taken(&self, i: usize) -> f64 {
        let count = |stratum: &Stratum| stratum.batches.get(i).map_or(0, Batches::count);
        f64::from(count(&self.positive)) + f64::from(count(&self.negative))
    }

    /// Red, green, blue and alpha of pixel `i`; zero where no sample is.
    pub(crate) fn rgba(&self, i: usize, masses: (f64, f64)) -> [f32; 4] {
        self.combine(i, masses, |stratum| stratum.sums[i].rgba)
    }

    /// Albedo of pixel `i`; zero where none was kept.
    pub(crate) fn albedo(&self, i: usize, masses: (f64, f64)) -> [f32; 3] {
        self.combine(i, masses, |stratum| stratum.albedo.get(i).copied().unwrap_or_default())
    }

    /// Variance of red, green and blue of pixel `i`; `None` while it is not known.
    pub(crate) fn variance(&self, i: usize, (a, b): (f64, f64)) -> Option<[f64; 3]> {
        let (p, n) = (self.positive.variance(i)?, self.negative.variance(i)?);
        Some(match (self.count(&self.positive, i), self.count(&self.negative, i)) {
            (0, 0) => return None,
            (_, 0) => p,
            (0, _) => n,
            _ => std::array::from_fn(|c| a * a * p[c] + b * b * n[c]),
        })
    }

    /// The samples in the picture of pixel `i`, those left out because a number in them was none not counted.
    pub(crate) fn sample_count(&self, i: usize) -> u32 {
        self.count(&self.positive, i) + self.count(&self.negative, i)
    }

    fn count(&self, stratum: &Stratum, i: usize) -> u32 {
        stratum.sums.get(i).map_or(0, |sum| sum.count)
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
