//! Paths that carry little end by chance.
//!
//! A path goes on for certain while what it carries is above a window, and else with the probability that brings the
//! survivors up to the window: so time goes where radiance is, and no survivor carries more than before it was dark. A window at the
//! full weight of a path from the camera was twice as fast a sample, but had up to two and a half times the variance; none, and a
//! late plunge down to what is left, wasted time in dark rooms and made sparks in glass.
//!
//! # Source
//! Arvo, Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990 (Russian roulette); Booth, "A Weight (Charge)
//! Conservation Importance Window for Monte Carlo", Nuclear Science and Engineering 1977 (weight windows).

use crate::sampler::Sampler;
use heliostat_scene::Rgb;
use std::ops::ControlFlow;

/// What a path carries, of what it could have carried at best from the camera, from which on it may end.
const WINDOW: f32 = 0.25;
/// After so many surfaces all paths may end: else light between perfect mirrors would not.
const CERTAIN: u32 = 16;
/// The largest probability with which such a path goes on.
const MOST_CERTAIN: f32 = 0.95;

/// Ends a path of that weight by chance, after so many surfaces; else gives what its weight is to be divided by.
#[inline]
pub(crate) fn survive(weight: Rgb, surfaces: u32, draws: &mut Sampler) -> ControlFlow<(), f32> {
    let most = if surfaces > CERTAIN { MOST_CERTAIN } else { 1.0 };
    let survives = (weight.max_element() / WINDOW).clamp(0.0, most);
    // Written so that a weight that is no number ends the path.
    let goes_on = survives == 1.0 || draws.next_1d() < survives;
    if goes_on { ControlFlow::Continue(survives) } else { ControlFlow::Break(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_survives_carries_the_rest() {
        for (weight, surfaces) in [(0.9, 3), (0.25, 3), (0.05, 0), (0.05, 20), (0.9, 20)] {
            let (n, mut sum) = (20_000, 0.0);
            for i in 0..n {
                let draws = &mut Sampler::new(3, [1, 2], i);
                if let ControlFlow::Continue(survives) = survive(Rgb::splat(weight), surfaces, draws) {
                    sum += weight / survives;
                    assert!(weight / survives <= weight.max(WINDOW) / MOST_CERTAIN, "{weight}");
                }
            }
            assert!((sum / n as f32 / weight - 1.0).abs() < 1e-2, "{weight} after {surfaces}: {sum}");
        }
    }

    #[test]
    fn nothing_and_no_number_end() {
        for weight in [0.0, f32::NAN] {
            let draws = &mut Sampler::new(3, [1, 2], 0);
            assert_eq!(survive(Rgb::splat(weight), 1, draws), ControlFlow::Break(()));
        }
    }
}
