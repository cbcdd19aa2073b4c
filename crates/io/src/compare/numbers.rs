//! Errors in numbers: of the colours of two pictures, and of every channel of two frames.

use crate::picture::Picture;
use glam::Vec4;
use heliostat_scene::frame::Frame;

/// Errors of red, green and blue over all pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Numbers {
    /// Root of the mean square error.
    pub rmse: f64,
    /// Mean of the square error relative to the square of the reference plus 0.01.
    ///
    /// # Source
    /// F. Rousselle, C. Knaus, M. Zwicker, "Adaptive Sampling and Reconstruction using Greedy Error Minimization", 2011.
    pub rel_mse: f64,
    /// Largest error of a channel.
    pub max: f64,
    /// Column and row of the first pixel that has it.
    pub max_at: [u32; 2],
    /// Largest error of alpha.
    pub max_alpha: f64,
    /// Pixels that differ in any channel, alpha included.
    pub differing: u64,
    /// Pixels that are NaN or infinite in one picture and not the same in the other: all errors are infinite.
    pub broken: u64,
}

/// Whether one of two pixels is not finite and they are not the same.
pub(super) fn is_broken(a: Vec4, b: Vec4) -> bool {
    (0..4).any(|i| !(a[i] - b[i]).is_finite() && !same(a[i], b[i]))
}

/// Equal, or both NaN.
fn same(a: f32, b: f32) -> bool {
    a == b || (a.is_nan() && b.is_nan())
}

/// The distance of two values: 0 for equal ones (NaN, infinity too), infinite where it has no number.
fn distance(a: f32, b: f32) -> f64 {
    let distance = (f64::from(a) - f64::from(b)).abs();
    match same(a, b) {
        true => 0.0,
        false if distance.is_nan() => f64::INFINITY,
        false => distance,
    }
}

impl Numbers {
    /// Of two pictures of the same size.
    pub(super) fn of(reference: &Picture, test: &Picture) -> Self {
        const RELATIVE_FLOOR: f64 = 0.01;
        let mut numbers = Self::default();
        let [mut squares, mut relative] = [0.0_f64; 2];
        for (i, (a, b)) in reference.pixels.iter().zip(&test.pixels).enumerate() {
            let errors: [f64; 4] = std::array::from_fn(|c| distance(a[c], b[c]));
            for (c, error) in errors[..3].iter().enumerate() {
                let reference = f64::from(a[c]);
                squares += error * error;
                // 0 over infinity and the like: where the error is 0 nothing is added.
                if *error > 0.0 {
                    relative += error * error / (reference * reference + RELATIVE_FLOOR);
                }
                if *error > numbers.max {
                    numbers.max = *error;
                    numbers.max_at = [i as u32 % test.width, i as u32 / test.width];
                }
            }
            numbers.max_alpha = numbers.max_alpha.max(errors[3]);
            numbers.differing += u64::from(errors.iter().any(|e| *e > 0.0));
            numbers.broken += u64::from(is_broken(*a, *b));
        }
        let count = 3.0 * reference.pixels.len() as f64;
        numbers.rmse = (squares / count).sqrt();
        numbers.rel_mse = if numbers.broken > 0 { f64::INFINITY } else { relative / count };
        numbers
    }
}

/// Errors of one channel of two frames.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelNumbers {
    /// Name of the channel.
    pub name: String,
    /// Root of the mean square error.
    pub rmse: f64,
    /// Largest error; infinite where one value is not finite and they are not the same.
    pub max: f64,
    /// Values that differ.
    pub differing: u64,
}

/// Errors of every channel that both frames have, in the order of the reference.
///
/// # Errors
/// With a sentence, when the frames differ in size or window, or one has a channel that the other has not.
pub fn compare_channels(reference: &Frame, test: &Frame) -> Result<Vec<ChannelNumbers>, String> {
    if (reference.width, reference.height, reference.window) != (test.width, test.height, test.window) {
        return Err(format!(
            "{} x {} pixels with {:?} and {} x {} pixels with {:?}",
            reference.width, reference.height, reference.window, test.width, test.height, test.window
        ));
    }
    let missing = |from: &Frame, names: &Frame| -> Vec<String> {
        let absent = names.channels.iter().filter(|c| from.channel(&c.name).is_none());
        absent.map(|c| c.name.clone()).collect()
    };
    match (missing(test, reference), missing(reference, test)) {
        (a, b) if a.is_empty() && b.is_empty() => {}
        (a, b) => return Err(format!("channels in one alone: {}", [a, b].concat().join(", "))),
    }
    let pairs = reference.channels.iter().filter_map(|a| Some((a, test.channel(&a.name)?)));
    Ok(pairs.map(|(a, b)| channel_numbers(&a.name, &a.values, &b.values)).collect())
}

fn channel_numbers(name: &str, reference: &[f32], test: &[f32]) -> ChannelNumbers {
    let errors = || reference.iter().zip(test).map(|(a, b)| distance(*a, *b));
    let squares = errors().map(|e| e * e).sum::<f64>();
    ChannelNumbers {
        name: name.to_owned(),
        rmse: (squares / reference.len().max(1) as f64).sqrt(),
        max: errors().fold(0.0, f64::max),
        differing: errors().filter(|e| *e > 0.0).count() as u64,
    }
}
