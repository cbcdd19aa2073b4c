//! When a pixel has enough samples, without a bias.
//!
//! # Why it is not simple
//! A pixel that stops once its own samples look calm keeps the calm ones: where a bright path is rare, pixels that have missed it
//! stop, those that have met it go on and thin it out, and the mean is too dark. So the number of samples of a
//! pixel must not depend on their values. Asking the neighbours alone does not help yet, for the neighbours had asked
//! the pixel in turn how far they should go.
//!
//! # The rule
//! The picture is cut into blocks of 8 x 8 pixels, and each block into the two colours of a chessboard. At fixed numbers of samples,
//! `n_1 < n_2 < ..`, each colour is looked at. Let `E_k(white)` be the error of the white pixels after their first `n_k`
//! samples, whether or not all of these are used. Then
//!
//! - the black pixels end with `T(black) = min { n_k : E_k(white) <= target }` samples, the white ones likewise;
//! - while either colour is open, samples are taken of both: those of a colour that has ended are only looked at, for the sake of
//!   the other, and never enter the picture.
//!
//! So `T(black)` is a function of the samples of white pixels alone, of a sequence fixed beforehand: it does not matter where white
//! itself has ended. The samples of different pixels are independent, hence the mean of the first
//! `T(black)` samples of a black pixel has the expectation of any one of them. Both colours see the same part of the picture, so
//! that they mostly end together, and little is thrown away.
//!
//! Blocks lie on multiples of 8 in the whole picture, so that regions, tiles and threads leave no trace. Where a block has pixels of one
//! colour alone, at the border of a picture one pixel wide, nobody can be asked, and they take all samples.
//!
//! # Source
//! The bias: Kirk, Arvo, "Unbiased Sampling Techniques for Image Synthesis", SIGGRAPH 1991, who draw a pilot and throw it away.
//! Here either half is the pilot of the other.

use heliostat_scene::RenderSettings;

/// Side of a block in pixels; divides the side of a tile.
pub(crate) const BLOCK: u32 = 8;

/// Fewer batches than this are not asked for an error.
pub(super) const LEAST_BATCHES: u32 = 4;

/// The error at which a pixel has enough samples, and when it is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rule {
    /// Error relative to the pixel's brightness.
    target: f64,
    measure: Measure,
    /// Samples before the first look.
    least: u32,
}

/// How an error is weighed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Measure {
    /// What is darker counts as bright as this.
    floor: f64,
    /// Integrals of the positive and negative parts of the filter.
    pub(super) masses: (f64, f64),
}

impl Measure {
    pub(crate) fn new(settings: &RenderSettings, masses: (f64, f64)) -> Self {
        Self { floor: f64::from(settings.noise_floor), masses }
    }

    /// The squared error relative to the brightness, from mean and variance by channel.
    pub(super) fn relative(&self, mean: [f64; 3], variance: [f64; 3]) -> f64 {
        let (mean, variance) = (mean.iter().sum::<f64>() / 3.0, variance.iter().sum::<f64>() / 3.0);
        variance / mean.max(self.floor).powi(2)
    }
}

impl Rule {
    /// The rule of settings that ask for one.
    pub(crate) fn new(settings: &RenderSettings, masses: (f64, f64)) -> Option<Self> {
        let target = f64::from(settings.noise?);
        let measure = Measure::new(settings, masses);
        Some(Self { target, measure, least: settings.samples.max(LEAST_BATCHES) })
    }

    pub(super) fn measure(&self) -> &Measure {
        &self.measure
    }

    /// Whether a squared error is small enough.
    pub(super) fn allows(&self, squared: f64) -> bool {
        squared <= self.target * self.target
    }

    /// The samples that an error by `samples` samples asks for in the end.
    pub(super) fn needed(&self, squared: f64, samples: u32) -> f64 {
        f64::from(samples) * squared / (self.target * self.target)
    }

