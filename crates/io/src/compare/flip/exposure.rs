//! Exposures of HDR-FLIP: from where the brightest pixel just clips to where the median pixel does.
//!
//! # Source
//! Eurographics 2021, section 4; the tone mapper is K. Narkowicz' fit of ACES with its factor 0.6.

use glam::Vec3;
use heliostat_scene::color::luminance;

/// Numerator and denominator of the tone mapper, from the square down.
const NUMERATOR: [f32; 3] = [0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0];
const DENOMINATOR: [f32; 3] = [0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14];
/// The displayed value that counts as bright.
const BRIGHT: f32 = 0.85;
/// Light above it is as bright as it.
const BRIGHTEST: f32 = 65536.0;

fn sane(light: Vec3) -> Vec3 {
    Vec3::from_array(light.to_array().map(|v| if v.is_nan() { 0.0 } else { v.clamp(0.0, BRIGHTEST) }))
}

/// The exposures in stops for a reference, at least two.
pub(super) fn exposures(reference: &[Vec3]) -> Vec<f32> {
    let mut luminances: Vec<_> = reference.iter().map(|p| luminance(sane(*p))).collect();
    luminances.sort_by(f32::total_cmp);
    // A picture that is mostly black has its median among the pixels that are not.
    let dark = luminances.partition_point(|y| *y <= 0.0);
    let middle = luminances.len() / 2;
    let middle = if dark > middle { dark + (luminances.len() - dark) / 2 } else { middle };
    let (Some(median), Some(brightest)) = (luminances.get(middle), luminances.last()) else {
        return vec![0.0, 1.0];
    };
    let bright = light_shown_as(BRIGHT);
    let [start, stop] = [brightest, median].map(|y| (bright / y).log2());
    let count = (stop - start).ceil().max(2.0);
    (0..count as u32).map(|i| start + i as f32 * (stop - start) / (count - 1.0)).collect()
}

/// The light that the tone mapper shows as `t`: the positive root of the quadratic.
fn light_shown_as(t: f32) -> f32 {
    let [a, b, c] = [0, 1, 2].map(|i| NUMERATOR[i] - t * DENOMINATOR[i]);
    let half = -0.5 * b / a;
    half + (half * half - c / a).sqrt()
}

/// Linear display light of a picture at an exposure in stops.
pub(super) fn tone_map(pixels: &[Vec3], exposure: f32) -> Vec<Vec3> {
    let polynomial = |k: [f32; 3], v: f32| (k[0] * v + k[1]) * v + k[2];
    let map = |v: f32| (polynomial(NUMERATOR, v) / polynomial(DENOMINATOR, v)).clamp(0.0, 1.0);
    let gain = exposure.exp2();
    pixels.iter().map(|p| Vec3::from_array((sane(*p) * gain).to_array().map(map))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_exposure_shows_the_brightest_and_the_last_the_median_as_bright() {
        let reference: Vec<_> = [0.01, 0.1, 0.3, 2.0, 40.0].map(Vec3::splat).to_vec();
        let exposures = exposures(&reference);
        let shown = |i: usize, exposure: f32| tone_map(&reference, exposure)[i].x;
        assert!((shown(4, exposures[0]) - BRIGHT).abs() < 1e-4);
        assert!((shown(2, exposures[exposures.len() - 1]) - BRIGHT).abs() < 1e-4);
        // 40 / 0.3 is 7.06 stops.
        assert_eq!(exposures.len(), 8);
    }

    #[test]
    fn black_pictures_have_exposures_too() {
        assert_eq!(exposures(&[Vec3::ZERO; 9]), [0.0, 1.0]);
        let mostly = [[Vec3::ZERO; 8].as_slice(), &[Vec3::ONE]].concat();
        assert!(exposures(&mostly).iter().all(|e| e.is_finite()));
    }
}
