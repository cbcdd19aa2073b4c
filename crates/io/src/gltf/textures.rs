//! Textures: images with their samplers, and where on a surface they are looked at.

use super::document::Document;
use super::extensions::extension;
use super::flaw::Flaw;
use super::images::{Images, inverted_alpha};
use glam::Vec2;
use gltf::json::texture::{self, MagFilter, MinFilter, WrappingMode};
use gltf::json::validation::Checked;
use heliostat_scene::image::Encoding;
use heliostat_scene::texture::{Filtering, Minify, Pattern, Texture, UvSet, UvTransform, Wrap};
use heliostat_scene::{Image, TextureId};
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::HashMap;
use std::sync::Arc;

/// How a material looks at a texture.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct TextureInfo {
    pub(super) index: usize,
    #[serde(default)]
    tex_coord: u32,
    /// Of normal maps.
    #[serde(default = "one")]
    pub(super) scale: f32,
    #[serde(default)]
    extensions: Map<String, Value>,
}

fn one() -> f32 {
    1.0
}

impl TextureInfo {
    /// That of the core, which has the same parts.
    pub(super) fn new(index: usize, tex_coord: u32, scale: f32, others: Option<&Map<String, Value>>) -> Self {
        Self { index, tex_coord, scale, extensions: others.cloned().unwrap_or_default() }
    }
}

/// `KHR_texture_transform`.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Transform {
    offset: [f32; 2],
    rotation: f32,
    scale: [f32; 2],
    tex_coord: Option<u32>,
}

impl Default for Transform {
    fn default() -> Self {
        Self { offset: [0.0; 2], rotation: 0.0, scale: [1.0; 2], tex_coord: None }
    }
}

impl Transform {
    /// The same for coordinates that grow upwards, `1 - v` in place of `v`, before and after.
    ///
    /// The file's way is `(u, v) -> T R S (u, v)` with `R = [cos sin; -sin cos]`. With `v = 1 - w` on both sides the turn stays
    /// the same angle, now counter-clockwise, and the shift takes up what the flipped origin leaves.
    fn upwards(&self, set: UvSet) -> UvTransform {
        let (sin, cos) = self.rotation.sin_cos();
        let [x, y] = self.offset;
        let height = self.scale[1];
        let offset = Vec2::new(x + sin * height, 1.0 - y - cos * height);
        UvTransform { set, scale: self.scale.into(), rotation: self.rotation, offset }
    }
}

/// What makes two looks at a texture the same.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Key {
    index: usize,
    is_srgb: bool,
    uv: (bool, [u32; 5]),
    inverted: Option<u32>,
}

/// The textures of a scene so far.
#[derive(Debug)]
pub(super) struct Textures<'d> {
    document: &'d Document,
    images: &'d Images,
    known: HashMap<Key, TextureId>,
    pub(super) all: Vec<Texture>,
    /// Images that are missing or damaged, and sets of coordinates that are not read.
    pub(super) flaws: Vec<Flaw>,
}

impl<'d> Textures<'d> {
    pub(super) fn new(document: &'d Document, images: &'d Images) -> Self {
        Self { document, images, known: HashMap::new(), all: Vec::new(), flaws: Vec::new() }
    }

    /// A texture as a material looks at it; `inverted` asks for `1 - inverted * alpha` in place of its colours.
    ///
    /// # Errors
    /// When the texture does not exist or its extensions are damaged. A missing or damaged image is told in `flaws`.
    pub(super) fn add(
        &mut self,
        info: &TextureInfo,
        encoding: Encoding,
        inverted: Option<f32>,
    ) -> Result<TextureId, Flaw> {
        let uv = self.transform(info)?;
        let numbers = [uv.scale.x, uv.scale.y, uv.rotation, uv.offset.x, uv.offset.y].map(f32::to_bits);
        let key = Key {
            index: info.index,
            is_srgb: encoding == Encoding::Srgb,
            uv: (uv.set == UvSet::Second, numbers),
            inverted: inverted.map(f32::to_bits),
        };
        if let Some(known) = self.known.get(&key) {
            return Ok(*known);
        }
        let pattern = match self.images.of_texture(self.document, info.index, encoding) {
            Ok(image) => {
                let image = inverted.map_or(image.clone(), |factor| Arc::new(inverted_alpha(&image, factor)));
                self.sampled(info.index, image)
            }
            Err(flaw) => {
                self.tell(flaw);
                Pattern::Missing
            }
        };
        let id = TextureId(self.all.len() as u32);
        self.all.push(Texture { name: name(self.document, info.index), pattern, uv });
        self.known.insert(key, id);
        Ok(id)
    }

    /// The image of a texture, if it can be read.
    pub(super) fn image(&self, info: &TextureInfo, encoding: Encoding) -> Option<Arc<Image>> {
        self.images.of_texture(self.document, info.index, encoding).ok()
    }

