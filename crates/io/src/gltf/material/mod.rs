//! Materials as [`Standard`] surfaces.
//!
//! Metallic-roughness and every ratified extension have their place in [`Standard`]; occlusion is left out, because rays find
//! it. What needs a choice:
//!
//! - Where `doubleSided` is not said, the camera looks past back faces. Light does not, and what lets light through shows both sides.
//! - An index of refraction of 0, the file's word for "reflects all", becomes [`MIRROR_IOR`].
//! - Glass without thickness is a thin sheet; with it, it is solid, and absorbs as `attenuationColor` says of the way of
//!   `attenuationDistance`. The thickness itself is for renderers that do not trace rays.
//! - Specular-glossiness becomes a dielectric of [`MIRROR_IOR`] whose reflection has the specular colour.

mod alpha;
mod extensions;
mod layers;

use super::document::Document;
use super::extensions::extension;
use super::flaw::Flaw;
use super::textures::{TextureInfo, Textures};
use extensions::{EmissiveStrength, SpecularGlossiness};
use gltf::json;
use heliostat_scene::image::Encoding;
use heliostat_scene::material::{Back, Channel, ColorInput, FloatInput, Relief, Standard, Surface};
use heliostat_scene::{Material, Rgb};
use serde::de::DeserializeOwned;

/// The index of refraction of what reflects nearly all at every angle.
const MIRROR_IOR: f32 = 1000.0;

/// A material of a file as it is read.
struct Reader<'a, 'd> {
    json: &'a json::Material,
    textures: &'a mut Textures<'d>,
    place: String,
}

/// Whether the alpha of a material counts.
pub(super) fn has_alpha(document: &Document, material: Option<usize>) -> bool {
    let json = material.and_then(|index| document.root.materials.get(index));
    json.is_some_and(alpha::counts)
}

/// The set of coordinates of the normal map of a material, if it has one.
pub(super) fn normal_map_set(document: &Document, material: Option<usize>) -> Option<usize> {
    let normal = material.and_then(|index| document.root.materials.get(index))?.normal_texture.as_ref()?;
    Some(normal.tex_coord as usize)
}

/// Reads a material; `None` is what primitives without one have.
///
/// # Errors
/// When it names textures that are not there, or an extension is damaged.
pub(super) fn read(
    document: &Document,
    index: Option<usize>,
    textures: &mut Textures<'_>,
) -> Result<Material, Flaw> {
    let usual = json::Material::default();
    let materials = &document.root.materials;
    let json = match index {
        None => &usual,
        Some(index) => materials
            .get(index)
            .ok_or_else(|| Flaw::dangling("meshes", "materials", index, materials.len()))?,
    };
    let named = json.name.clone().filter(|name| !name.is_empty());
    let name =
        named.unwrap_or_else(|| index.map_or("default".to_owned(), |index| format!("material {index}")));
    let place = index.map_or(String::new(), |index| format!("materials[{index}]"));
    Reader { json, textures, place }.material(name)
}

impl Reader<'_, '_> {
    fn material(&mut self, name: String) -> Result<Material, Flaw> {
        let glossy = self.extension::<SpecularGlossiness>("KHR_materials_pbrSpecularGlossiness")?;
        let pbr = &self.json.pbr_metallic_roughness;
        let (factor, texture) = match &glossy {
            Some(glossy) => (glossy.diffuse_factor, glossy.diffuse_texture.clone()),
            None => (pbr.base_color_factor.0, pbr.base_color_texture.as_ref().map(of_core)),
        };
        let base_color = self.color([factor[0], factor[1], factor[2]], texture.as_ref(), share)?;
        let is_unlit = self.extension::<serde::de::IgnoredAny>("KHR_materials_unlit")?.is_some();
        let surface = if is_unlit {
            Surface::Unlit(base_color)
        } else {
            Surface::Standard(Box::new(self.standard(base_color, glossy.as_ref())?))
        };
        let relief = match &self.json.normal_texture {
            None => None,
            Some(normal) => {
                let others = normal.extensions.as_ref().map(|extensions| &extensions.others);
                let info = TextureInfo::new(normal.index.value(), normal.tex_coord, normal.scale, others);
                self.relief(Some(&info))?
            }
        };
        let (opacity, cutoff) = self.opacity(factor[3], texture.as_ref())?;
        let is_closed = !self.json.double_sided && !surface.lets_light_through();
        let back = if is_closed { Back::Hidden } else { Back::Alike };
        Ok(Material { opacity, cutoff, relief, back, ..Material::of(name, surface) })
    }

