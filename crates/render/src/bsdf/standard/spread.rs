//! How light that comes back from anywhere is drawn: by the cosine, and in part towards the horizon.
//!
//! What facets throw at each other follows what they lose, and smooth facets lose at small angles alone: a cosine draws
//! those directions so seldom that a few of them weigh thirty times the rest.
//!
//! # Source
//! The density `(k + 1) (1 - cos)^k / 2 pi` is a power of the height below the pole, inverted in closed form.

use glam::{Vec2, Vec3};
use heliostat_geometry::warp;
use std::f32::consts::TAU;

/// Share of the draws that go to the horizon, where that pays.
const LOW: f32 = 0.5;
/// The highest power: the table of losses has nothing steeper.
const MOST: f32 = 64.0;

/// A density over the half sphere around z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread {
    /// Share of the draws that go to the horizon.
    pub(in crate::bsdf) low: f32,
    /// How steeply they do.
    power: f32,
}

impl Spread {
    /// By the cosine.
    pub(super) const COSINE: Self = Self { low: 0.0, power: 0.0 };

    /// For values of about `(1 - cos)^k`, told by `peak`, what they are at the horizon, over their mean by the cosine.
    pub(super) fn towards_horizon(peak: f32) -> Self {
        // The mean of (1 - cos)^k by the cosine is 2 / ((k + 1) (k + 2)).
        let power = 0.5 * ((1.0 + 8.0 * peak.max(1.0)).sqrt() - 3.0);
        Self { low: LOW, power: if power < MOST { power } else { MOST } }
    }

    /// A direction above, by a number in `[0, 1)` and a point of the unit square.
    pub(super) fn draw(&self, choice: f32, u: Vec2) -> Vec3 {
        if choice >= self.low {
            return warp::square_to_cosine_hemisphere(u);
        }
        let height = 1.0 - (1.0 - u.x).powf(1.0 / (self.power + 1.0));
        let (sin, cos) = (TAU * u.y).sin_cos();
        let across = ((1.0 - height) * (1.0 + height)).max(0.0).sqrt();
        Vec3::new(across * cos, across * sin, height)
    }

    /// The density by solid angle of a direction at that cosine from z; its sign does not matter.
    pub(super) fn pdf(&self, cos: f32) -> f32 {
        let cos = cos.abs();
        let even = warp::cosine_hemisphere_pdf(Vec3::new(0.0, 0.0, cos));
        if self.low == 0.0 {
            return even;
        }
        let low = (self.power + 1.0) / TAU * (1.0 - cos).max(0.0).powf(self.power);
        even + self.low * (low - even)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_follow_the_density() {
        for spread in [Spread::COSINE, Spread::towards_horizon(0.5), Spread::towards_horizon(30.0)] {
            let (n, bins) = (256, 8);
            let mut counts = vec![0.0; bins];
            for i in 0..n * n {
                let u = (Vec2::new((i % n) as f32, (i / n) as f32) + 0.5) / n as f32;
                for (choice, share) in [(0.0, spread.low), (0.9, 1.0 - spread.low)] {
                    let w = spread.draw(choice, u);
                    assert!((w.length() - 1.0).abs() < 1e-5 && w.z >= 0.0);
                    counts[((w.z * bins as f32) as usize).min(bins - 1)] += share / (n * n) as f32;
                }
            }
            for (bin, count) in counts.into_iter().enumerate() {
                let fine = 64;
                let at = |i: usize| (bin as f32 + (i as f32 + 0.5) / fine as f32) / bins as f32;
                let mean = (0..fine).map(|i| spread.pdf(at(i))).sum::<f32>() / fine as f32;
                let share = mean * TAU / bins as f32;
                assert!((count - share).abs() < 0.01, "{spread:?}: {count} for {share} in bin {bin}");
            }
        }
    }
}
