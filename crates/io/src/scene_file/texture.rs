//! `[[texture]]`: images and patterns that vary the values of materials.
//!
//! # Scene file
//! ```toml
//! [[texture]]
//! name = "wood"
//! image = "wood.png"             # PNG, JPEG, HDR or EXR, relative to the scene file; "wood.<UDIM>.png" is wood.1001.png and so on,
//!                                # one for each unit square of uv
//! wrap = "repeat"                # "mirror", "clamp"; or wrap_u and wrap_v
//! filter = "bilinear"            # "nearest"
//! minify = "mip"                 # far away: means of many pixels; "bilinear" or "nearest" look at few of them
//! encoding = "auto"              # "srgb", "linear"; auto: as the file says, and linear for bump and normal maps
//! scale = 1                      # or [u, v]: repetitions
//! rotation = 0                   # degrees
//! offset = [0, 0]
//!
//! [[texture]]
//! name = "tiles"
//! # space = "local" makes cubes of one metre in the space of the object
//! checker = { even = 0.8, odd = [0.1, 0.1, 0.2], space = "uv" }
//! scale = 4
//! ```

use super::choice::{choice, exactly_one, without_effect};
use super::number::{NonZero, Number};
use super::value::{Color, Splat};
use crate::document::{Fault, Placed, Span};
use crate::error::quote;
use crate::udim;
use glam::Vec2;
use heliostat_scene::texture::{CheckerSpace, Filtering, Minify, Pattern, UvSet, UvTransform, Wrap};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An image or a pattern.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TextureTable {
    /// Name, unique among textures.
    pub name: Placed<String>,
    /// Path of a PNG, JPEG, HDR or EXR file, relative to the scene file. `<UDIM>` in the name stands for the numbers of many files, one for each
    /// unit square of the surface parameters: 1001 at the origin, plus `u`, plus ten times `v`.
    pub image: Option<Placed<String>>,
    /// Squares of two colours in turn.
    pub checker: Option<Placed<CheckerTable>>,
    /// What happens outside the image, in both directions; `repeat` if left out.
    pub wrap: Option<Placed<WrapMode>>,
    /// What happens outside the image in u.
    pub wrap_u: Option<Placed<WrapMode>>,
    /// What happens outside the image in v.
    pub wrap_v: Option<Placed<WrapMode>>,
    /// How values between pixels are found; `bilinear` if left out.
    pub filter: Option<Placed<FilterMode>>,
    /// What is seen where the image is smaller than its pixels; `mip` if left out.
    pub minify: Option<Placed<MinifyMode>>,
    /// How stored values map to light; `auto` if left out.
    pub encoding: Option<Placed<EncodingMode>>,
    /// Repetitions, a number or `[u, v]`; 1 if left out.
    pub scale: Option<Splat<NonZero, 2>>,
    /// Turn of the surface parameters in degrees, counter-clockwise; 0 if left out.
    pub rotation: Option<Placed<Number>>,
    /// Shift of the surface parameters, after scale and turn; `[0, 0]` if left out.
    pub offset: Option<Placed<[Number; 2]>>,
    /// The command that makes the image, shown when it is missing.
    pub made_by: Option<Placed<String>>,
}

/// Squares of two colours in turn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckerTable {
    /// Colour of the square at the origin.
    pub even: Color,
    /// Colour of its neighbours.
    pub odd: Color,
    /// What is divided; `uv` if left out.
    pub space: Option<CheckerSpaceName>,
}

/// What a checker divides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CheckerSpaceName {
    /// Squares of side 1 in the texture coordinates.
    Uv,
    /// Cubes of side 1 metre in the space of the object.
    Local,
}

/// What happens outside an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WrapMode {
    /// The image starts again.
    Repeat,
    /// Every second repetition is mirrored.
    Mirror,
    /// The border goes on for ever.
    Clamp,
}

/// How values between pixels are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FilterMode {
    /// Linear between four pixels.
    Bilinear,
    /// The nearest pixel.
    Nearest,
}

/// What is seen where the image is smaller than its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MinifyMode {
    /// The mean of all pixels that a look takes in.
    Mip,
    /// Linear between the four nearest pixels.
    Bilinear,
    /// The nearest pixel.
    Nearest,
}

