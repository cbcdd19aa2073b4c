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

mod steps;

use crate::atomic::write_atomically;
use crate::parallel::map_in_order;
use crate::picture::{Layer, Rows, main_layer, named_layer, straight};
use crate::save_error::SaveError;
use crate::view::{View, encoded};
use glam::Vec4;
use heliostat_scene::frame::Frame;
use std::path::Path;
use steps::{EncodedSteps, linear_step};

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
    /// Threads that work out the colours; 0 for one per processor. They do not change the file.
    pub threads: usize,
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
    let (samples, has_alpha) = quantize(frame, &layer, options);
    compress(frame, &samples, has_alpha, options.bits).map_err(|e| format!("cannot be encoded: {e}"))
}

fn no_layer(names: &[&str], wanted: Option<&str>) -> String {
    match wanted {
        Some(wanted) => format!("there is no layer `{wanted}`; there are the channels {}", names.join(", ")),
        None => "there are no channels to show".to_owned(),
    }
}

/// Samples of all pixels as display colour in steps, each of one or two bytes, and whether alpha is among them.
fn quantize(frame: &Frame, layer: &Layer, options: &PngOptions) -> (Vec<u8>, bool) {
    match options.bits {
        PngBits::Eight => {
            let table = EncodedSteps::new();
            let alpha = |v| linear_step(v, u8::MAX.into()) as u8;
            samples(frame, layer, options, |v| table.step(v), alpha)
        }
        PngBits::Sixteen => {
            let alpha = |v| linear_step(v, u16::MAX).to_be_bytes();
            let (samples, has_alpha) = samples(frame, layer, options, |v| alpha(encoded(v)), alpha);
            (samples.as_flattened().to_vec(), has_alpha)
        }
    }
}

/// [`quantize`] with samples of any type; a picture that is opaque everywhere goes without alpha.
fn samples<S: Copy + PartialEq + Send + Sync>(
    frame: &Frame,
    layer: &Layer,
    options: &PngOptions,
    color: impl Fn(f32) -> S + Sync,
    alpha: impl Fn(f32) -> S + Sync,
) -> (Vec<S>, bool) {
    let rows = Rows::new(frame, layer);
    let one = |y: &u32| {
        let mut pixels = vec![Vec4::ZERO; frame.width as usize];
        rows.read(*y, &mut pixels);
        let quantized = pixels.into_iter().map(|pixel| {
            let [r, g, b] = options.view.form(straight(pixel)).to_array().map(&color);
            [r, g, b, alpha(pixel.w)]
        });
        quantized.collect::<Vec<_>>()
    };
    let rows = map_in_order(&(0..frame.height).collect::<Vec<_>>(), options.threads, one);
    let opaque = alpha(1.0);
    if rows.iter().flatten().any(|pixel| pixel[3] != opaque) {
        return (rows.concat().as_flattened().to_vec(), true);
    }
    let mut samples = Vec::with_capacity(3 * frame.width as usize * frame.height as usize);
    rows.iter().flatten().for_each(|&[r, g, b, _]| samples.extend([r, g, b]));
    (samples, false)
}

fn compress(
    frame: &Frame,
    samples: &[u8],
    has_alpha: bool,
    bits: PngBits,
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, frame.width, frame.height);
    encoder.set_color(if has_alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_depth(match bits {
        PngBits::Eight => png::BitDepth::Eight,
        PngBits::Sixteen => png::BitDepth::Sixteen,
    });
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    // A third of the time of the default, for files a little larger.
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(samples)?;
    writer.finish()?;
    Ok(bytes)
}
