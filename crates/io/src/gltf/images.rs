//! The images of a file, each read once, in the encodings that somebody asks for.

use super::document::{Document, read_beside};
use super::extensions::extension;
use super::flaw::Flaw;
use super::uri::{Target, resolve};
use crate::image_file::{Limits, decode_image};
use half::f16;
use heliostat_scene::Image;
use heliostat_scene::image::{Encoding, Samples};
use serde::Deserialize;
use std::sync::{Arc, OnceLock};

/// An image, or why there is none.
type Slot = OnceLock<Result<Arc<Image>, Flaw>>;

/// What is known of the images of a file.
#[derive(Debug, Default)]
pub(super) struct Images {
    /// As sRGB and as plain numbers.
    slots: Vec<[Slot; 2]>,
    limits: Limits,
}

/// The extension of a texture whose image is in a format of its own.
#[derive(Deserialize)]
struct Source {
    source: usize,
}

impl Images {
    /// Nothing read yet.
    pub(super) fn of(document: &Document) -> Self {
        let slots = std::iter::repeat_with(Default::default).take(document.root.images.len());
        Self { slots: slots.collect(), limits: Limits::default() }
    }

    /// The image of a texture.
    ///
    /// # Errors
    /// When there is none, or it is missing or damaged.
    pub(super) fn of_texture(
        &self,
        document: &Document,
        texture: usize,
        encoding: Encoding,
    ) -> Result<Arc<Image>, Flaw> {
        let index = source(document, texture)?;
        let slots = self.slots.get(index);
        let slots = slots.ok_or_else(|| {
            Flaw::dangling(format!("textures[{texture}].source"), "images", index, self.slots.len())
        })?;
        let (own, other) = match encoding {
            Encoding::Srgb => (&slots[0], &slots[1]),
            Encoding::Linear => (&slots[1], &slots[0]),
        };
        let read = || match other.get() {
            // Read for another use before: the same numbers, meant otherwise.
            Some(read) => read.clone().map(|image| (*image).clone()),
            None => self.read(document, index),
        };
        own.get_or_init(|| read().map(|image| Arc::new(Image { encoding, ..image }))).clone()
    }

    fn read(&self, document: &Document, index: usize) -> Result<Image, Flaw> {
        let place = format!("images[{index}]");
        let image = &document.root.images[index];
        let decode = |bytes: &[u8]| {
            decode_image(&document.path, bytes, &self.limits).map_err(|error| {
                let report = error.report();
                Flaw::new(&place, report.message.clone()).with_help(report.help.clone().unwrap_or_default())
            })
        };
        if let Some(view) = image.buffer_view {
            return decode(&document.raw_view(view.value(), &place)?.0);
        }
        let uri = image.uri.as_deref().ok_or_else(|| {
            Flaw::new(&place, "has neither a URI nor a buffer view").with_help("export the file again")
        })?;
        match resolve(uri, document.folder(), &format!("{place}.uri"))? {
            Target::Data(bytes) => decode(&bytes),
            Target::File(path) => decode(&read_beside(&path, &place, self.limits.bytes)?),
        }
    }

    /// Size in pixels and channels of an image that has been read.
    pub(super) fn size(&self, index: usize) -> Option<[u32; 2]> {
        let image = self.slots.get(index)?.iter().find_map(Slot::get)?.as_ref().ok()?;
        Some([image.width, image.height])
    }
}

/// The image that a texture shows: one that is read before one that stands for those who cannot.
pub(super) fn source(document: &Document, texture: usize) -> Result<usize, Flaw> {
    let textures = &document.root.textures;
    let json = textures
        .get(texture)
        .ok_or_else(|| Flaw::dangling("materials", "textures", texture, textures.len()))?;
    let place = format!("textures[{texture}]");
    let others = json.extensions.as_ref().map(|extensions| &extensions.others);
    if let Some(webp) = extension::<Source>(others, "EXT_texture_webp", &place)? {
        return Ok(webp.source);
    }
    match json.source.value() {
        // The crate's word for none.
        none if none == u32::MAX as usize => {
            let flaw = Flaw::new(place, "has no image in a format that is read");
            Err(flaw.with_help("convert its textures with `gltf-transform ktxdecompress in.glb out.glb`"))
        }
        source => Ok(source),
    }
}

/// Whether any pixel is less than whole.
pub(super) fn has_holes(image: &Image) -> bool {
    let channels = usize::from(image.channels);
    image.has_alpha()
        && match &image.samples {
            Samples::U8(v) => v.chunks_exact(channels).any(|pixel| pixel[channels - 1] < u8::MAX),
            Samples::U16(v) => v.chunks_exact(channels).any(|pixel| pixel[channels - 1] < u16::MAX),
            Samples::F16(v) => v.chunks_exact(channels).any(|pixel| pixel[channels - 1] < f16::ONE),
            Samples::F32(v) => v.chunks_exact(channels).any(|pixel| pixel[channels - 1] < 1.0),
        }
}

/// A grey image of `1 - factor * alpha`: roughness from glossiness.
pub(super) fn inverted_alpha(image: &Image, factor: f32) -> Image {
    let rows = (0..image.height).flat_map(|y| (0..image.width).map(move |x| (x, y)));
    let value = |(x, y)| 1.0 - factor * image.pixel(x, y).w;
    let samples = Samples::U8(rows.map(|at| (255.0 * value(at)).round() as u8).collect());
    Image::new(image.width, image.height, 1, Encoding::Linear, samples)
}