/// How stored values map to light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EncodingMode {
    /// As the file says; linear for bump and normal maps, shininess and opacity.
    #[default]
    Auto,
    /// The sRGB transfer function.
    Srgb,
    /// Stored values are the values.
    Linear,
}

impl TextureTable {
    /// Refuses a texture that is nothing or two things, and keys that would do nothing.
    pub(super) fn check(&self, table: Option<Span>) -> Result<(), Fault> {
        let owner = format!("the texture {}", quote(&self.name));
        let kinds = [choice("image", self.image.as_ref()), choice("checker", self.checker.as_ref())];
        exactly_one(&owner, "pattern", table, &kinds)?;
        let wraps = [choice("wrap_u", self.wrap_u.as_ref()), choice("wrap_v", self.wrap_v.as_ref())];
        if self.wrap.is_some() {
            without_effect("beside `wrap`", &wraps)?;
        }
        if self.image.as_ref().is_some_and(|image| udim::is_tiled(image)) {
            let wrap = [choice("wrap", self.wrap.as_ref())];
            without_effect("on tiles", &wrap)?;
            without_effect("on tiles", &wraps)?;
        }
        if let Some(checker) = &self.checker {
            let image_keys = [
                choice("wrap", self.wrap.as_ref()),
                choice("filter", self.filter.as_ref()),
                choice("minify", self.minify.as_ref()),
                choice("encoding", self.encoding.as_ref()),
                choice("made_by", self.made_by.as_ref()),
            ];
            without_effect("on a checker", &wraps)?;
            without_effect("on a checker", &image_keys)?;
            if checker.space == Some(CheckerSpaceName::Local) {
                let uv_keys =
                    [choice("rotation", self.rotation.as_ref()), choice("offset", self.offset.as_ref())];
                without_effect("on a checker in local space", &uv_keys)?;
            }
        }
        Ok(())
    }

    /// How stored values map to light.
    pub(super) fn encoding(&self) -> EncodingMode {
        self.encoding.as_deref().copied().unwrap_or_default()
    }

    /// Wrapping in u and v.
    pub(super) fn wraps(&self) -> [Wrap; 2] {
        [&self.wrap_u, &self.wrap_v].map(|own| match own.as_deref().or(self.wrap.as_deref()) {
            None | Some(WrapMode::Repeat) => Wrap::Repeat,
            Some(WrapMode::Mirror) => Wrap::Mirror,
            Some(WrapMode::Clamp) => Wrap::Clamp,
        })
    }

    /// Filtering between pixels.
    pub(super) fn filtering(&self) -> Filtering {
        match self.filter.as_deref() {
            None | Some(FilterMode::Bilinear) => Filtering::Bilinear,
            Some(FilterMode::Nearest) => Filtering::Nearest,
        }
    }

    /// Filtering of many pixels at once.
    pub(super) fn minify(&self) -> Minify {
        match self.minify.as_deref() {
            None | Some(MinifyMode::Mip) => Minify::Mip,
            Some(MinifyMode::Bilinear) => Minify::Bilinear,
            Some(MinifyMode::Nearest) => Minify::Nearest,
        }
    }

    /// The change of the surface parameters.
    pub(super) fn uv_transform(&self) -> UvTransform {
        let scale = self.scale.map_or([1.0; 2], |scale| scale.values().map(NonZero::f32));
        UvTransform {
            set: UvSet::First,
            scale: Vec2::from_array(scale),
            rotation: self.rotation.as_ref().map_or(0.0, |r| r.get().to_radians() as f32),
            offset: self.offset.as_ref().map_or(Vec2::ZERO, |o| Vec2::from_array(o.map(Number::f32))),
        }
    }
}

impl CheckerTable {
    /// The pattern.
    pub(super) fn pattern(&self) -> Pattern {
        let space = match self.space {
            None | Some(CheckerSpaceName::Uv) => CheckerSpace::Uv,
            Some(CheckerSpaceName::Local) => CheckerSpace::Local,
        };
        Pattern::Checker { even: self.even.rgb(), odd: self.odd.rgb(), space }
    }
}
