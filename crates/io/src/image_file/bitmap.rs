//! PNG, JPEG, WebP and Radiance HDR through the `image` crate.
//!
//! `EXPOSURE` and `COLORCORR` lines of HDR files are not applied: most programs that write them do not mean them.

use super::{Format, Limits, Refusal, shield};
use crate::error::LoadError;
use heliostat_scene::image::{Encoding, Image, Samples};
use image::codecs::hdr::HdrDecoder;
use image::codecs::jpeg::JpegDecoder;
use image::codecs::png::PngDecoder;
use image::codecs::webp::WebPDecoder;
use image::error::ImageError;
use image::{DynamicImage, ImageDecoder, ImageResult};
use std::io::Cursor;
use std::path::Path;

/// Decodes the bytes of a file in one of the four formats.
pub(super) fn decode(path: &Path, bytes: &[u8], format: Format, limits: &Limits) -> Result<Image, LoadError> {
    shield(|| match format {
        Format::Png => {
            let decoder = PngDecoder::with_limits(Cursor::new(bytes), decoder_limits(limits));
            load(decoder, limits)
        }
        Format::Jpeg => {
            check_jpeg_end(bytes)?;
            load(JpegDecoder::new(Cursor::new(bytes)), limits)
        }
        Format::WebP => load(WebPDecoder::new(Cursor::new(bytes)), limits),
        // The official signature is `#?RADIANCE`; many programs write `#?RGBE`, which the strict mode refuses.
        Format::Hdr if bytes.starts_with(b"#?RADIANCE") => load(HdrDecoder::new(Cursor::new(bytes)), limits),
        Format::Hdr => load(HdrDecoder::new_nonstrict(Cursor::new(bytes)), limits),
        Format::Exr => Err(Refusal::Variant("is an OpenEXR file".to_owned())),
    })
    .map_err(|refusal| refusal.about(path))
}

fn decoder_limits(limits: &Limits) -> image::Limits {
    let mut out = image::Limits::default();
    out.max_image_width = Some(limits.side);
    out.max_image_height = Some(limits.side);
    out.max_alloc = Some(limits.bytes);
    out
}

/// Checks the size, then decodes.
fn load(decoder: ImageResult<impl ImageDecoder>, limits: &Limits) -> Result<Image, Refusal> {
    let mut decoder = decoder.map_err(|e| explain(&e))?;
    let (width, height) = decoder.dimensions();
    limits.check(width.into(), height.into(), decoder.color_type().bytes_per_pixel().into())?;
    decoder.set_limits(decoder_limits(limits)).map_err(|e| explain(&e))?;
    convert(DynamicImage::from_decoder(decoder).map_err(|e| explain(&e))?)
}

fn explain(error: &ImageError) -> Refusal {
    match error {
        ImageError::Limits(e) => Refusal::Large(format!("is larger than the limit: {e}")),
        ImageError::Unsupported(e) => Refusal::Variant(format!("is in a variant that is not read: {e}")),
        error => Refusal::Damaged(format!("is damaged: {error}")),
    }
}

fn convert(image: DynamicImage) -> Result<Image, Refusal> {
    let (width, height) = (image.width(), image.height());
    let (channels, samples) = match image {
        DynamicImage::ImageLuma8(i) => (1, Samples::U8(i.into_raw())),
        DynamicImage::ImageLumaA8(i) => (2, Samples::U8(i.into_raw())),
        DynamicImage::ImageRgb8(i) => (3, Samples::U8(i.into_raw())),
        DynamicImage::ImageRgba8(i) => (4, Samples::U8(i.into_raw())),
        DynamicImage::ImageLuma16(i) => (1, Samples::U16(i.into_raw())),
        DynamicImage::ImageLumaA16(i) => (2, Samples::U16(i.into_raw())),
        DynamicImage::ImageRgb16(i) => (3, Samples::U16(i.into_raw())),
        DynamicImage::ImageRgba16(i) => (4, Samples::U16(i.into_raw())),
        DynamicImage::ImageRgb32F(i) => (3, Samples::F32(i.into_raw())),
        DynamicImage::ImageRgba32F(i) => (4, Samples::F32(i.into_raw())),
        _ => return Err(Refusal::Variant("has an unknown pixel format".to_owned())),
    };
    let encoding = if matches!(samples, Samples::F32(_)) { Encoding::Linear } else { Encoding::Srgb };
    Ok(Image::new(width, height, channels, encoding, samples))
}

/// The JPEG decoder fills the missing part of a cut file with grey and says nothing: look for the end mark.
///
/// Inside compressed data the byte 0xff is never followed by a mark, so the last start-of-scan must have an
/// end-of-image behind it (a preview in the metadata has its own pair before).
fn check_jpeg_end(bytes: &[u8]) -> Result<(), Refusal> {
    let last = |mark: u8| bytes.windows(2).rposition(|pair| pair == [0xff, mark]);
    match (last(0xda), last(0xd9)) {
        (Some(scan), Some(end)) if end > scan => Ok(()),
        _ => Err("is damaged: it ends in the middle of the picture".into()),
    }
}
