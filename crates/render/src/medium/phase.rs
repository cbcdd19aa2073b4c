//! Into which directions a medium scatters light.
//!
//! # Source
//! Henyey, Greenstein, "Diffuse radiation in the galaxy", Astrophysical Journal 93, 1941; Pharr, Jakob, Humphreys, "Physically
//! Based Rendering", 4th edition, section 11.3.1.

use glam::{Vec2, Vec3};
use heliostat_geometry::OrthonormalFrame;
use heliostat_geometry::warp::SPHERE_PDF;
use std::f32::consts::TAU;

/// The phase function of Henyey and Greenstein.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Phase {
    /// Mean cosine of the angle.
    g: f32,
}

impl Phase {
    /// `g` lies above -1 and below 1.
    pub(crate) fn new(g: f32) -> Self {
        Self { g }
    }

    /// The density by solid angle with which light that flies along the unit vector `dir` goes on along `to`: the same for light
    /// on its way and for a path against it.
    #[inline]
    pub(crate) fn density(&self, dir: Vec3, to: Vec3) -> f32 {
        let g = self.g;
        let spread = (1.0 + g * g - 2.0 * g * dir.dot(to)).max(f32::MIN_POSITIVE);
        SPHERE_PDF * (1.0 - g * g) / (spread * spread.sqrt())
    }

    /// A direction drawn by that density, and the density.
    pub(crate) fn sample(&self, dir: Vec3, u: Vec2) -> (Vec3, f32) {
        let g = self.g;
        // The textbook's (1 + g^2 - ((1 - g^2) / (1 + g s))^2) / (2 g), multiplied out so that no digits are lost near g = 0.
        let s = 1.0 - 2.0 * u.x;
        let d = 1.0 + g * s;
        let cos = (2.0 * s + g * (3.0 + s * s) + 2.0 * g * g * s + g * g * g * (s * s - 1.0)) / (2.0 * d * d);
        let cos = cos.clamp(-1.0, 1.0);
        let ring = (1.0 - cos * cos).max(0.0).sqrt() * Vec2::from_angle(TAU * u.y);
        let to = OrthonormalFrame::around(dir).to_world(ring.extend(cos));
        (to, self.density(dir, to))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;

    #[test]
    fn samples_are_distributed_by_the_density() {
        const BINS: usize = 16;
        const DRAWS: u32 = 1 << 16;
        for g in [-0.9, -0.3, 0.0, 0.2, 0.7, 0.95] {
            let (phase, dir) = (Phase::new(g), Vec3::new(0.48, 0.6, -0.64));
            let mut counts = [0_u32; BINS];
            for i in 0..DRAWS {
                // Independent numbers: a net would be more even than chance.
                let (to, pdf) = phase.sample(dir, Sampler::new(i.into(), [0, 0], 0).next_2d());
                assert!(
                    (to.length() - 1.0).abs() < 1e-4 && (pdf / phase.density(dir, to) - 1.0).abs() < 1e-6
                );
                // The share of directions that are turned less: bins of equal probability.
                let share = turned_less(g.into(), to.dot(dir).into());
                counts[((share * BINS as f64) as usize).min(BINS - 1)] += 1;
            }
            let expected = f64::from(DRAWS) / BINS as f64;
            let chi: f64 = counts.iter().map(|&n| (f64::from(n) - expected).powi(2) / expected).sum();
            // 15 degrees of freedom: exceeded once in ten thousand.
            assert!(chi < 44.3, "g {g}: {chi} {counts:?}");
        }
    }

    /// The probability of a cosine of at least `cos`: the integral of the density in closed form.
    fn turned_less(g: f64, cos: f64) -> f64 {
        if g == 0.0 {
            return 0.5 * (1.0 - cos);
        }
        let below =
            (1.0 - g * g) / (2.0 * g) * (1.0 / (1.0 + g * g - 2.0 * g * cos).sqrt() - 1.0 / (1.0 + g));
        (1.0 - below).clamp(0.0, 1.0)
    }

    #[test]
    fn the_density_is_one_in_all() {
        for g in [-0.7, 0.0, 0.5, 0.9] {
            let phase = Phase::new(g);
            let n = 200_000;
            let cos = |i: u32| -1.0 + (2 * i + 1) as f32 / n as f32;
            let to = |c: f32| Vec3::new((1.0 - c * c).max(0.0).sqrt(), 0.0, c);
            let sum: f64 = (0..n).map(|i| f64::from(phase.density(Vec3::Z, to(cos(i))))).sum();
            let whole = sum * 2.0 / f64::from(n) * std::f64::consts::TAU;
            assert!((whole - 1.0).abs() < 1e-3, "g {g}: {whole}");
        }
    }
}
