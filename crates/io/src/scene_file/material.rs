//! `[[material]]`: how surfaces answer light.
//!
//! # Scene file
//! ```toml
//! [[material]]
//! name = "glass"
//! opacity = 1                    # 0 lets rays straight through; with a texture, its alpha, else its luminance
//! # cutoff = 0.5                 # the surface is whole from this coverage on, and not there below it
//! # interior = "smoke"           # the [[medium]] that fills what the surface closes; with opacity = 0 there is no surface
//! # backfaces = "hidden"         # faces are seen from the front alone; "dark": they shine from it; "shown" if left out
//! # priority = 1                 # of clear bodies that overlap the one with the highest is there; see below
//! bump = { texture = "noise", strength = 0.01 }              # metres of white; or
//! # normal_map = { texture = "bricks_normal", strength = 1 } # tangent space, +y up
//!
//! [material.phong]               # all optional; these are the defaults
//! ambient = 0.1                  # share of the ambient light
//! diffuse = 0.7
//! specular = 0
//! shininess = 32                 # exponent of the highlight
//! emission = 0                   # radiance of its own
//! mirror = 0                     # weight of the reflected ray
//! transparency = 0               # weight of the refracted ray
//! ior = 1.5                      # index of refraction
//! absorption = 0                 # per metre inside: exp(-absorption * length) is left
//! fresnel = false                # whether the angle shares transparency between refraction and reflection
//! ```
//!
//! Light enters an `interior` where it is refracted or passes by the opacity. Clear bodies that touch are best drawn so that they
//! overlap, each with its own `priority`: the glass over the water in it, the ice over both. Indices of refraction are then those
//! against vacuum, whatever lies around.
//!
//! Hidden back faces are what rasterisers call culling, and what glTF has where it does not say `doubleSided`: the camera looks past
//! them, be it straight, by mirrors or through clear glass, and so do all layers. Light does not: they throw shadows and send
//! light on like any other, as they do in shadow maps. What is clear has an inside, and needs its backs.
//!
//! In place of `[material.phong]` a material may have `[material.standard]`, a [physically based surface](super::standard).

use super::choice::{at_most_one, choice};
use super::names::Names;
use super::number::{Fraction, NonNegative, Number, Positive, Whole};
use super::standard::StandardTable;
use super::texturable::{Texturable, Textured};
use super::value::Color;
use crate::document::{Fault, Placed};
use heliostat_scene::material::{
    Back, Channel, ColorInput, FloatInput, FresnelMode, Material, Phong, Relief, Surface,
};
use heliostat_scene::{MediumId, Rgb, TextureId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a surface answers light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialTable {
    /// Name, unique among materials; becomes the Cryptomatte name.
    pub name: Placed<String>,
    /// Coverage from 0 to 1; with a texture, its alpha, or its luminance where it has no alpha. 1 if left out.
    pub opacity: Option<Texturable<Fraction>>,
    /// From this coverage on the surface is whole, and below it there is none; if left out, coverage is a share.
    pub cutoff: Option<Fraction>,
    /// A height map that bends the shading normal.
    pub bump: Option<Placed<BumpTable>>,
    /// A normal map that bends the shading normal.
    pub normal_map: Option<Placed<NormalMapTable>>,
    /// The name of the `[[medium]]` that fills what the surface closes; none if left out.
    pub interior: Option<Placed<String>>,
    /// Of clear bodies that overlap the one with the highest is there; if left out, the one entered last.
    pub priority: Option<Whole<0, 255>>,
    /// Whether faces are seen from behind; `"shown"` if left out.
    pub backfaces: Option<Placed<Backfaces>>,
    /// Phong's model with a mirror and a transparent part.
    pub phong: Option<Placed<PhongTable>>,
    /// A physically based surface.
    pub standard: Option<Placed<StandardTable>>,
}

/// Whether faces are seen from behind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Backfaces {
    /// They are.
    #[default]
    Shown,
    /// They are, but give off no light of their own: a lamp shines from its front.
    Dark,
    /// The camera looks past them; they throw shadows all the same, and give off no light of their own.
    Hidden,
}

/// A height map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BumpTable {
    /// The name of a `[[texture]]`; its luminance is the height.
    pub texture: Placed<String>,
    /// Height of white in metres.
    pub strength: Number,
}

/// A tangent-space normal map, +y up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NormalMapTable {
    /// The name of a `[[texture]]`.
    pub texture: Placed<String>,
    /// Scale of the bend; 1 if left out.
    pub strength: Option<Number>,
}

/// Phong's model with a mirror and a transparent part.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PhongTable {
    /// Ka: share of the ambient light; 0.1 if left out.
    pub ambient: Option<Texturable<Color>>,
    /// Kd: share of diffuse light; 0.7 if left out.
    pub diffuse: Option<Texturable<Color>>,
    /// Ks: share of the highlight; 0 if left out.
    pub specular: Option<Texturable<Color>>,
    /// Exponent of the highlight; 32 if left out.
    pub shininess: Option<Texturable<NonNegative>>,
    /// Ke: radiance of its own; 0 if left out.
    pub emission: Option<Texturable<Color>>,
    /// Weight of the reflected ray; 0 if left out.
    pub mirror: Option<Texturable<Color>>,
    /// Weight of the refracted ray; 0 if left out.
    pub transparency: Option<Texturable<Color>>,
    /// Index of refraction; 1.5 if left out.
    pub ior: Option<Positive>,
    /// Absorption per metre inside; 0 if left out.
    pub absorption: Option<Color>,
    /// Whether the Fresnel equations share `transparency` between refraction and reflection; `false` if left out.
    pub fresnel: Option<bool>,
}

