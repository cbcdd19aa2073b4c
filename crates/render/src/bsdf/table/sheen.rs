//! How much light standing fibres send back.

use super::chebyshev::{series, sum};
use super::stored::{COS, FIBRES, SHEEN};
use crate::bsdf::sheen::roughness_axis;

/// Share of the light that white fibres send to a viewer, by the angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SheenAlbedo([f32; COS]);

/// Angles at which the brightest one is looked for.
const LOOKS: u32 = 32;

impl SheenAlbedo {
    /// For a roughness in `[0, 1]`.
    pub(crate) fn new(roughness: f32) -> Self {
        Self(series(&SHEEN.at::<FIBRES, COS>(roughness_axis(roughness))))
    }

    /// At an angle of cosine `cos`.
    pub(crate) fn at(&self, cos: f32) -> f32 {
        sum(&self.0, cos.clamp(0.0, 1.0).sqrt()).max(0.0)
    }

    /// By which the fibres are made darker, so that they send back no more than all light from any angle.
    pub(crate) fn scale(&self) -> f32 {
        let brightest = (0..=LOOKS).map(|k| self.at((k as f32 / LOOKS as f32).powi(2)));
        1.0 / brightest.fold(1.0, f32::max)
    }
}
