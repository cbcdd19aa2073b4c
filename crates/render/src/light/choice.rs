//! Which of many lights a point asks.

use super::sums;
use glam::Vec3;

/// Share of the choices that are made without regard to power: no light is forgotten, however weak.
const EVEN: f64 = 0.25;

/// Lights by their power.
#[derive(Debug)]
pub(crate) struct LightSampler {
    /// Running sums of the probabilities.
    sums: Vec<f64>,
}

impl LightSampler {
    /// Over lights of these powers, at least 0.
    pub(super) fn new(powers: &[f32]) -> Self {
        let all: f64 = powers.iter().map(|&power| f64::from(power)).sum();
        let even = 1.0 / powers.len() as f64;
        let is_uneven = all > 0.0 && all.is_finite();
        let share = |power: f32| {
            if is_uneven { EVEN * even + (1.0 - EVEN) * f64::from(power) / all } else { even }
        };
        Self { sums: sums::running(powers.iter().map(|&power| share(power))).collect() }
    }

    /// A light for the point `p` of a surface with normal `n`, its probability, and what is left of `u` in `[0, 1)`; `None`
    /// without lights.
    #[inline]
    pub(super) fn pick(&self, _p: Vec3, _n: Vec3, u: f32) -> Option<(usize, f32, f32)> {
        if self.sums.len() < 2 {
            return (!self.sums.is_empty()).then_some((0, 1.0, u));
        }
        let (light, rest) = sums::pick(&self.sums, u);
        Some((light, sums::share(&self.sums, light) as f32, rest))
    }

    /// The probability with which [`Self::pick`] chooses the light.
    #[inline]
    pub(super) fn probability(&self, _p: Vec3, _n: Vec3, light: usize) -> f32 {
        if self.sums.len() < 2 { 1.0 } else { sums::share(&self.sums, light) as f32 }
    }
}
