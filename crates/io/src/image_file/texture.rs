//! OpenEXR files as textures and environments: one colour layer, straight alpha.

use super::{Limits, Refusal};
use crate::error::LoadError;
use crate::exr_file;
use crate::picture::{Picture, main_layer};
use half::f16;
use heliostat_scene::frame::Depth;
use heliostat_scene::image::{Encoding, Image, Samples};
use std::path::Path;

/// Decodes the main layer of a file over its whole display window.
pub(super) fn decode(path: &Path, bytes: &[u8], limits: &Limits) -> Result<Image, LoadError> {
    let names = exr_file::channel_names(path, bytes, limits)?;
    let layer = main_layer(&names).ok_or_else(|| Refusal::from("has no channels").about(path))?;
    let frame = exr_file::decode_channels(path, bytes, limits, &|name| layer.contains(name))?;
    let pixel_bytes = 4 * layer.channel_count() as u64;
    limits.check(frame.width.into(), frame.height.into(), pixel_bytes).map_err(|e| e.about(path))?;
    let picture = Picture::of_layer(&frame, &layer);
    let mut image = image(&picture, layer.is_grey(), layer.has_alpha());
    if frame.channels.iter().all(|channel| channel.depth == Depth::Half) {
        keep_half(&mut image);
    }
    Ok(image)
}

/// Stores the samples of an image that came from halves as halves.
fn keep_half(image: &mut Image) {
    if let Samples::F32(samples) = &image.samples {
        image.samples = Samples::F16(samples.iter().map(|&v| f16::from_f32(v)).collect());
    }
}

/// Straight alpha and finite values.
fn image(picture: &Picture, is_grey: bool, has_alpha: bool) -> Image {
    /// Stands for infinity: the largest half.
    const BRIGHTEST: f32 = 65504.0;
    let channels = if is_grey { 1 } else { 3 } + u8::from(has_alpha);
    let mut samples = Vec::with_capacity(picture.pixels.len() * usize::from(channels));
    for &pixel in &picture.pixels {
        let color = crate::picture::straight(pixel).to_array();
        let finite = |v: f32| if v.is_nan() { 0.0 } else { v.clamp(-BRIGHTEST, BRIGHTEST) };
        samples.extend(color[..if is_grey { 1 } else { 3 }].iter().map(|&v| finite(v)));
        if has_alpha {
            samples.push(finite(pixel.w).clamp(0.0, 1.0));
        }
    }
    let (width, height) = (picture.width, picture.height);
    Image::new(width, height, channels, Encoding::Linear, Samples::F32(samples))
}
