//! A frame as the bytes that ffmpeg reads: RGB, 8 bits, rows from the top, over black.

use crate::diagnose::Failure;
use heliostat_io::image_file::{Limits, decode_image, read_frame, read_image};
use heliostat_io::png_file::{PngOptions, encode_png};
use heliostat_io::{LoadError, View};
use heliostat_scene::image::{Image, Samples};
use std::path::Path;

/// Display colours of a picture.
#[derive(Debug)]
pub(super) struct Raster {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Three bytes per pixel.
    pub(super) rgb: Vec<u8>,
}

impl Raster {
    /// Reads an image: display colours as they are, light through the view transform.
    pub(super) fn read(path: &Path, view: View) -> Result<Self, Failure> {
        let limits = Limits::default();
        let image = read_image(path, &limits)?;
        let display = match image.samples {
            Samples::U8(_) | Samples::U16(_) => image,
            Samples::F16(_) | Samples::F32(_) => {
                let frame = read_frame(path, &limits)?;
                let options = PngOptions { view, ..PngOptions::default() };
                let png = encode_png(&frame, &options).map_err(|e| LoadError::new(path, e))?;
                decode_image(path, &png, &limits)?
            }
        };
        Ok(Self { width: display.width, height: display.height, rgb: rgb(&display) })
    }
}

/// Colours over black.
fn rgb(image: &Image) -> Vec<u8> {
    let channels = usize::from(image.channels.max(1));
    let at = |i: usize| match &image.samples {
        Samples::U8(v) => v[i],
        // 65535 is 255 times 257.
        Samples::U16(v) => ((u32::from(v[i]) + 128) / 257) as u8,
        Samples::F16(v) => (v[i].to_f32().clamp(0.0, 1.0) * 255.0).round() as u8,
        Samples::F32(v) => (v[i].clamp(0.0, 1.0) * 255.0).round() as u8,
    };
    let count = image.width as usize * image.height as usize;
    let mut rgb = Vec::with_capacity(3 * count);
    for pixel in 0..count {
        let first = pixel * channels;
        let color = if channels < 3 { [at(first); 3] } else { [at(first), at(first + 1), at(first + 2)] };
        let alpha = if channels.is_multiple_of(2) { u32::from(at(first + channels - 1)) } else { 255 };
        rgb.extend(color.map(|c| ((u32::from(c) * alpha + 127) / 255) as u8));
    }
    rgb
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::image::Encoding;

    fn image(channels: u8, samples: Samples) -> Image {
        Image::new(1, 1, channels, Encoding::Srgb, samples)
    }

    #[test]
    fn every_number_of_channels_becomes_rgb_over_black() {
        assert_eq!(rgb(&image(1, Samples::U8(vec![7]))), [7, 7, 7]);
        assert_eq!(rgb(&image(2, Samples::U8(vec![200, 0]))), [0, 0, 0]);
        assert_eq!(rgb(&image(3, Samples::U8(vec![1, 2, 3]))), [1, 2, 3]);
        assert_eq!(rgb(&image(4, Samples::U8(vec![255, 100, 0, 51]))), [51, 20, 0]);
        assert_eq!(rgb(&image(3, Samples::U16(vec![65535, 257, 0]))), [255, 1, 0]);
    }
}
