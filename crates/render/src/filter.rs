//! Reconstruction filters by importance sampling: where in the picture a sample of a pixel lies, and what it weighs.
//!
//! Every pixel takes its own samples, distributed like the filter around its centre, and averages them. No
//! sample serves two pixels, so a pixel is the same in a tile, a region and the whole picture, and noise is not smeared.
//!
//! # Negative lobes
//!
//! Mitchell and Lanczos filters subtract. Sampling `|f|` with signed weights leaves the *number* of negative samples to
//! chance, so that even a uniform wall becomes noisy; dividing by the random sum of weights cures that and brings
//! a bias, or a division by zero at 4 samples. Here the sign is a stratum instead: of `N` samples of a pixel a
//! fixed number, in proportion to the integral of the lobes, is negative, evenly spread over the sequence, and each
//! stratum is averaged by itself:
//!
//! `pixel = A mean(positive) - B mean(negative)`, with `A - B = 1` the integral of the filter.
//!
//! A uniform wall keeps its value to the last bits at any number of samples, and the estimate is unbiased from 2
//! samples on. With 1 sample per pixel there is no filter: the sample lies on the centre of the pixel.
//!
//! # Choice
//!
//! A wide filter spreads the samples of a pixel over its neighbours, so it wants more of them: with 4 samples the box is
//! the quietest, from 16 on Blackman-Harris draws the smoothest edges; Mitchell and Lanczos sharpen, and ring.
//!
//! # Source
//! Ernst, Stamminger, Greiner, "Filter Importance Sampling", IRT 2006; Mitchell, Netravali, "Reconstruction Filters in
//! Computer Graphics", SIGGRAPH 1988; Harris, "On the Use of Windows for Harmonic Analysis", Proc. IEEE 1978 (the
//! minimum four-term window); Duchon, "Lanczos Filtering in One and Two Dimensions", J. Appl. Meteorology 1979.

use crate::sampler::{Pattern, branch};
use glam::{DVec2, Vec2};
use heliostat_scene::settings::Filter;
use std::f64::consts::PI;

/// Largest radius in pixels that is accepted; wider ones belong to image processing, not to rendering.
pub const MAX_RADIUS: f32 = 64.0;

/// Cells of a table over the whole width of a filter; per lobe where it has many.
const CELLS: usize = 1024;

/// The value of a filter at distance `x` from its middle, not normalised; 0 beyond `radius`.
///
/// Filters are separable: in the picture the value is the product over both axes.
pub fn value(filter: Filter, radius: f64, x: f64) -> f64 {
    let x = x.abs();
    if x > radius {
        return 0.0;
    }
    match filter {
        Filter::Box => 1.0,
        Filter::Tent => 1.0 - x / radius,
        Filter::Gaussian => gaussian(x, radius),
        Filter::Mitchell => mitchell(2.0 * x / radius),
        Filter::BlackmanHarris => blackman_harris(x / radius),
        Filter::Lanczos => sinc(x) * sinc(x / radius),
    }
}

/// A Gaussian of standard deviation `radius / 3`, lowered so that it ends at 0.
fn gaussian(x: f64, radius: f64) -> f64 {
    let bell = |x: f64| (-0.5 * (3.0 * x / radius).powi(2)).exp();
    bell(x) - bell(radius)
}

/// The cubic of Mitchell and Netravali with B = C = 1/3, over `[0, 2]`.
fn mitchell(x: f64) -> f64 {
    let cubic = |a: f64, b: f64, c: f64, d: f64| (((a * x + b) * x + c) * x + d) / 18.0;
    if x < 1.0 { cubic(21.0, -36.0, 0.0, 16.0) } else { cubic(-7.0, 36.0, -60.0, 32.0) }
}

/// The minimum four-term window, over `[0, 1]`.
fn blackman_harris(x: f64) -> f64 {
    const TERMS: [f64; 4] = [0.35875, 0.48829, 0.14128, 0.01168];
    (0..4).map(|k| TERMS[k] * (PI * k as f64 * x).cos()).sum()
}

/// `sin(pi x) / (pi x)`.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { (PI * x).sin() / (PI * x) }
}

/// Where a sample lies and whether it adds or subtracts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSample {
    /// Distance from the centre of the pixel, in pixels, x to the right and y downward.
    pub offset: DVec2,
    /// Whether the sample belongs to the negative stratum.
    pub is_negative: bool,
}

/// A filter, ready to place the samples of pixels.
#[derive(Clone, Debug)]
pub struct PixelFilter {
    positive: Table,
    /// Absent where the filter is nowhere negative.
    negative: Option<Table>,
    /// Samples per pixel that are planned, and how many of them are negative.
    samples: u32,
    negatives: u32,
}

impl PixelFilter {
    /// A filter of a radius in pixels, above 0 and at most [`MAX_RADIUS`], for `samples` samples per pixel.
    pub fn new(filter: Filter, radius: f32, samples: u32) -> Self {
        let radius = f64::from(radius);
        let cells = match filter {
            Filter::Box => 1,
            Filter::Lanczos => CELLS * radius.ceil() as usize,
            _ => CELLS,
        };
        let part = |sign: f64| Table::new(radius, cells, |x| (sign * value(filter, radius, x)).max(0.0));
        let (positive, negative) = (part(1.0), part(-1.0));
        let has_lobes = negative.integral > 0.0 && samples > 1;
        let mut filter = Self { positive, negative: has_lobes.then_some(negative), samples, negatives: 0 };
        if has_lobes {
            let (a, b) = filter.masses();
            let share = f64::from(samples) * b / (a + b);
            filter.negatives = (share.round() as u32).clamp(1, samples - 1);
        }
        filter
    }

