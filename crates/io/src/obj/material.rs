//! MTL materials as Phong surfaces: what the values are taken to mean.
//!
//! MTL was written for one renderer of 1995 and is written by hundreds of programs since; where the manual and the
//! habits of exporters differ, this file follows what makes their pictures look as they meant:
//!
//! - **Ka** multiplies the ambient light alone. Exporters write 0 or 1 without a thought, so these two, as well as no Ka,
//!   stand for Kd: a surface answers ambient light by its own colour. Any other Ka is taken as written.
//! - **Kd** of 0 beside a `map_Kd` is taken as 1, as is Ke beside `map_Ke`.
//! - **Ns** of 0 means no highlight: a highlight over the whole surface is never meant.
//! - **Tr** is `1 - d`. A `d` wins over it, and `Tr 1` alone is opaque: those who write it mean opacity.
//! - **illum** 0 and 1 have no highlight; 2, 8 and 10 have one; 3 and 5 mirror with Ks; 4 mirrors only where `d` is
//!   below 1, because Maya writes it for everything; 6 refracts and mirrors by fixed weights; 7 and 9 by Fresnel.
//! - **Tf** tints what is refracted by its hue alone: programs disagree on its strength (the Cornell boxes of Williams
//!   College give clear water 0.1, Maya gives wood 1).
//! - **bump** has no unit: full white stands 1/100 of the model's size, times `-bm`, above black. Where the image looks like
//!   a normal map, as Blender writes them, it is one.

use super::channel::Role;
use super::map::Map;
use super::mtl::MtlMaterial;
use super::textures::Textures;
use heliostat_scene::material::{ColorInput, FloatInput, FresnelMode, Phong, Relief};
use heliostat_scene::{Material, Rgb, TextureId};

/// Reflectance of a surface that nothing is known of.
const NEUTRAL: Rgb = Rgb::splat(0.6);

/// Height of a bump map's white, in sizes of the model.
const BUMP_HEIGHT: f32 = 0.01;

/// The material of faces without one, or whose library is missing.
pub(super) fn neutral(name: &str) -> Material {
    let color = ColorInput::constant(NEUTRAL);
    Material::new(name, Phong { ambient: color, diffuse: color, ..Phong::default() })
}

/// The material as the scene has it. `model_size` is the diagonal of the model's box.
pub(super) fn convert(mtl: &MtlMaterial, model_size: f32, textures: &mut Textures<'_, '_>) -> Material {
    let coverage = coverage(mtl);
    let refracts = matches!(mtl.illum, Some(6 | 7)) || (mtl.illum == Some(9) && coverage >= 1.0);
    let diffuse = color(mtl.diffuse, mtl.map_diffuse.as_ref(), NEUTRAL, textures);
    let specular = color(mtl.specular, mtl.map_specular.as_ref(), Rgb::ZERO, textures);
    let mut phong = Phong {
        ambient: ambient(mtl, diffuse, textures),
        diffuse,
        specular,
        emission: color(mtl.emission, mtl.map_emission.as_ref(), Rgb::ZERO, textures),
        ior: mtl.ior.unwrap_or(Phong::default().ior),
        ..Phong::default()
    };
    phong.shininess = shininess(mtl, textures);
    if matches!(mtl.illum, Some(0 | 1)) || mtl.shininess == Some(0.0) {
        phong.specular = ColorInput::default();
    }
    if matches!(mtl.illum, Some(3 | 5 | 6)) || (mtl.illum == Some(4) && coverage < 1.0) {
        phong.mirror = specular;
    }
    if refracts {
        refract(&mut phong, mtl, coverage);
    }
    Material {
        opacity: opacity(mtl, if refracts { 1.0 } else { coverage }, textures),
        relief: relief(mtl, model_size, textures),
        ..Material::new(&mtl.name, phong)
    }
}

