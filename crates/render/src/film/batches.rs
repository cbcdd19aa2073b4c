//! How far the mean of a pixel may be off, from the spread of the means of a few batches of its samples.
//!
//! The samples of a pixel are stratified among themselves, so their own variance over their number tells too large an error. Each batch
//! is a stratified set of its own, as large as a power of two, and so the spread of batch means knows most of
//! what the strata have gained. As samples come in, batches are joined in pairs: there are 4 to 8 of them at any time.
//!
//! # Source
//! The method of batch means: Conway, "Some Tactical Problems in Digital Simulation", Management Science 1963.

use heliostat_scene::Rgb;

/// Batches, at most.
const MOST: usize = 8;

/// The sums of a few batches of the samples of a pixel, in the order in which they come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Batches {
    sums: [[f32; 3]; MOST],
    /// Samples in all.
    count: u32,
    /// Binary logarithm of the samples in a batch.
    log_size: u32,
}

impl Batches {
    /// No sample yet.
    pub(crate) const EMPTY: Self = Self { sums: [[0.0; 3]; MOST], count: 0, log_size: 0 };

    /// Adds the next sample.
    pub(crate) fn add(&mut self, radiance: Rgb) {
        if self.count >> self.log_size == MOST as u32 {
            self.join();
        }
        let sum = &mut self.sums[(self.count >> self.log_size) as usize];
        let rgb = radiance.to_array();
        (0..3).for_each(|c| sum[c] += rgb[c]);
        self.count += 1;
    }

    /// Samples in all.
    pub(crate) fn count(&self) -> u32 {
        self.count
    }

    /// Batches that are full.
    pub(crate) fn full(&self) -> u32 {
        self.count >> self.log_size
    }

    /// The mean of the full batches.
    pub(crate) fn mean(&self) -> [f64; 3] {
        let samples = f64::from(self.full().max(1) << self.log_size);
        std::array::from_fn(|c| self.sums().map(|sum| f64::from(sum[c])).sum::<f64>() / samples)
    }

    /// The variance of the mean of `used` such samples, per channel; `None` while there are no two batches.
    pub(crate) fn variance(&self, used: u32) -> Option<[f64; 3]> {
        let (full, size) = (f64::from(self.full()), f64::from(1_u32 << self.log_size));
        if self.full() < 2 || used == 0 {
            return None;
        }
        let mean = self.mean();
        let spread = |c: usize| {
            self.sums().map(|sum| (f64::from(sum[c]) / size - mean[c]).powi(2)).sum::<f64>() / (full - 1.0)
        };
        Some(std::array::from_fn(|c| spread(c) * size / f64::from(used)))
    }

    fn sums(&self) -> impl Iterator<Item = &[f32; 3]> {
        self.sums[..self.full() as usize].iter()
    }

    /// Makes one batch of every two.
    fn join(&mut self) {
        for i in 0..MOST / 2 {
            let (a, b) = (self.sums[2 * i], self.sums[2 * i + 1]);
            self.sums[i] = std::array::from_fn(|c| a[c] + b[c]);
        }
        self.sums[MOST / 2..].fill([0.0; 3]);
        self.log_size += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: impl IntoIterator<Item = f32>) -> Batches {
        let mut batches = Batches::EMPTY;
        values.into_iter().for_each(|v| batches.add(Rgb::new(v, 2.0 * v, 0.0)));
        batches
    }

    #[test]
    fn there_are_four_to_eight_batches() {
        for count in 4..1000_u16 {
            let batches = of((0..count).map(f32::from));
            assert!((4..=8).contains(&batches.full()), "{count}: {}", batches.full());
        }
    }

    #[test]
    fn the_spread_of_batches_is_the_variance_of_the_mean() {
        // Batches of two with the means 1, 3, 1, 3, 1, 3, 1, 3: deviation 1 from the mean 2, eight batches.
        let batches = of([0.0, 2.0, 3.0, 3.0].repeat(4));
        assert_eq!(batches.mean(), [2.0, 4.0, 0.0]);
        let variance = batches.variance(16).unwrap();
        // Sum of squares 8 over 7, over 8 batches.
        assert!((variance[0] - 1.0 / 7.0).abs() < 1e-12, "{variance:?}");
        assert!((variance[1] - 4.0 / 7.0).abs() < 1e-12, "{variance:?}");
        assert_eq!(variance[2], 0.0);
        assert!((batches.variance(64).unwrap()[0] - 0.25 / 7.0).abs() < 1e-12);
    }

    #[test]
    fn one_sample_tells_nothing() {
        assert_eq!(of([1.0]).variance(1), None);
        assert_eq!(Batches::EMPTY.variance(1), None);
        assert_eq!(Batches::EMPTY.mean(), [0.0; 3]);
    }
}
