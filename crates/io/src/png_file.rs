//! PNG files: a frame for the eye, in sRGB.
//!
//! # Alpha
//! PNG has straight alpha, a frame has premultiplied light. So a pixel is divided by its alpha, then goes through the
//! view transform, and is stored beside its alpha: an edge keeps the colour of its object, in any brightness.
//! Light without coverage (RGB above 0 where alpha is 0: a flame over a transparent background) is stored with its
//! own colour and alpha 0: nothing is divided by 0, and other programs show nothing there; only EXR holds it. A picture
//! that is opaque everywhere is written without alpha.
//!
//! Values are rounded to the nearest step, without dither: the same frame gives the same bytes. Where 8 bits show
//! bands, 16 bits do not.

use crate::atomic::write_atomically;
use crate::picture::{Picture, main_layer, named_layer, straight};
use crate::save_error::SaveError;
use crate::view::View;
use heliostat_scene::frame::Frame;
use std::path::Path;

/// Bits per channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PngBits {
    /// 256 steps.
    #[default]
    Eight,
    /// 65,536 steps.
    Sixteen,
}

impl PngBits {
    /// 8 or 16.
    pub fn count(self) -> u8 {
        match self {
            Self::Eight => 8,
            Self::Sixteen => 16,
        }
    }
}

/// How a frame becomes a PNG.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PngOptions {
    /// Bits per channel.
    pub bits: PngBits,
    /// How light becomes display colour.
    pub view: View,
    /// The layer to show, `""` for the base layer; without it R, G and B of the base layer, or what comes nearest.
    pub layer: Option<String>,
}

/// Writes the whole picture of `frame` to `path`, atomically. What lies outside its window is transparent.
///
/// # Errors
/// When the frame has no such layer, or the file cannot be written.
pub fn write_png(path: &Path, frame: &Frame, options: &PngOptions) -> Result<(), SaveError> {
    let bytes = encode_png(frame, options).map_err(|e| SaveError::new(path, e))?;
    write_atomically(path, |out| out.write_all(&bytes))
}

/// The bytes that [`write_png`] writes.
///
/// # Errors
/// With a sentence, when the frame has no such layer or no pixels.
pub fn encode_png(frame: &Frame, options: &PngOptions) -> Result<Vec<u8>, String> {
    let names: Vec<_> = frame.channels.iter().map(|c| c.name.as_str()).collect();
    let layer = match &options.layer {
        Some(name) => named_layer(&names, name),
        None => main_layer(&names),
    };
    let layer = layer.ok_or_else(|| no_layer(&names, options.layer.as_deref()))?;
    let pixels = quantize(&Picture::of_layer(frame, &layer), &options.view, options.bits);
    compress(frame.width, frame.height, &pixels, options.bits).map_err(|e| format!("cannot be encoded: {e}"))
}

fn no_layer(names: &[&str], wanted: Option<&str>) -> String {
    match wanted {
        Some(wanted) => format!("there is no layer `{wanted}`; there are the channels {}", names.join(", ")),
        None => "there are no channels to show".to_owned(),
    }
}

/// RGBA as display colour in steps.
fn quantize(picture: &Picture, view: &View, bits: PngBits) -> Vec<[u16; 4]> {
    let largest = match bits {
        PngBits::Eight => f32::from(u8::MAX),
        PngBits::Sixteen => f32::from(u16::MAX),
    };
    // `as` turns NaN into 0 and stops at the ends.
    let step = |v: f32| (v.clamp(0.0, 1.0) * largest).round() as u16;
    let pixel = |p: &glam::Vec4| view.apply(straight(*p)).extend(p.w).to_array().map(step);
    picture.pixels.iter().map(pixel).collect()
}

fn compress(
    width: u32,
    height: u32,
    pixels: &[[u16; 4]],
    bits: PngBits,
) -> Result<Vec<u8>, png::EncodingError> {
    let (depth, opaque) = match bits {
        PngBits::Eight => (png::BitDepth::Eight, u16::from(u8::MAX)),
        PngBits::Sixteen => (png::BitDepth::Sixteen, u16::MAX),
    };
    let has_alpha = pixels.iter().any(|p| p[3] != opaque);
    let channels = if has_alpha { 4 } else { 3 };
    let values = pixels.iter().flat_map(|p| &p[..channels]);
    let data: Vec<u8> = match bits {
        PngBits::Eight => values.map(|&v| v as u8).collect(),
        PngBits::Sixteen => values.flat_map(|v| v.to_be_bytes()).collect(),
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(if has_alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_depth(depth);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    // A third of the time of the default, for files a little larger.
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
}
