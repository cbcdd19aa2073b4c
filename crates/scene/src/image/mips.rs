//! Smaller and smaller copies of an image, so that one look averages what many pixels say.
//!
//! Each level has half the width and height of the one before, rounded down. Its pixels are exact means over the area that they
//! stand for, worked out in linear light and stored as the image itself is. Colours under a mask count as much as they cover, so that
//! what is cut away does not bleed into the rest.
//!
//! # Source
//! Williams, "Pyramidal Parametrics", SIGGRAPH 1983; Guthe and Heckbert, "Non-Power-of-Two Mipmapping", NVIDIA, 2005 (the
//! weights of odd sizes).

use super::{Encoding, Image, Samples};
use crate::color::linear_to_srgb;
use glam::Vec4;
use half::f16;
use std::sync::OnceLock;

/// The smaller copies of an image, made when somebody first asks for them. A copy of the image makes its own.
#[derive(Debug, Default)]
pub struct Mips(OnceLock<Box<[Image]>>);

impl Clone for Mips {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for Mips {
    /// They follow from the image.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Mips {
    /// The levels of `image` below the first, largest first.
    pub(super) fn of(&self, image: &Image) -> &[Image] {
        self.0.get_or_init(|| build(image))
    }
}

/// Bytes of all levels but the first.
pub(super) fn bytes(image: &Image) -> usize {
    let pixel = image.bytes() / (image.width as usize * image.height as usize).max(1);
    let sizes = std::iter::successors(halved(image.width, image.height), |&(w, h)| halved(w, h));
    sizes.map(|(w, h)| pixel * w as usize * h as usize).sum()
}

fn halved(width: u32, height: u32) -> Option<(u32, u32)> {
    (width > 1 || height > 1).then(|| ((width / 2).max(1), (height / 2).max(1)))
}

fn build(image: &Image) -> Box<[Image]> {
    // Numbers that are no colours are not masked by a fourth one.
    let is_color =
        image.encoding == Encoding::Srgb || matches!(image.samples, Samples::F16(_) | Samples::F32(_));
    let weighted = image.has_alpha() && is_color;
    let mut levels = Vec::new();
    let mut above = Level { width: image.width, height: image.height, pixels: Vec::new() };
    while let Some((width, height)) = halved(above.width, above.height) {
        let (columns, rows) = (Taps::of(above.width, width), Taps::of(above.height, height));
        let source = |x: u32, y: u32| match above.pixels.is_empty() {
            true => image.pixel(x, y),
            false => above.pixels[(y * above.width + x) as usize],
        };
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for row in &rows {
            for column in &columns {
                pixels.push(mean(column, row, weighted, source));
            }
        }
        levels.push(stored(image, width, height, &pixels));
        above = Level { width, height, pixels };
    }
    levels.into_boxed_slice()
}

/// A level in linear light; the first one has no pixels of its own.
struct Level {
    width: u32,
    height: u32,
    pixels: Vec<Vec4>,
}

/// The pixels of one axis that a pixel of the level below covers: the first one, and how much of three in a row.
#[derive(Clone, Copy)]
struct Taps {
    first: u32,
    weights: [f32; 3],
}

impl Taps {
    fn of(size: u32, smaller: u32) -> Vec<Self> {
        let step = f64::from(size) / f64::from(smaller);
        let taps = |i: u32| {
            let (from, to) = (step * f64::from(i), step * f64::from(i + 1));
            let first = from as u32;
            let weights = [0, 1, 2].map(|k| {
                let start = f64::from(first + k);
                ((to.min(start + 1.0) - from.max(start)).max(0.0) / step) as f32
            });
            Self { first, weights }
        };
        (0..smaller).map(taps).collect()
    }

    fn each(&self) -> impl Iterator<Item = (u32, f32)> {
        (self.first..).zip(self.weights).filter(|(_, weight)| *weight > 0.0)
    }
}

/// The mean over the pixels of a column and a row; colours by their alpha where it is a mask.
fn mean(column: &Taps, row: &Taps, weighted: bool, source: impl Fn(u32, u32) -> Vec4) -> Vec4 {
    let (mut plain, mut masked) = (Vec4::ZERO, Vec4::ZERO);
    for (y, down) in row.each() {
        for (x, across) in column.each() {
            let pixel = source(x, y);
            let weight = across * down;
            plain += weight * pixel;
            masked += weight * pixel.w * pixel;
        }
    }
    if weighted && plain.w > 0.0 { (masked / plain.w).truncate().extend(plain.w) } else { plain }
}

/// A level in the bit depth, the channels and the encoding of the image.
fn stored(image: &Image, width: u32, height: u32, pixels: &[Vec4]) -> Image {
    let channels = usize::from(image.channels);
    let values = pixels.iter().flat_map(|pixel| {
        let alpha = if image.has_alpha() { channels - 1 } else { channels };
        (0..channels).map(move |c| {
            let is_alpha = c == alpha;
            let value = if is_alpha { pixel.w } else { pixel[c] };
            if image.encoding == Encoding::Srgb && !is_alpha { linear_to_srgb(value) } else { value }
        })
    });
    let unit = |v: f32, most: f32| (v.clamp(0.0, 1.0) * most).round();
    let samples = match &image.samples {
        Samples::U8(_) => Samples::U8(values.map(|v| unit(v, 255.0) as u8).collect()),
        Samples::U16(_) => Samples::U16(values.map(|v| unit(v, 65535.0) as u16).collect()),
        Samples::F16(_) => Samples::F16(values.map(f16::from_f32).collect()),
        Samples::F32(_) => Samples::F32(values.collect()),
    };
    Image::new(width, height, image.channels, image.encoding, samples)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: u32, height: u32, channels: u8, samples: Vec<f32>) -> Image {
        Image { samples: Samples::F32(samples), ..Image::black(width, height, channels, Encoding::Linear) }
    }

    #[test]
    fn every_level_has_the_mean_of_the_image() {
        for (width, height) in [(8, 8), (7, 5), (13, 1), (1, 6), (1, 1)] {
            let values: Vec<f32> = (0..width * height).map(|i| (i * 37 % 101) as f32).collect();
            let mean = values.iter().sum::<f32>() / values.len() as f32;
            let image = image(width, height, 1, values);
            let mut size = (width, height);
            for level in 1..image.level_count() {
                let Samples::F32(values) = &image.level(level).samples else { panic!("the depth is kept") };
                size = ((size.0 / 2).max(1), (size.1 / 2).max(1));
                assert_eq!((image.level(level).width, image.level(level).height), size);
                let own = values.iter().sum::<f32>() / values.len() as f32;
                assert!((own - mean).abs() < 1e-4 * mean.max(1.0), "{width} x {height}, level {level}");
            }
            assert_eq!(size, (1, 1));
            let below: usize = (1..image.level_count()).map(|k| image.level(k).bytes()).sum();
            assert_eq!(image.mip_bytes(), below);
        }
    }

    #[test]
    fn means_are_those_of_light() {
        let samples = Samples::U8(vec![0, 255]);
        let image = Image { samples, ..Image::black(2, 1, 1, Encoding::Srgb) };
        // Half of the light is 188 of 255 in sRGB.
        assert_eq!(image.level(1).samples, Samples::U8(vec![188]));
    }

    #[test]
    fn what_is_cut_away_does_not_bleed() {
        let image = image(2, 1, 4, vec![1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0]);
        assert_eq!(image.level(1).pixel(0, 0), Vec4::new(1.0, 0.0, 0.0, 0.5));
    }
}
