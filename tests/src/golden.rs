//! Golden pictures by statistics: a mean and a variance per pixel, and a Z-test against them.
//!
//! A golden picture is the mean of many independent renderings of the same scene, with the variance between them. A
//! new rendering passes when its pixels scatter around the mean as the old ones did: so a picture may change its noise,
//! but not what it converges to.
//!
//! # Source
//! Subr and Arvo, "Statistical Hypothesis Testing for Assessing Monte Carlo Estimators", 2007; Mitsuba 3's render tests.

use crate::scenes;
use heliostat_scene::Frame;
use heliostat_scene::frame::{Channel, Depth};
use std::path::PathBuf;

/// Size of a golden picture.
pub const SIZE: [u32; 2] = [96, 54];
/// Samples per pixel of each rendering.
pub const SAMPLES: u32 = 16;
/// Independent renderings behind a golden picture.
pub const BATCHES: u32 = 32;
/// Seed of the first rendering of a golden picture; tests use lower ones.
const FIRST_SEED: u64 = 1000;

/// Scenes with a golden picture, by name: each shows another part of the renderer.
pub const NAMES: [&str; 8] = [
    "fig02_phong",
    "fig03_reflection",
    "fig03_refraction",
    "fig04_total_internal_reflection",
    "fig05_soft_shadow",
    "fig07_textures",
    "fig11_mixed",
    "lights",
];

/// Channels that are compared.
const COLORS: [&str; 3] = ["R", "G", "B"];

/// Where the golden picture of a scene lies.
pub fn path(name: &str) -> PathBuf {
    scenes::root().join("tests/golden").join(format!("{name}.exr"))
}

/// One rendering of a scene by name.
///
/// # Errors
/// The message of the loader or the renderer.
pub fn rendering(name: &str, seed: u64) -> Result<Frame, String> {
    let scene = scenes::root().join("scenes").join(format!("{name}.toml"));
    // The test takes the errors of pixels for independent.
    scenes::render_with(&scene, SIZE, SAMPLES, seed, &[("render.sampler", "\"white\"".to_owned())])
}

/// Renders a golden picture: channels `R`, `variance.R` and so on.
///
/// # Errors
/// The message of the loader or the renderer.
pub fn make(name: &str) -> Result<Frame, String> {
    let first = rendering(name, FIRST_SEED)?;
    let mut sums = COLORS.map(|_| vec![[0.0_f64; 2]; first.pixel_count()]);
    for batch in 0..BATCHES {
        let frame = rendering(name, FIRST_SEED + u64::from(batch))?;
        for (color, sum) in COLORS.iter().zip(&mut sums) {
            for (value, [s, s2]) in values(&frame, color)?.iter().zip(sum.iter_mut()) {
                *s += f64::from(*value);
                *s2 += f64::from(*value).powi(2);
            }
        }
    }
    let n = f64::from(BATCHES);
    let mut channels = Vec::new();
    for (color, sum) in COLORS.iter().zip(&sums) {
        let mean = sum.iter().map(|[s, _]| (s / n) as f32).collect();
        let variance = sum.iter().map(|[s, s2]| ((s2 - s * s / n).max(0.0) / (n - 1.0)) as f32).collect();
        channels.push(Channel { name: (*color).to_owned(), depth: Depth::Float, values: mean });
        channels.push(Channel { name: format!("variance.{color}"), depth: Depth::Float, values: variance });
    }
    Ok(Frame { channels, meta: std::collections::BTreeMap::new(), ..first })
}

/// How a rendering compares with its golden picture.
#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    /// Part of the pixel values that pass the test at 1 % (with Sidak's correction for their number).
    pub passing: f64,
    /// Z of the mean of the whole picture; a bias shows here first.
    pub mean_z: f64,
}

impl Verdict {
    /// Whether the rendering is the same picture.
    pub fn is_pass(&self) -> bool {
        self.passing >= 0.9975 && self.mean_z.abs() < 4.0
    }
}

/// Compares a rendering with a golden picture of the same size.
///
/// # Errors
/// When a channel is missing.
pub fn compare(golden: &Frame, frame: &Frame) -> Result<Verdict, String> {
    let count = 3 * frame.pixel_count();
    // Sidak: each of n tests at 1 - (1 - alpha)^(1/n) makes the family a test at alpha.
    let alpha = 1.0 - 0.99_f64.powf(1.0 / count as f64);
    let (mut passing, mut difference, mut spread) = (0_usize, 0.0, 0.0);
    for color in COLORS {
        let variances = values(golden, &format!("variance.{color}"))?;
        let means = values(golden, color)?;
        for ((value, mean), variance) in values(frame, color)?.iter().zip(means).zip(variances) {
            let delta = f64::from(value - mean);
            // Pixels without noise still round: half floats hold 11 bits.
            let rounding = (f64::from(*mean) / 2048.0).powi(2);
            let variance = f64::from(*variance) * (1.0 + 1.0 / f64::from(BATCHES)) + rounding;
            let z = delta / variance.sqrt().max(f64::MIN_POSITIVE);
            passing += usize::from(delta == 0.0 || two_sided_p(z) > alpha);
            difference += delta;
            spread += variance;
        }
    }
    Ok(Verdict { passing: passing as f64 / count as f64, mean_z: difference / spread.sqrt() })
}

/// Probability that a standard normal lies farther from 0 than `z`.
///
/// # Source
/// Abramowitz and Stegun, 7.1.26 for the error function, with the Mills ratio where that runs out of digits.
fn two_sided_p(z: f64) -> f64 {
    let x = z.abs() / std::f64::consts::SQRT_2;
    if x > 2.5 {
        return (-x * x).exp() / (x * std::f64::consts::PI.sqrt()) * (1.0 - 0.5 / (x * x));
    }
    let t = 1.0 / (1.0 + 0.327_591_1 * x);
    let polynomial = t
        * (0.254_829_592
            + t * (-0.284_496_736 + t * (1.421_413_741 + t * (-1.453_152_027 + t * 1.061_405_429))));
    polynomial * (-x * x).exp()
}

fn values<'f>(frame: &'f Frame, name: &str) -> Result<&'f [f32], String> {
    frame.channel(name).map(|c| &c.values[..]).ok_or_else(|| format!("no channel `{name}`"))
}

#[cfg(test)]
mod tests {
    use super::two_sided_p;

    #[test]
    fn tails_of_the_normal_distribution() {
        // Textbook quantiles.
        for (z, p) in [(0.0, 1.0), (1.0, 0.317_31), (1.959_964, 0.05), (2.575_829, 0.01), (4.891_638, 1.0e-6)]
        {
            assert!((two_sided_p(z) - p).abs() < 0.02 * p + 1e-6, "z = {z}");
        }
    }
}
