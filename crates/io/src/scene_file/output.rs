//! `[output]`: how pictures are written.
//!
//! # Scene file
//! ```toml
//! [output]                       # these are the defaults
//! view = "standard"              # PNG: "agx", "aces", "neutral"
//! exposure = 0                   # PNG: stops
//! png_bits = 8                   # or 16
//! exr_depth = "half"             # of colours in EXR: or "float"; data layers are always float
//! ```

use super::number::Number;
use crate::png_file::PngBits;
use crate::view::{View, ViewTransform};
use heliostat_scene::frame::Depth;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error, Unexpected};
use serde::{Deserialize, Serialize, Serializer};
use std::borrow::Cow;

/// How pictures are written.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutputTable {
    /// How light is brought into the range of a PNG; `standard` if left out.
    pub view: Option<ViewName>,
    /// Stops of brightening of a PNG; 0 if left out.
    pub exposure: Option<Number>,
    /// Bits per channel of a PNG, 8 or 16; 8 if left out.
    pub png_bits: Option<PngBits>,
    /// How colours are stored in EXR; `half` if left out.
    pub exr_depth: Option<ExrDepth>,
}

/// How light is brought into the range of a display.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ViewName {
    /// Clipped.
    Standard,
    /// AgX.
    Agx,
    /// The ACES reference look.
    Aces,
    /// Khronos PBR Neutral.
    Neutral,
}

/// How colours are stored in EXR.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ExrDepth {
    /// 16-bit floats.
    Half,
    /// 32-bit floats.
    Float,
}

impl Serialize for PngBits {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u8(self.count())
    }
}

impl<'de> Deserialize<'de> for PngBits {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match i64::deserialize(deserializer)? {
            8 => Ok(Self::Eight),
            16 => Ok(Self::Sixteen),
            other => Err(D::Error::invalid_value(Unexpected::Signed(other), &"8 or 16")),
        }
    }
}

impl JsonSchema for PngBits {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "PngBits".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "enum": [8, 16] })
    }
}

/// How pictures of a scene want to be written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Output {
    /// Bits per channel of a PNG.
    pub png_bits: PngBits,
    /// How colours are stored in EXR.
    pub exr_depth: Depth,
}

impl OutputTable {
    /// The view of a PNG; of `usual_exposure`, in stops, where the file gives none.
    pub(crate) fn view(&self, usual_exposure: f32) -> View {
        let transform = match self.view {
            None => ViewTransform::default(),
            Some(ViewName::Standard) => ViewTransform::Standard,
            Some(ViewName::Agx) => ViewTransform::Agx,
            Some(ViewName::Aces) => ViewTransform::Aces,
            Some(ViewName::Neutral) => ViewTransform::Neutral,
        };
        View { transform, exposure: self.exposure.map_or(usual_exposure, Number::f32) }
    }

    /// How pictures want to be written.
    pub(crate) fn output(&self) -> Output {
        Output {
            png_bits: self.png_bits.unwrap_or_default(),
            exr_depth: match self.exr_depth {
                None | Some(ExrDepth::Half) => Depth::Half,
                Some(ExrDepth::Float) => Depth::Float,
            },
        }
    }
}
