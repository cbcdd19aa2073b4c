//! One key: a time and a value of any form.

use crate::document::{Node, Placed, Span, Value};
use crate::scene_file::number::Number;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde::ser::{Serialize, SerializeTuple, Serializer};
use std::borrow::Cow;
use std::fmt;

/// `[seconds, value]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframe {
    /// Time in seconds from the first frame.
    pub time: Placed<Number>,
    /// The value at that time.
    pub value: Placed<KeyValue>,
}

/// The value of a key: a number, an array of values, or for `step` anything that is no table.
#[derive(Clone, Debug, PartialEq)]
pub enum KeyValue {
    /// A number.
    Number(f64),
    /// `true` or `false`.
    Bool(bool),
    /// A text.
    Text(String),
    /// An array.
    Array(Vec<Self>),
}

impl KeyValue {
    /// The value in a document, at a place.
    pub(super) fn node(&self, span: Span) -> Node {
        let value = match self {
            Self::Number(v) => Value::Animated(*v),
            Self::Bool(v) => Value::Bool(*v),
            Self::Text(v) => Value::Text(v.clone()),
            Self::Array(items) => Value::Array(items.iter().map(|item| item.node(span)).collect()),
        };
        Node { span, value }
    }

    /// Appends all numbers to `out`; `None` when something else is in the value.
    pub(super) fn numbers(&self, out: &mut Vec<f64>) -> Option<()> {
        match self {
            Self::Number(v) => out.push(*v),
            Self::Array(items) => items.iter().try_for_each(|item| item.numbers(out))?,
            Self::Bool(_) | Self::Text(_) => return None,
        }
        Some(())
    }

    /// The same form with other numbers.
    pub(super) fn with_numbers(&self, numbers: &mut impl Iterator<Item = f64>) -> Self {
        match self {
            Self::Number(v) => Self::Number(numbers.next().unwrap_or(*v)),
            Self::Array(items) => Self::Array(items.iter().map(|item| item.with_numbers(numbers)).collect()),
            other => other.clone(),
        }
    }

    /// Whether both are numbers, or arrays of the same form.
    pub(super) fn has_form_of(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Number(_), Self::Number(_)) => true,
            (Self::Array(a), Self::Array(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.has_form_of(b))
            }
            _ => false,
        }
    }
}

impl Serialize for Keyframe {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut pair = serializer.serialize_tuple(2)?;
        pair.serialize_element(&self.time)?;
        pair.serialize_element(&self.value)?;
        pair.end()
    }
}

impl<'de> Deserialize<'de> for Keyframe {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(KeyframeVisitor)
    }
}

struct KeyframeVisitor;

impl<'de> Visitor<'de> for KeyframeVisitor {
    type Value = Keyframe;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key [seconds, value]")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut parts: A) -> Result<Keyframe, A::Error> {
        let missing = || A::Error::custom("expected a key [seconds, value]");
        let time = parts.next_element()?.ok_or_else(missing)?;
        let value = parts.next_element()?.ok_or_else(missing)?;
        Ok(Keyframe { time, value })
    }
}

impl JsonSchema for Keyframe {
    fn schema_name() -> Cow<'static, str> {
        "Keyframe".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let value = generator.subschema_for::<KeyValue>();
        json_schema!({
            "description": "A key [seconds, value].",
            "type": "array",
            "prefixItems": [{ "type": "number" }, value],
            "minItems": 2,
            "maxItems": 2
        })
    }
}

impl Serialize for KeyValue {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(v) => serializer.serialize_f64(*v),
            Self::Bool(v) => serializer.serialize_bool(*v),
            Self::Text(v) => serializer.serialize_str(v),
            Self::Array(items) => items.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for KeyValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(KeyValueVisitor)
    }
}

struct KeyValueVisitor;

impl<'de> Visitor<'de> for KeyValueVisitor {
    type Value = KeyValue;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or an array of numbers")
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<KeyValue, E> {
        Ok(KeyValue::Bool(value))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<KeyValue, E> {
        if value.is_finite() {
            return Ok(KeyValue::Number(value));
        }
        Err(E::invalid_value(serde::de::Unexpected::Float(value), &"a finite number"))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<KeyValue, E> {
        Ok(KeyValue::Number(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<KeyValue, E> {
        Ok(KeyValue::Number(value as f64))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<KeyValue, E> {
        Ok(KeyValue::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<KeyValue, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = items.next_element()? {
            values.push(value);
        }
        Ok(KeyValue::Array(values))
    }
}

impl JsonSchema for KeyValue {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "KeyValue".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["number", "array", "boolean", "string"] })
    }
}
