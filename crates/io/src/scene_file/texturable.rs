//! Values that a texture may vary: a constant, or a texture times a factor.
//!
//! # Scene file
//! ```toml
//! ambient = 0.7                                        # grey
//! mirror = [0.7, 0.2, 0.1]                             # a colour
//! specular = { texture = "wood" }                      # the texture as it is
//! diffuse = { texture = "wood", factor = [1, 0.9, 0.8] }
//! shininess = { texture = "packed", factor = 100, channel = "g" }  # green alone; luminance if left out
//! ```

use crate::document::Placed;
use heliostat_scene::material::Channel;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, Error, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};
use serde::{Deserialize as DeserializeTable, Serialize as SerializeTable};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// A value that a texture may vary.
#[derive(Clone, Debug, PartialEq)]
pub enum Texturable<T> {
    /// The same everywhere.
    Constant(T),
    /// A texture times a factor.
    Texture(Textured<T>),
}

/// `{ texture = "name", factor = 1.0 }`.
#[derive(Clone, Debug, PartialEq, SerializeTable, DeserializeTable, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Textured<T> {
    /// The name of a `[[texture]]`.
    pub texture: Placed<String>,
    /// What the texture is multiplied by; 1 if left out.
    pub factor: Option<T>,
    /// Which channel of the texture gives a number: `r`, `g`, `b` or `a`; its luminance if left out.
    pub channel: Option<Placed<ChannelName>>,
}

/// A channel of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, SerializeTable, DeserializeTable, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ChannelName {
    /// Red.
    R,
    /// Green.
    G,
    /// Blue.
    B,
    /// Alpha.
    A,
}

impl ChannelName {
    /// The channel of the scene.
    pub(super) fn channel(self) -> Channel {
        match self {
            Self::R => Channel::R,
            Self::G => Channel::G,
            Self::B => Channel::B,
            Self::A => Channel::A,
        }
    }
}

impl<T: Serialize> Serialize for Texturable<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Constant(value) => value.serialize(serializer),
            Self::Texture(textured) => textured.serialize(serializer),
        }
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Texturable<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TexturableVisitor(PhantomData))
    }
}

struct TexturableVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for TexturableVisitor<T> {
    type Value = Texturable<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, a colour or { texture = \"name\" }")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Texturable::Constant)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Texturable::Constant)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Texturable::Constant)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Self::Value, A::Error> {
        T::deserialize(SeqAccessDeserializer::new(items)).map(Texturable::Constant)
    }

    fn visit_map<A: MapAccess<'de>>(self, entries: A) -> Result<Self::Value, A::Error> {
        Textured::deserialize(MapAccessDeserializer::new(entries)).map(Texturable::Texture)
    }
}

impl<T: JsonSchema> JsonSchema for Texturable<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Texturable_{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let constant = generator.subschema_for::<T>();
        let textured = generator.subschema_for::<Textured<T>>();
        json_schema!({ "anyOf": [constant, textured] })
    }
}
