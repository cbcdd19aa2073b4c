//! Images from files: PNG, JPEG, WebP, Radiance HDR and OpenEXR, told apart by their content.
//!
//! Pixels keep their bit depth. Sizes are checked against [`Limits`] before anything is allocated for them. What is
//! *not* done: colour profiles and the orientation note of cameras are ignored, as renderers do; 8 and 16 bit images
//! count as sRGB, floats as linear.

mod bitmap;
mod refusal;
mod shield;
mod texture;

pub(crate) use refusal::Refusal;
pub(crate) use shield::shield;

use crate::error::LoadError;
use crate::exr_file;
use crate::file::read_file;
use heliostat_scene::frame::{Channel, Depth, Frame};
use heliostat_scene::image::Image;
use heliostat_scene::settings::PixelRect;
use std::collections::BTreeMap;
use std::path::Path;

/// How large an image may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Longest side in pixels.
    pub side: u32,
    /// Bytes of all its pixels, and of the file.
    pub bytes: u64,
}

impl Default for Limits {
    /// 65,536 pixels and 2 GiB: room for an environment of 16,384 by 8,192 float pixels.
    fn default() -> Self {
        Self { side: 1 << 16, bytes: 1 << 31 }
    }
}

impl Limits {
    /// Checks a picture of `width` by `height` pixels that takes `pixel_bytes` each.
    pub(crate) fn check(&self, width: u64, height: u64, pixel_bytes: u64) -> Result<(), Refusal> {
        if width == 0 || height == 0 {
            return Err("has no pixels".into());
        }
        if width.max(height) > u64::from(self.side) {
            let message = format!("{width} x {height} pixels are more than {} on a side", self.side);
            return Err(Refusal::Large(message));
        }
        match width.checked_mul(height).and_then(|n| n.checked_mul(pixel_bytes)) {
            Some(bytes) if bytes <= self.bytes => Ok(()),
            _ => Err(Refusal::Large(format!(
                "{width} x {height} pixels of {pixel_bytes} bytes are more than the limit of {} bytes",
                self.bytes
            ))),
        }
    }
}

/// File formats, by the bytes they start with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Jpeg,
    WebP,
    Hdr,
    Exr,
}

impl Format {
    fn of(bytes: &[u8]) -> Option<Self> {
        let starts: [(&[u8], Self); 4] = [
            (b"\x89PNG\r\n\x1a\n", Self::Png),
            (b"\xff\xd8\xff", Self::Jpeg),
            (b"#?", Self::Hdr),
            (&exr_file::MAGIC, Self::Exr),
        ];
        // The length of the file stands between the two words.
        if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
            return Some(Self::WebP);
        }
        starts.into_iter().find(|(start, _)| bytes.starts_with(start)).map(|(_, format)| format)
    }
}

/// The name of a format that is known, but not read.
fn foreign_format(bytes: &[u8]) -> Option<&'static str> {
    let starts: [(&[u8], &str); 9] = [
        (b"GIF8", "a GIF image"),
        (b"BM", "a BMP image"),
        (b"II*\0", "a TIFF image"),
        (b"MM\0*", "a TIFF image"),
        (b"DDS ", "a DDS texture"),
        (b"\xabKTX", "a KTX texture"),
        (b"8BPS", "a Photoshop image"),
        (b"<", "a text in XML or HTML"),
        (b"version https://git-lfs", "a Git LFS pointer, not the file itself"),
    ];
    starts.into_iter().find(|(start, _)| bytes.starts_with(start)).map(|(_, name)| name)
}

fn unknown_format(path: &Path, bytes: &[u8]) -> LoadError {
    let message = match foreign_format(bytes) {
        _ if bytes.is_empty() => "is empty".to_owned(),
        Some(name) => format!("is {name}"),
        None => "is no image in a known format".to_owned(),
    };
    LoadError::new(path, message).with_help("save it as PNG, JPEG, WebP, HDR or EXR")
}

/// Reads an image as a texture or environment: straight alpha, in the bit depth of the file.
///
/// NaN and infinities of float images become 0 and 65504.
///
/// # Errors
/// When the file is missing, damaged, larger than `limits`, or in a format or variant that is not read.
pub fn read_image(path: &Path, limits: &Limits) -> Result<Image, LoadError> {
    decode_image(path, &read_file(path, limits.bytes)?, limits)
}

/// Like [`read_image`], from the bytes of a file; `path` is for messages.
///
/// # Errors
/// As [`read_image`].
pub fn decode_image(path: &Path, bytes: &[u8], limits: &Limits) -> Result<Image, LoadError> {
    match Format::of(bytes) {
        Some(Format::Exr) => texture::decode(path, bytes, limits),
        Some(format) => bitmap::decode(path, bytes, format, limits),
        None => Err(unknown_format(path, bytes)),
    }
}

/// Reads any image as a frame: all channels of an EXR file, else linear `R`, `G`, `B` and, if there is one, `A`.
///
/// # Errors
/// As [`read_image`].
pub fn read_frame(path: &Path, limits: &Limits) -> Result<Frame, LoadError> {
    let bytes = read_file(path, limits.bytes)?;
    match Format::of(&bytes) {
        Some(Format::Exr) => exr_file::decode_exr(path, &bytes, limits),
        Some(format) => Ok(frame_of(&bitmap::decode(path, &bytes, format, limits)?)),
        None => Err(unknown_format(path, &bytes)),
    }
}

/// The frame of an image: linear, premultiplied.
fn frame_of(image: &Image) -> Frame {
    let has_alpha = image.channels == 2 || image.channels == 4;
    let names = if has_alpha { &["R", "G", "B", "A"][..] } else { &["R", "G", "B"][..] };
    let count = image.width as usize * image.height as usize;
    let mut values = vec![Vec::with_capacity(count); names.len()];
    for y in 0..image.height {
        for x in 0..image.width {
            let pixel = image.pixel(x, y);
            let premultiplied = (pixel.truncate() * pixel.w).extend(pixel.w).to_array();
            values.iter_mut().zip(premultiplied).for_each(|(channel, v)| channel.push(v));
        }
    }
    Frame {
        width: image.width,
        height: image.height,
        window: PixelRect { x0: 0, y0: 0, x1: image.width, y1: image.height },
        channels: names
            .iter()
            .zip(values)
            .map(|(name, values)| Channel { name: (*name).to_owned(), depth: Depth::Float, values })
            .collect(),
        meta: BTreeMap::new(),
    }
}
