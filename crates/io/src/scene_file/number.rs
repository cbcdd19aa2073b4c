//! Numbers with a range: what is out of range is refused where it stands.
//!
//! Every number must also survive the rounding to the single precision of the renderer: `1e-60` is no radius and
//! `1e60` no position, although TOML can write both.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};
use serde::ser::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

macro_rules! number {
    ($(#[$doc:meta])* $name:ident, $expected:literal, $allows:expr, $schema:tt) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
        pub struct $name(f64);

        impl $name {
            /// The value, where it is in range.
            pub fn new(value: f64) -> Option<Self> {
                let allows: fn(f64) -> bool = $allows;
                let single = f64::from(value as f32);
                (single.is_finite() && allows(value) && allows(single)).then_some(Self(value))
            }

            /// The value.
            pub fn get(self) -> f64 {
                self.0
            }

            /// The value in the precision of the renderer.
            pub fn f32(self) -> f32 {
                self.0 as f32
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let value = deserializer.deserialize_f64(FloatVisitor($expected))?;
                Self::new(value)
                    .ok_or_else(|| D::Error::invalid_value(Unexpected::Float(value), &$expected))
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_f64(self.0)
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!($schema)
            }
        }
    };
}

number!(
    /// Any finite number.
    Number, "a finite number", |_| true, { "type": "number" }
);
number!(
    /// A number above 0.
    Positive, "a number above 0", |v| v > 0.0, { "type": "number", "exclusiveMinimum": 0 }
);
number!(
    /// A number of at least 0.
    NonNegative, "a number of at least 0", |v| v >= 0.0, { "type": "number", "minimum": 0 }
);
number!(
    /// A number of at least 1.
    AtLeastOne, "a number of at least 1", |v| v >= 1.0, { "type": "number", "minimum": 1 }
);
number!(
    /// A number other than 0.
    NonZero, "a number other than 0", |v| v != 0.0, { "type": "number", "not": { "const": 0 } }
);
number!(
    /// A number from 0 to 1.
    Fraction, "a number from 0 to 1", |v| (0.0..=1.0).contains(&v), { "type": "number", "minimum": 0, "maximum": 1 }
);
number!(
    /// A number above -1 and below 1.
    Asymmetry, "a number above -1 and below 1", |v| v > -1.0 && v < 1.0,
    { "type": "number", "exclusiveMinimum": -1, "exclusiveMaximum": 1 }
);
number!(
    /// An angle from 0 to 180 degrees.
    HalfTurn, "an angle from 0 to 180 degrees", |v| (0.0..=180.0).contains(&v),
    { "type": "number", "minimum": 0, "maximum": 180 }
);
number!(
    /// An angle above 0 and up to 360 degrees.
    Turn, "an angle above 0 and up to 360 degrees", |v| v > 0.0 && v <= 360.0,
    { "type": "number", "exclusiveMinimum": 0, "maximum": 360 }
);

impl NonNegative {
    /// Nothing.
    pub const ZERO: Self = Self(0.0);
    /// One.
    pub const ONE: Self = Self(1.0);

    /// `value`, or 0 where it is not in range.
    pub fn or_zero(value: f32) -> Self {
        Self::new(f64::from(value)).unwrap_or(Self::ZERO)
    }
}

struct FloatVisitor(&'static str);

impl Visitor<'_> for FloatVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f64, E> {
        Ok(value)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }
}

/// A whole number from `MIN` to `MAX`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Whole<const MIN: i64, const MAX: i64>(i64);

/// A count of at least 1.
pub type Count = Whole<1, { u32::MAX as i64 }>;

impl<const MIN: i64, const MAX: i64> Whole<MIN, MAX> {
    /// The value, where it is in range.
    pub fn new(value: i64) -> Option<Self> {
        (MIN..=MAX).contains(&value).then_some(Self(value))
    }

    /// The value.
    pub fn get(self) -> i64 {
        self.0
    }

    /// The value of a range that lies within that of `u32`; others end at its borders.
    pub fn u32(self) -> u32 {
        self.0.clamp(0, i64::from(u32::MAX)) as u32
    }

    fn expected() -> String {
        match (MIN, MAX) {
            (i64::MIN, i64::MAX) => "a whole number".to_owned(),
            (_, max) if max >= i64::from(u32::MAX) => format!("a whole number of at least {MIN}"),
            _ => format!("a whole number from {MIN} to {MAX}"),
        }
    }
}

impl<'de, const MIN: i64, const MAX: i64> Deserialize<'de> for Whole<MIN, MAX> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = deserializer.deserialize_i64(WholeVisitor(Self::expected()))?;
        Self::new(value)
            .ok_or_else(|| D::Error::invalid_value(Unexpected::Signed(value), &Self::expected().as_str()))
    }
}

struct WholeVisitor(String);

impl Visitor<'_> for WholeVisitor {
    type Value = i64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<i64, E> {
        Ok(value)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<i64, E> {
        i64::try_from(value).map_err(|_| E::invalid_value(Unexpected::Unsigned(value), &self))
    }
}

impl<const MIN: i64, const MAX: i64> Serialize for Whole<MIN, MAX> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_i64(self.0)
    }
}

impl<const MIN: i64, const MAX: i64> JsonSchema for Whole<MIN, MAX> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Whole_{MIN}_{MAX}").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "minimum": MIN, "maximum": MAX })
    }
}
