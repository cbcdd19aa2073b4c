//! Pixels as they were read, in their own bit depth.

mod mips;

pub use mips::Mips;

use crate::color::{Rgb, srgb_to_linear};
use glam::Vec4;
use half::f16;
use std::sync::LazyLock;

/// How stored values map to light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// The sRGB transfer function, on the colour channels only.
    Srgb,
    /// Stored values are the values.
    Linear,
}

/// Samples in one of the depths that image files have, row by row from the top, channels interleaved.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// 8 bits, 255 is 1.
    U8(Vec<u8>),
    /// 16 bits, 65535 is 1.
    U16(Vec<u16>),
    /// Half floats, as they are.
    F16(Vec<f16>),
    /// Floats, as they are.
    F32(Vec<f32>),
}

/// An image of 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGBA) channels; alpha is straight, not premultiplied.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels per row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Channels per pixel, 1 to 4.
    pub channels: u8,
    /// How colour channels are encoded.
    pub encoding: Encoding,
    /// `width * height * channels` values.
    pub samples: Samples,
    /// Smaller copies of it, made when they are first asked for: [`Mips::default`] in a new image.
    pub mips: Mips,
}

/// The 256 linear values of 8-bit sRGB.
static SRGB_U8: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|i| srgb_to_linear(i as f32 / 255.0)));

impl Image {
    /// An image of these samples.
    pub fn new(width: u32, height: u32, channels: u8, encoding: Encoding, samples: Samples) -> Self {
        Self { width, height, channels, encoding, samples, mips: Mips::default() }
    }

    /// A black image in 8 bits, transparent where it has alpha.
    pub fn black(width: u32, height: u32, channels: u8, encoding: Encoding) -> Self {
        let samples = Samples::U8(vec![0; width as usize * height as usize * usize::from(channels)]);
        Self::new(width, height, channels, encoding, samples)
    }

    /// Levels of the image and its smaller copies, down to a single pixel.
    pub fn level_count(&self) -> usize {
        (u32::BITS - self.width.max(self.height).max(1).leading_zeros()) as usize
    }

    /// The image itself for 0, else a copy of `2^-level` its width and height; the smallest for levels that do not exist. The
    /// first call for a copy makes all of them.
    pub fn level(&self, level: usize) -> &Self {
        let Some(below) = level.checked_sub(1) else { return self };
        let copies = self.mips.of(self);
        copies.get(below).or(copies.last()).unwrap_or(self)
    }

    /// Bytes that the smaller copies take once they are made.
    pub fn mip_bytes(&self) -> usize {
        mips::bytes(self)
    }

    /// The linear RGBA value of pixel `(x, y)`, `y` counted from the top; alpha is 1 where there is none.
    ///
    /// # Panics
    /// When the pixel lies outside the image.
    pub fn pixel(&self, x: u32, y: u32) -> Vec4 {
        let channels = usize::from(self.channels);
        let first = (y as usize * self.width as usize + x as usize) * channels;
        let color = |c: usize| self.color_sample(first + c);
        let plain = |c: usize| self.plain_sample(first + c);
        match channels {
            1 => Rgb::splat(color(0)).extend(1.0),
            2 => Rgb::splat(color(0)).extend(plain(1)),
            3 => Vec4::new(color(0), color(1), color(2), 1.0),
            _ => Vec4::new(color(0), color(1), color(2), plain(3)),
        }
    }

    /// Whether the last channel is alpha.
    pub fn has_alpha(&self) -> bool {
        self.channels.is_multiple_of(2)
    }

    /// Bytes that the samples take, smaller copies not counted.
    pub fn bytes(&self) -> usize {
        match &self.samples {
            Samples::U8(v) => v.len(),
            Samples::U16(v) => 2 * v.len(),
            Samples::F16(v) => 2 * v.len(),
            Samples::F32(v) => 4 * v.len(),
        }
    }

    fn plain_sample(&self, i: usize) -> f32 {
        match &self.samples {
            Samples::U8(v) => f32::from(v[i]) / 255.0,
            Samples::U16(v) => f32::from(v[i]) / 65535.0,
            Samples::F16(v) => v[i].to_f32(),
            Samples::F32(v) => v[i],
        }
    }

    fn color_sample(&self, i: usize) -> f32 {
        match (&self.samples, self.encoding) {
            (Samples::U8(v), Encoding::Srgb) => SRGB_U8[usize::from(v[i])],
            (_, Encoding::Srgb) => srgb_to_linear(self.plain_sample(i)),
            (_, Encoding::Linear) => self.plain_sample(i),
        }
    }
}