/// `d`, or `1 - Tr`.
fn coverage(mtl: &MtlMaterial) -> f32 {
    match (mtl.dissolve, mtl.transparency) {
        (Some(d), _) => d,
        (None, Some(tr)) if tr < 1.0 => 1.0 - tr,
        _ => 1.0,
    }
}

/// Kd, Ks or Ke with its map.
fn color(value: Option<Rgb>, map: Option<&Map>, unknown: Rgb, textures: &mut Textures<'_, '_>) -> ColorInput {
    match map {
        None => ColorInput::constant(value.unwrap_or(unknown)),
        Some(map) => {
            // A texture times nothing is never meant.
            let factor = value.filter(|&v| v != Rgb::ZERO).unwrap_or(Rgb::ONE);
            ColorInput { factor: factor * map.gain, texture: textures.color(map) }
        }
    }
}

fn ambient(mtl: &MtlMaterial, diffuse: ColorInput, textures: &mut Textures<'_, '_>) -> ColorInput {
    let written = mtl.ambient.filter(|&ka| ka != Rgb::ZERO && ka != Rgb::ONE);
    let texture = match &mtl.map_ambient {
        Some(map) => textures.color(map),
        None => diffuse.texture,
    };
    ColorInput { factor: written.unwrap_or(diffuse.factor), texture }
}

fn shininess(mtl: &MtlMaterial, textures: &mut Textures<'_, '_>) -> FloatInput {
    /// Exponent of white where only the map is given.
    const FULL_SHINE: f32 = 1000.0;
    let written = mtl.shininess.filter(|&ns| ns > 0.0);
    match &mtl.map_shininess {
        None => FloatInput::constant(written.unwrap_or(Phong::default().shininess.factor)),
        Some(map) => FloatInput {
            texture: textures.number(map, Role::Number(map.channel)),
            ..FloatInput::constant(written.unwrap_or(FULL_SHINE) * map.gain)
        },
    }
}

/// Lets light through the inside: illumination models 6, 7 and 9.
fn refract(phong: &mut Phong, mtl: &MtlMaterial, coverage: f32) {
    let tint = mtl.filter.filter(|&tf| tf != Rgb::ZERO).map_or(Rgb::ONE, |tf| tf / tf.max_element());
    // Of a body that is also dissolved, `d` says how much is not glass.
    let share = if coverage < 1.0 { 1.0 - coverage } else { 1.0 };
    if coverage < 1.0 {
        phong.diffuse.factor *= coverage;
        phong.ambient.factor *= coverage;
    }
    if mtl.illum == Some(6) {
        phong.transparency =
            ColorInput::constant(share * tint * (Rgb::ONE - phong.mirror.factor.min(Rgb::ONE)));
    } else {
        phong.transparency = ColorInput::constant(share * tint);
        phong.fresnel = FresnelMode::Dielectric;
    }
}

fn opacity(mtl: &MtlMaterial, coverage: f32, textures: &mut Textures<'_, '_>) -> FloatInput {
    let Some(map) = &mtl.map_dissolve else {
        return FloatInput::constant(coverage);
    };
    let texture = textures.number(map, Role::Coverage(map.channel));
    let factor = if coverage == 0.0 && texture.is_some() { 1.0 } else { coverage };
    FloatInput { texture, ..FloatInput::constant(factor) }
}

fn relief(mtl: &MtlMaterial, model_size: f32, textures: &mut Textures<'_, '_>) -> Option<Relief> {
    if let Some(map) = &mtl.normal_map {
        return textures.number(map, Role::Number(None)).map(|texture| normal(texture, map));
    }
    let map = mtl.bump.as_ref()?;
    if textures.looks_like_normal_map(map) {
        return textures.number(map, Role::Number(None)).map(|texture| normal(texture, map));
    }
    let strength = BUMP_HEIGHT * model_size * map.bump_multiplier * map.gain;
    textures.number(map, Role::Number(map.channel)).map(|texture| Relief::Bump { texture, strength })
}

fn normal(texture: TextureId, map: &Map) -> Relief {
    Relief::Normal { texture, strength: map.bump_multiplier }
}