    /// Whether some samples subtract.
    pub fn has_negative_lobes(&self) -> bool {
        self.negative.is_some()
    }

    /// The integrals `(A, B)` of the positive and the negative part over the picture; `A - B = 1`.
    pub fn masses(&self) -> (f64, f64) {
        let Some(negative) = &self.negative else { return (1.0, 0.0) };
        let (p, n) = (self.positive.integral, negative.integral);
        // Along an axis the normalised filter is p / (p - n) minus n / (p - n); like signs multiply to positive ones.
        let whole = (p - n) * (p - n);
        ((p * p + n * n) / whole, 2.0 * p * n / whole)
    }

    /// Where sample `sample` of the pixel at column `pixel[0]`, row `pixel[1]` lies.
    pub fn sample(&self, pattern: &Pattern, pixel: [u32; 2], sample: u32) -> FilmSample {
        if self.samples <= 1 {
            return FilmSample { offset: DVec2::ZERO, is_negative: false };
        }
        // Each stratum runs through its own sequence, so that each is stratified in itself.
        let (before, is_negative) = self.negatives_before(sample);
        let (index, stratum) =
            if is_negative { (before, branch::NEGATIVE) } else { (sample - before, branch::POSITIVE) };
        let u = pattern.sampler(pixel, index).fork(stratum).next_2d();
        FilmSample { offset: self.place(u, is_negative), is_negative }
    }

    /// How many samples before `sample` are negative, and whether it is: as evenly spread as integers can be.
    fn negatives_before(&self, sample: u32) -> (u32, bool) {
        let (samples, negatives) = (u64::from(self.samples), u64::from(self.negatives));
        let up_to = |sample: u64| ((sample * negatives + samples / 2) / samples) as u32;
        let before = up_to(u64::from(sample));
        (before, up_to(u64::from(sample) + 1) > before)
    }

    /// The offset for a point of the unit square within one stratum.
    fn place(&self, u: Vec2, is_negative: bool) -> DVec2 {
        let u = u.as_dvec2();
        let Some(negative) = &self.negative else {
            return DVec2::new(self.positive.sample(u.x), self.positive.sample(u.y));
        };
        let (p, n) = (self.positive.integral, negative.integral);
        // Choose the pair of signs by u.x and stretch what is left of it to the unit interval.
        let (first, x_tables, y_tables) = if is_negative {
            (0.5, [negative, &self.positive], [&self.positive, negative])
        } else {
            (n * n / (n * n + p * p), [negative, &self.positive], [negative, &self.positive])
        };
        let (pair, x) = if u.x < first { (0, u.x / first) } else { (1, (u.x - first) / (1.0 - first)) };
        DVec2::new(x_tables[pair].sample(x), y_tables[pair].sample(u.y))
    }
}

/// A density over `[-radius, radius]`, linear between the borders of even cells, with its cumulative integral.
#[derive(Clone, Debug)]
struct Table {
    radius: f64,
    /// Density at the borders of the cells.
    density: Vec<f64>,
    /// Integral of the density up to each border.
    cumulative: Vec<f64>,
    /// Integral of all of it.
    integral: f64,
}

impl Table {
    fn new(radius: f64, cells: usize, density: impl Fn(f64) -> f64) -> Self {
        let width = 2.0 * radius / cells as f64;
        // An even number of cells puts a border on 0 exactly; the ends are exact too.
        let border = |i: usize| radius * (2.0 * i as f64 / cells as f64 - 1.0);
        let density: Vec<f64> = (0..=cells).map(|i| density(border(i))).collect();
        let mut cumulative = vec![0.0; cells + 1];
        for i in 0..cells {
            cumulative[i + 1] = cumulative[i] + 0.5 * width * (density[i] + density[i + 1]);
        }
        let integral = cumulative[cells];
        Self { radius, density, cumulative, integral }
    }

    /// The inverse of the cumulative integral at `u` in `[0, 1]`; monotone in `u`.
    fn sample(&self, u: f64) -> f64 {
        let cells = self.density.len() - 1;
        let target = u * self.integral;
        let cell = self.cumulative[1..cells].partition_point(|&c| c <= target);
        let (a, b) = (self.density[cell], self.density[cell + 1]);
        let mass = self.cumulative[cell + 1] - self.cumulative[cell];
        let rest = if mass > 0.0 { ((target - self.cumulative[cell]) / mass).clamp(0.0, 1.0) } else { 0.0 };
        // Solve a t + (b - a) t^2 / 2 = rest (a + b) / 2 in the form that does not cancel.
        let divisor = a + (a * a + rest * (b * b - a * a)).sqrt();
        let t = if divisor > 0.0 { (rest * (a + b) / divisor).min(1.0) } else { 0.0 };
        self.radius * (2.0 * (cell as f64 + t) / cells as f64 - 1.0)
    }
}

#[cfg(test)]
mod tests;
