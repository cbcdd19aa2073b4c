//! The difference of two pictures as a picture.

use super::Comparison;
use crate::picture::Picture;
use glam::Vec3;
use heliostat_scene::color::srgb_to_linear;
use heliostat_scene::frame::{Channel, Depth, Frame};
use heliostat_scene::settings::PixelRect;
use std::collections::BTreeMap;

/// The FLIP errors as colours from black (0) through purple and orange to pale yellow (1) in `R`, `G`, `B`, the errors
/// themselves in `flip.Y`, and the absolute differences of the channels in `difference.R`, `.G`, `.B`.
pub fn difference_frame(comparison: &Comparison, reference: &Picture, test: &Picture) -> Frame {
    let heat: Vec<_> = comparison.flip.iter().map(|&error| magma(error)).collect();
    let pairs = reference.pixels.iter().zip(&test.pixels);
    let absolute: Vec<_> = pairs.map(|(a, b)| (*a - *b).truncate().abs()).collect();
    let channel = |name: &str, depth, values: Vec<f32>| Channel { name: name.to_owned(), depth, values };
    let component = |pixels: &[Vec3], i: usize| pixels.iter().map(|p| p[i]).collect();
    let mut channels = vec![channel("flip.Y", Depth::Float, comparison.flip.clone())];
    for (i, name) in ["R", "G", "B"].into_iter().enumerate() {
        channels.push(channel(name, Depth::Half, component(&heat, i)));
        channels.push(channel(&format!("difference.{name}"), Depth::Float, component(&absolute, i)));
    }
    let (width, height) = (comparison.width, comparison.height);
    let window = PixelRect { x0: 0, y0: 0, x1: width, y1: height };
    Frame { width, height, window, channels, meta: BTreeMap::new() }
}

/// The colour map "magma" as light that the standard view shows as that colour.
///
/// # Source
/// S. van der Walt, N. Smith (matplotlib, 2015), in the polynomial fit of M. Zucker.
fn magma(t: f32) -> Vec3 {
    const COEFFICIENTS: [Vec3; 7] = [
        Vec3::new(-0.002_136_485, -0.000_749_655, -0.005_386_128),
        Vec3::new(0.251_660_54, 0.677_523_24, 2.494_026_6),
        Vec3::new(8.353_717, -3.577_719_5, 0.314_467_9),
        Vec3::new(-27.668_733, 14.264_731, -13.649_213),
        Vec3::new(52.176_14, -27.943_606, 12.944_169),
        Vec3::new(-50.768_525, 29.046_583, 4.234_153),
        Vec3::new(18.655_705, -11.489_774, -5.601_961_5),
    ];
    let t = t.clamp(0.0, 1.0);
    let shown = COEFFICIENTS.iter().rev().fold(Vec3::ZERO, |sum, c| sum * t + *c);
    Vec3::from_array(shown.to_array().map(|v| srgb_to_linear(v.clamp(0.0, 1.0))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::color::linear_to_srgb;

    #[test]
    fn magma_has_its_published_ends_and_middle() {
        // Entries 0, 127 and 255 of matplotlib's table.
        let table = [
            (0.0, Vec3::new(0.0015, 0.0005, 0.0139)),
            (0.498, Vec3::new(0.7132, 0.2144, 0.4763)),
            (1.0, Vec3::new(0.9871, 0.9914, 0.7495)),
        ];
        for (t, expected) in table {
            let shown = Vec3::from_array(magma(t).to_array().map(linear_to_srgb));
            assert!((shown - expected).abs().max_element() < 0.02, "{t}: {shown}");
        }
    }
}
