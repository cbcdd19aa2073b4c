//! Reading and writing `[camera]` and `[[camera]]` alike, without losing places.

use super::camera::{CameraTable, Cameras};
use crate::document::Placed;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

impl Serialize for Cameras {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::One(camera) => camera.serialize(serializer),
            Self::Many(cameras) => cameras.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Cameras {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CamerasVisitor)
    }
}

struct CamerasVisitor;

impl<'de> Visitor<'de> for CamerasVisitor {
    type Value = Cameras;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table [camera] or several [[camera]]")
    }

    fn visit_map<A: MapAccess<'de>>(self, entries: A) -> Result<Cameras, A::Error> {
        CameraTable::deserialize(MapAccessDeserializer::new(entries))
            .map(|camera| Cameras::One(Box::new(camera)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Cameras, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(items)).map(Cameras::Many)
    }
}

impl JsonSchema for Cameras {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Cameras".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = generator.subschema_for::<CameraTable>();
        let many = generator.subschema_for::<Vec<Placed<CameraTable>>>();
        json_schema!({ "anyOf": [one, many] })
    }
}