    fn standard(
        &mut self,
        base_color: ColorInput,
        glossy: Option<&SpecularGlossiness>,
    ) -> Result<Standard, Flaw> {
        let strength =
            self.extension::<EmissiveStrength>("KHR_materials_emissive_strength")?.unwrap_or_default();
        let emissive = self.json.emissive_factor.0.map(|v| finite(v) * finite(strength.emissive_strength));
        let texture = self.json.emissive_texture.as_ref().map(of_core);
        let emission = self.color(emissive, texture.as_ref(), at_least_zero)?;
        let pbr = &self.json.pbr_metallic_roughness;
        let rough = pbr.metallic_roughness_texture.as_ref().map(of_core);
        let mut standard = Standard {
            base_color,
            emission,
            metalness: self.float(pbr.metallic_factor.0, rough.as_ref(), Channel::B)?,
            roughness: self.float(pbr.roughness_factor.0, rough.as_ref(), Channel::G)?,
            ..Standard::default()
        };
        self.layers(&mut standard)?;
        if let Some(glossy) = glossy {
            self.glossy(&mut standard, glossy)?;
        }
        Ok(standard)
    }

    /// The surface of specular-glossiness over its diffuse colour.
    fn glossy(&mut self, standard: &mut Standard, glossy: &SpecularGlossiness) -> Result<(), Flaw> {
        let texture = glossy.specular_glossiness_texture.as_ref();
        standard.metalness = FloatInput::constant(0.0);
        standard.ior = MIRROR_IOR;
        standard.specular_color = self.color(glossy.specular_factor, texture, share)?;
        let gloss = share(glossy.glossiness_factor);
        standard.roughness = match texture {
            None => FloatInput::constant(1.0 - gloss),
            Some(texture) => {
                let texture = self.textures.add(texture, Encoding::Linear, Some(gloss))?;
                FloatInput { factor: 1.0, texture: Some(texture), channel: Channel::R }
            }
        };
        Ok(())
    }

    fn extension<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>, Flaw> {
        let others = self.json.extensions.as_ref().map(|extensions| &extensions.others);
        extension(others, name, &self.place)
    }

    /// A colour, each channel kept in its range.
    fn color(
        &mut self,
        factor: [f32; 3],
        texture: Option<&TextureInfo>,
        range: fn(f32) -> f32,
    ) -> Result<ColorInput, Flaw> {
        let factor = Rgb::from(factor.map(range));
        let texture = texture.map(|info| self.textures.add(info, Encoding::Srgb, None)).transpose()?;
        Ok(ColorInput { factor, texture })
    }

    /// A share that a channel of a texture of plain numbers may vary.
    fn float(
        &mut self,
        factor: f32,
        texture: Option<&TextureInfo>,
        channel: Channel,
    ) -> Result<FloatInput, Flaw> {
        let texture = texture.map(|info| self.textures.add(info, Encoding::Linear, None)).transpose()?;
        Ok(FloatInput { factor: share(factor), texture, channel })
    }

    /// The relief of a normal map.
    fn relief(&mut self, info: Option<&TextureInfo>) -> Result<Option<Relief>, Flaw> {
        let Some(info) = info else { return Ok(None) };
        let texture = self.textures.add(info, Encoding::Linear, None)?;
        Ok(Some(Relief::Normal { texture, strength: finite(info.scale) }))
    }
}

/// How the core looks at a texture.
fn of_core(info: &json::texture::Info) -> TextureInfo {
    let others = info.extensions.as_ref().map(|extensions| &extensions.others);
    TextureInfo::new(info.index.value(), info.tex_coord, 1.0, others)
}

fn share(v: f32) -> f32 {
    v.clamp(0.0, 1.0)
}

fn at_least_zero(v: f32) -> f32 {
    v.clamp(0.0, f32::MAX)
}

/// A number of JSON may be too large for 32 bits.
fn finite(v: f32) -> f32 {
    v.clamp(f32::MIN, f32::MAX)
}
