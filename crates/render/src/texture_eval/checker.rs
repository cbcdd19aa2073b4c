//! The mean of a checker over a box, exactly.
//!
//! # Source
//! Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd edition, section 10.5.2 (box-filtered checker).

use glam::Vec2;
use heliostat_scene::Rgb;

/// The mean of squares of side 1 over the box around an ellipse with these axes.
pub(super) fn mean(even: Rgb, odd: Rgb, uv: Vec2, axes: [Vec2; 2]) -> Rgb {
    let half = 0.5 * (axes[0].abs() + axes[1].abs());
    // The pattern is a product of two square waves, and so is its mean over a box.
    let sign = mean_sign(uv.x, half.x) * mean_sign(uv.y, half.y);
    odd.lerp(even, 0.5 * (1.0 + sign))
}

/// The mean over `x - half` to `x + half` of the wave that is 1 from 0 to 1, -1 from 1 to 2, and so on.
fn mean_sign(x: f32, half: f32) -> f32 {
    // Brought near zero in `f64`: far out a difference of integrals would lose its digits.
    let near = f64::from(x).rem_euclid(2.0);
    let (from, to) = (near - f64::from(half), near + f64::from(half));
    if from.floor() == to.floor() || half == 0.0 {
        return if near.floor() == 1.0 { -1.0 } else { 1.0 };
    }
    ((integral(to) - integral(from)) / (to - from)) as f32
}

/// The integral of the wave from 0: a triangle wave of height 1.
fn integral(x: f64) -> f64 {
    let within = x.rem_euclid(2.0);
    if within < 1.0 { within } else { 2.0 - within }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_those_of_many_points() {
        let wave = |x: f64| if x.rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
        for (x, half) in [(0.3, 0.1), (0.95, 0.2), (1.5, 0.7), (-2.4, 3.3), (7.0, 0.5), (100.2, 40.0)] {
            let count = 200_000;
            let step = 2.0 * half / f64::from(count);
            let sum: f64 = (0..count).map(|i| wave(x - half + step * (f64::from(i) + 0.5))).sum();
            let mean = mean_sign(x as f32, half as f32);
            assert!((f64::from(mean) - sum / f64::from(count)).abs() < 1e-3, "{x} {half}: {mean}");
        }
    }

    #[test]
    fn wide_boxes_are_grey_and_narrow_ones_are_not() {
        let mean = |uv, width: f32| mean(Rgb::ONE, Rgb::ZERO, uv, [Vec2::X * width, Vec2::Y * width]);
        assert!((mean(Vec2::new(3.2, 8.1), 2000.0) - 0.5).abs().max_element() < 1e-3);
        assert_eq!(mean(Vec2::new(0.5, 0.5), 0.9), Rgb::ONE);
        assert_eq!(mean(Vec2::new(1.5, 0.5), 0.9), Rgb::ZERO);
    }
}
