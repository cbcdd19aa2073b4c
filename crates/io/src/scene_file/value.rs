//! Values that can be written in more than one way: numbers or arrays, points or names.

use super::number::{NonNegative, Number};
use glam::{DVec3, Vec3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::SeqAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, IntoDeserializer, SeqAccess, Unexpected, Visitor};
use serde::ser::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// A point or displacement, `[x, y, z]` in metres.
pub type Point = [Number; 3];

/// `[x, y, z]` as a vector.
pub(crate) fn vector(point: &Point) -> DVec3 {
    DVec3::from_array(point.map(Number::get))
}

/// A colour in linear Rec.709: a number for grey, or `[red, green, blue]`, of at least 0 and unbounded above.
pub type Color = Splat<NonNegative, 3>;

impl Color {
    /// Red, green and blue.
    pub fn rgb(&self) -> Vec3 {
        Vec3::from_array(self.values().map(NonNegative::f32))
    }

    /// The colour of three numbers, those below 0 or not finite taken as 0.
    pub fn from_rgb(rgb: Vec3) -> Self {
        Self::Each([rgb.x, rgb.y, rgb.z].map(NonNegative::or_zero))
    }
}

/// One number for all, or an array of `N` numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Splat<T, const N: usize> {
    /// The same number `N` times.
    All(T),
    /// One number each.
    Each([T; N]),
}

impl<T: Copy, const N: usize> Splat<T, N> {
    /// The `N` numbers.
    pub fn values(&self) -> [T; N] {
        match self {
            Self::All(value) => [*value; N],
            Self::Each(values) => *values,
        }
    }
}

impl<const N: usize> Splat<NonNegative, N> {
    /// Zero.
    pub const ZERO: Self = Self::All(NonNegative::ZERO);
    /// One.
    pub const ONE: Self = Self::All(NonNegative::ONE);
}

impl<T: Serialize, const N: usize> Serialize for Splat<T, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::All(value) => value.serialize(serializer),
            Self::Each(values) => values.as_slice().serialize(serializer),
        }
    }
}

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Splat<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SplatVisitor(PhantomData))
    }
}

struct SplatVisitor<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for SplatVisitor<T, N> {
    type Value = Splat<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a number or an array of {N} numbers")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Splat::All)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Splat::All)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Splat::All)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
        let mut values = Vec::with_capacity(N);
        while let Some(value) = items.next_element()? {
            values.push(value);
        }
        let found = format!("{} of them", values.len());
        match values.try_into() {
            Ok(values) => Ok(Splat::Each(values)),
            Err(_) => Err(A::Error::invalid_value(Unexpected::Other(&found), &self)),
        }
    }
}

impl<T: JsonSchema, const N: usize> JsonSchema for Splat<T, N> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("{}_or_{N}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = generator.subschema_for::<T>();
        json_schema!({ "anyOf": [one, { "type": "array", "items": one, "minItems": N, "maxItems": N }] })
    }
}

/// A point `[x, y, z]`, or the name of an object or model: the centre of the box around it.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A point in world space.
    Point(Point),
    /// The name of an object or model; the target follows it.
    Object(String),
}

impl Serialize for Target {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Point(point) => point.serialize(serializer),
            Self::Object(name) => name.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Target {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TargetVisitor)
    }
}

struct TargetVisitor;

impl<'de> Visitor<'de> for TargetVisitor {
    type Value = Target;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a point [x, y, z] or the name of an object")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Target, E> {
        Ok(Target::Object(name.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Target, A::Error> {
        Point::deserialize(SeqAccessDeserializer::new(items)).map(Target::Point)
    }
}

impl JsonSchema for Target {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Target".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let point = generator.subschema_for::<Point>();
        json_schema!({ "anyOf": [point, { "type": "string" }] })
    }
}