    /// The first look after `samples` samples: at 2, 3, 4, 6, 8, 12, .. times half of the least number.
    pub(crate) fn next_look(&self, samples: u32) -> u32 {
        let mut look = self.least;
        loop {
            if look > samples {
                return look;
            }
            let between = look.saturating_add(look / 2);
            if between > samples {
                return between;
            }
            look = look.saturating_mul(2);
            if look == u32::MAX {
                return look;
            }
        }
    }
}

/// The two colours of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    /// Samples with which each colour has ended.
    ends: [Option<u32>; 2],
}

/// What a further sample of a pixel is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Use {
    /// It enters the picture, and is looked at.
    Kept,
    /// It is looked at for the sake of other pixels.
    Seen,
    /// Nobody wants it.
    None,
}

impl Block {
    /// Both colours want samples.
    pub(super) const OPEN: Self = Self { ends: [None; 2] };

    /// What a further sample of a pixel of that colour is for.
    pub(super) fn purpose(&self, colour: usize) -> Use {
        match (self.ends[colour], self.ends[1 - colour]) {
            (None, _) => Use::Kept,
            (Some(_), None) => Use::Seen,
            (Some(_), Some(_)) => Use::None,
        }
    }

    pub(super) fn is_open(&self) -> bool {
        self.ends.contains(&None)
    }

    /// The samples that a pixel of that colour uses when its tile has taken so many.
    pub(super) fn used(&self, colour: usize, taken: u32) -> u32 {
        self.ends[colour].unwrap_or(taken)
    }

    /// Ends the colours whose opposite has little enough error; `errors` are squared, `None` where nothing is known.
    pub(super) fn look(&mut self, rule: &Rule, errors: [Option<f64>; 2], samples: u32) {
        for (colour, end) in self.ends.iter_mut().enumerate() {
            let opposite = errors[1 - colour];
            if end.is_none() && opposite.is_some_and(|error| rule.allows(error)) {
                *end = Some(samples);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(least: u32) -> Rule {
        let settings = RenderSettings {
            noise: Some(0.1),
            noise_floor: 0.5,
            samples: least,
            ..RenderSettings::default()
        };
        Rule::new(&settings, (1.0, 0.0)).unwrap()
    }

    #[test]
    fn looks_grow_by_a_half_or_a_third() {
        let looks = |least, count| {
            std::iter::successors(Some(rule(least).next_look(0)), |&n| Some(rule(least).next_look(n)))
                .take(count)
                .collect::<Vec<_>>()
        };
        assert_eq!(looks(16, 7), [16, 24, 32, 48, 64, 96, 128]);
        assert_eq!(looks(5, 5), [5, 7, 10, 15, 20]);
        assert_eq!(looks(1, 3), [4, 6, 8]);
        assert_eq!(rule(16).next_look(u32::MAX - 1), u32::MAX);
        assert_eq!(rule(16).next_look(20), 24);
    }

    #[test]
    fn a_colour_ends_by_the_error_of_the_other() {
        let rule = rule(16);
        let mut block = Block::OPEN;
        block.look(&rule, [Some(0.02), None], 16);
        assert_eq!(block, Block::OPEN);
        // The first colour is calm: the second ends, and its samples are only looked at.
        block.look(&rule, [Some(0.01), Some(0.02)], 24);
        assert_eq!((block.purpose(0), block.purpose(1)), (Use::Kept, Use::Seen));
        assert_eq!((block.used(0, 32), block.used(1, 32)), (32, 24));
        block.look(&rule, [Some(0.02), Some(0.01)], 32);
        assert_eq!((block.purpose(0), block.purpose(1)), (Use::None, Use::None));
        assert!(!block.is_open());
        assert_eq!((block.used(0, 48), block.used(1, 48)), (32, 24));
    }

    #[test]
    fn errors_are_relative_and_black_ones_are_not() {
        let measure = *rule(16).measure();
        assert_eq!(measure.relative([2.0; 3], [0.04; 3]), 0.01);
        assert_eq!(measure.relative([0.0; 3], [0.0025; 3]), 0.01);
        assert!((rule(16).needed(0.04, 16) - 64.0).abs() < 1e-3);
    }
}