/// What a texture is used for, which decides how `encoding = "auto"` reads it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TextureUse {
    /// A colour, encoded as the file says.
    Color,
    /// A height, a direction, an exponent: linear numbers.
    Data,
    /// Coverage: alpha, which no encoding touches, or the luminance of an image without it, linear.
    Coverage,
}

/// Finds a texture by name for a use.
pub(super) trait FindTexture {
    /// The texture in the scene.
    fn find(&mut self, name: &Placed<String>, used_for: TextureUse) -> Result<TextureId, Fault>;
}

impl MaterialTable {
    /// The material of the scene.
    pub(super) fn build(&self, textures: &mut impl FindTexture, media: &Names) -> Result<Material, Fault> {
        at_most_one(&[choice("bump", self.bump.as_ref()), choice("normal_map", self.normal_map.as_ref())])?;
        at_most_one(&[choice("phong", self.phong.as_ref()), choice("standard", self.standard.as_ref())])?;
        let surface = match (&self.phong, &self.standard) {
            (Some(table), _) => Surface::Phong(table.build(textures)?),
            (None, Some(table)) => Surface::Standard(Box::new(table.build(textures)?)),
            (None, None) => Surface::Phong(Phong::default()),
        };
        let one = FloatInput::constant(1.0);
        Ok(Material {
            opacity: float_input(self.opacity.as_ref(), Fraction::f32, one, TextureUse::Coverage, textures)?,
            relief: self.relief(textures)?,
            cutoff: self.cutoff.map(Fraction::f32),
            interior: self
                .interior
                .as_ref()
                .map(|name| media.find(name))
                .transpose()?
                .map(|i| MediumId(i as u32)),
            priority: self.priority.map(Whole::u32),
            back: self.back(&surface)?,
            ..Material::of(self.name.to_string(), surface)
        })
    }

    fn back(&self, surface: &Surface) -> Result<Back, Fault> {
        let backfaces = match &self.backfaces {
            None => return Ok(Back::Alike),
            Some(backfaces) => match **backfaces {
                Backfaces::Shown => return Ok(Back::Alike),
                Backfaces::Dark => return Ok(Back::Dark),
                Backfaces::Hidden => backfaces,
            },
        };
        if surface.encloses() || self.interior.is_some() {
            return Err(Fault::new("what has an inside that light enters needs its back faces")
                .with_help("remove `backfaces`, or what lets light in")
                .or_at(backfaces.span()));
        }
        Ok(Back::Hidden)
    }

    fn relief(&self, textures: &mut impl FindTexture) -> Result<Option<Relief>, Fault> {
        if let Some(bump) = &self.bump {
            let texture = textures.find(&bump.texture, TextureUse::Data)?;
            return Ok(Some(Relief::Bump { texture, strength: bump.strength.f32() }));
        }
        let Some(map) = &self.normal_map else { return Ok(None) };
        let texture = textures.find(&map.texture, TextureUse::Data)?;
        let strength = map.strength.map_or(1.0, Number::f32);
        Ok(Some(Relief::Normal { texture, strength }))
    }
}

impl PhongTable {
    fn build(&self, textures: &mut impl FindTexture) -> Result<Phong, Fault> {
        let normal = Phong::default();
        Ok(Phong {
            ambient: color_input(self.ambient.as_ref(), normal.ambient, textures)?,
            diffuse: color_input(self.diffuse.as_ref(), normal.diffuse, textures)?,
            specular: color_input(self.specular.as_ref(), normal.specular, textures)?,
            shininess: float_input(
                self.shininess.as_ref(),
                NonNegative::f32,
                normal.shininess,
                TextureUse::Data,
                textures,
            )?,
            emission: color_input(self.emission.as_ref(), normal.emission, textures)?,
            mirror: color_input(self.mirror.as_ref(), normal.mirror, textures)?,
            transparency: color_input(self.transparency.as_ref(), normal.transparency, textures)?,
            ior: self.ior.map_or(normal.ior, Positive::f32),
            absorption: self.absorption.map_or(normal.absorption, |c| c.rgb()),
            fresnel: match self.fresnel {
                Some(true) => FresnelMode::Dielectric,
                Some(false) => FresnelMode::Off,
                None => normal.fresnel,
            },
        })
    }
}

/// A colour that a texture may vary; `absent` where it is left out.
pub(super) fn color_input(
    value: Option<&Texturable<Color>>,
    absent: ColorInput,
    textures: &mut impl FindTexture,
) -> Result<ColorInput, Fault> {
    match value {
        None => Ok(absent),
        Some(Texturable::Constant(color)) => Ok(ColorInput::constant(color.rgb())),
        Some(Texturable::Texture(Textured { channel: Some(channel), .. })) => {
            Err(Fault::new("a colour takes all channels of its texture")
                .with_help("remove `channel`")
                .or_at(channel.span()))
        }
        Some(Texturable::Texture(Textured { texture, factor, channel: None })) => Ok(ColorInput {
            factor: factor.map_or(Rgb::ONE, |factor| factor.rgb()),
            texture: Some(textures.find(texture, TextureUse::Color)?),
        }),
    }
}

/// A number that a texture may vary; `absent` where it is left out.
pub(super) fn float_input<T: Copy>(
    value: Option<&Texturable<T>>,
    single: fn(T) -> f32,
    absent: FloatInput,
    used_for: TextureUse,
    textures: &mut impl FindTexture,
) -> Result<FloatInput, Fault> {
    match value {
        None => Ok(absent),
        Some(Texturable::Constant(value)) => Ok(FloatInput::constant(single(*value))),
        Some(Texturable::Texture(Textured { texture, factor, channel })) => Ok(FloatInput {
            factor: factor.map_or(1.0, single),
            texture: Some(textures.find(texture, used_for)?),
            channel: channel.as_ref().map_or(Channel::Luminance, |channel| channel.channel()),
        }),
    }
}