    fn tell(&mut self, flaw: Flaw) {
        if !self.flaws.contains(&flaw) {
            self.flaws.push(flaw);
        }
    }

    fn transform(&mut self, info: &TextureInfo) -> Result<UvTransform, Flaw> {
        let place = format!("textures[{}]", info.index);
        let transform = extension::<Transform>(Some(&info.extensions), "KHR_texture_transform", &place)?;
        let set = transform.as_ref().and_then(|t| t.tex_coord).unwrap_or(info.tex_coord);
        if set > 1 {
            let message = format!("is looked at through TEXCOORD_{set}; only 0 and 1 are read, 0 stands in");
            self.tell(Flaw::new(place, message).with_help("export it with two sets of texture coordinates"));
        }
        let set = if set == 1 { UvSet::Second } else { UvSet::First };
        let uv = transform.map_or(UvTransform { set, ..UvTransform::default() }, |t| t.upwards(set));
        if uv.offset.is_finite() && uv.scale.is_finite() && uv.rotation.is_finite() {
            return Ok(uv);
        }
        let place = format!("textures[{}]", info.index);
        Err(Flaw::new(place, "is transformed beyond all numbers").with_help("export the file again"))
    }

    fn sampled(&self, texture: usize, image: Arc<Image>) -> Pattern {
        let json = self.document.root.textures.get(texture);
        let sampler = json.and_then(|texture| self.document.root.samplers.get(texture.sampler?.value()));
        let wrap = |mode: Option<Checked<WrappingMode>>| match mode {
            Some(Checked::Valid(WrappingMode::ClampToEdge)) => Wrap::Clamp,
            Some(Checked::Valid(WrappingMode::MirroredRepeat)) => Wrap::Mirror,
            _ => Wrap::Repeat,
        };
        let filtering = sampler.map_or(Filtering::Bilinear, filtering);
        let wraps = [sampler.map(|s| s.wrap_s), sampler.map(|s| s.wrap_t)].map(wrap);
        let minify = sampler.map_or(Minify::Mip, minify);
        Pattern::Image { image, wrap_u: wraps[0], wrap_v: wraps[1], filtering, minify }
    }
}

/// Pixels show where a picture is enlarged: that filter decides, and the other one where it alone is given.
fn filtering(sampler: &texture::Sampler) -> Filtering {
    let nearest = match (sampler.mag_filter, sampler.min_filter) {
        (Some(Checked::Valid(mag)), _) => mag == MagFilter::Nearest,
        (None, Some(Checked::Valid(min))) => min == MinFilter::Nearest,
        _ => false,
    };
    if nearest { Filtering::Nearest } else { Filtering::Bilinear }
}

/// A filter without smaller copies is one that the author wants; without any, the best there is.
fn minify(sampler: &texture::Sampler) -> Minify {
    match sampler.min_filter {
        Some(Checked::Valid(MinFilter::Nearest)) => Minify::Nearest,
        Some(Checked::Valid(MinFilter::Linear)) => Minify::Bilinear,
        _ => Minify::Mip,
    }
}

/// The name of a texture, or of its image.
pub(super) fn name(document: &Document, texture: usize) -> String {
    let json = document.root.textures.get(texture);
    let image = json.and_then(|texture| document.root.images.get(texture.source.value()));
    let own = json.and_then(|texture| texture.name.clone());
    let of_image = || image.and_then(|image| image.name.clone());
    // A data URI is no name.
    let file = || image.and_then(|image| image.uri.clone()).filter(|uri| !uri.starts_with("data:"));
    let named = own.or_else(of_image).or_else(file).filter(|name| !name.is_empty());
    named.unwrap_or_else(|| format!("texture {texture}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What `KHR_texture_transform` gives, by the matrices of its text: columns of translation, rotation and scale.
    fn by_the_text(t: &Transform, [u, v]: [f32; 2]) -> [f32; 2] {
        let (sin, cos) = t.rotation.sin_cos();
        let (u, v) = (u * t.scale[0], v * t.scale[1]);
        [cos * u + sin * v + t.offset[0], -sin * u + cos * v + t.offset[1]]
    }

    #[test]
    fn transforms_show_the_same_with_v_upwards() {
        let transforms = [
            Transform::default(),
            Transform { offset: [0.3, -0.2], ..Transform::default() },
            Transform { rotation: 0.7, ..Transform::default() },
            Transform { offset: [0.3, -0.2], rotation: -2.1, scale: [1.5, -0.4], tex_coord: None },
        ];
        for t in transforms {
            for uv in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.3, 0.8]] {
                let [u, v] = by_the_text(&t, uv);
                let ours = t.upwards(UvSet::First).apply(Vec2::new(uv[0], 1.0 - uv[1]));
                assert!(ours.distance(Vec2::new(u, 1.0 - v)) < 1e-6, "{t:?} {uv:?}");
            }
        }
    }
}
