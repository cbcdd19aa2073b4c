//! Reading typed tables out of the tree through serde, so that every fault has its place.

use super::fault::Fault;
use super::node::{Key, Node, Value};
use super::placed::{PLACED, Span};
use crate::error::quote;
use serde::de::value::{BorrowedStrDeserializer, U32Deserializer};
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error, IntoDeserializer, MapAccess, SeqAccess, Unexpected,
    VariantAccess, Visitor,
};

impl Node {
    /// Reads a typed value.
    ///
    /// # Errors
    /// Where the tree does not have the form of `T`.
    pub(crate) fn read<'de, T: serde::Deserialize<'de>>(&'de self) -> Result<T, Fault> {
        T::deserialize(self)
    }

    fn unexpected(&self) -> Unexpected<'_> {
        match &self.value {
            Value::Bool(v) => Unexpected::Bool(*v),
            Value::Integer(v) => Unexpected::Signed((*v).clamp(i64::MIN.into(), i64::MAX.into()) as i64),
            Value::Float(v) | Value::Animated(v) => Unexpected::Float(*v),
            Value::Text(v) => Unexpected::Str(v),
            Value::Date => Unexpected::Other("a date"),
            Value::Array(_) => Unexpected::Seq,
            Value::Table(_) => Unexpected::Map,
            Value::Refused(_) => Unexpected::Other("no value"),
        }
    }

    fn fault_expected(&self, what: &str) -> Fault {
        if let Value::Refused(fault) = &self.value {
            return fault.clone().or_at(self.span);
        }
        Fault::new(format!("expected {what}, found {}", super::fault::described(self.unexpected())))
            .or_at(self.span)
    }

    fn visit<'de, V: Visitor<'de>>(&'de self, visitor: V) -> Result<V::Value, Fault> {
        match &self.value {
            Value::Bool(v) => visitor.visit_bool(*v),
            Value::Integer(v) => visit_integer(*v, visitor),
            Value::Float(v) | Value::Animated(v) => visitor.visit_f64(*v),
            Value::Text(v) => visitor.visit_borrowed_str(v),
            Value::Date => Err(Error::invalid_type(self.unexpected(), &visitor)),
            Value::Refused(fault) => Err(fault.clone()),
            Value::Array(items) => {
                let mut rest = items.iter();
                let value = visitor.visit_seq(Items(&mut rest))?;
                match rest.len() {
                    0 => Ok(value),
                    left => Err(Fault::new(format!(
                        "expected an array of {} values, found {}",
                        items.len() - left,
                        items.len()
                    ))),
                }
            }
            Value::Table(table) => {
                visitor.visit_map(Entries { entries: table.entries.iter(), current: None })
            }
        }
        .map_err(|fault| fault.or_at(self.span))
    }
}

fn visit_integer<'de, V: Visitor<'de>>(value: i128, visitor: V) -> Result<V::Value, Fault> {
    if let Ok(value) = i64::try_from(value) {
        visitor.visit_i64(value)
    } else if let Ok(value) = u64::try_from(value) {
        visitor.visit_u64(value)
    } else {
        Err(Fault::new("the number is too large"))
    }
}

macro_rules! whole_numbers {
    ($($method:ident)*) => {
        $(fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
            match self.value {
                // Between two keyframes a whole number takes the nearest whole value.
                Value::Animated(v) => {
                    visitor.visit_i64(v.round() as i64).map_err(|fault: Fault| fault.or_at(self.span))
                }
                _ => self.visit(visitor),
            }
        })*
    };
}

impl<'de> Deserializer<'de> for &'de Node {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.visit(visitor)
    }

    whole_numbers! {
        deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64
        deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        if name == PLACED {
            return visitor.visit_seq(PlacedParts { node: self, next: 0 });
        }
        visitor.visit_newtype_struct(self)
    }

    /// Derived visitors would take an array for a struct, in the order of its fields: here only a table is one.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match self.value {
            Value::Table(_) => self.visit(visitor),
            _ => Err(self.fault_expected("a table")),
        }
    }

    /// Enums of a scene file are words.
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match &self.value {
            Value::Text(word) => visitor.visit_enum(Word(word)).map_err(|fault| fault.or_at(self.span)),
            _ => {
                let words: Vec<_> = variants.iter().map(|word| quote(word)).collect();
                Err(self.fault_expected(&format!("one of {}", words.join(", "))))
            }
        }
    }

    serde::forward_to_deserialize_any! {
        bool i128 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple tuple_struct map
        identifier ignored_any
    }
}

struct Items<'a, 'de>(&'a mut std::slice::Iter<'de, Node>);

impl<'de> SeqAccess<'de> for Items<'_, 'de> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        self.0.next().map(|node| seed.deserialize(node).map_err(|fault| fault.or_at(node.span))).transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

struct Entries<'de> {
    entries: std::slice::Iter<'de, (Key, Node)>,
    current: Option<&'de (Key, Node)>,
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        self.current = self.entries.next();
        let read = |(key, _): &'de (Key, Node)| {
            let text = BorrowedStrDeserializer::new(key.text.as_str());
            seed.deserialize(text).map_err(|fault: Fault| fault.or_at(key.span))
        };
        self.current.map(read).transpose()
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Fault> {
        let (key, node) = self.current.take().ok_or_else(|| Fault::new("a value without its key"))?;
        seed.deserialize(node).map_err(|fault| fault.or_at(node.span).in_table(&key.text))
    }
}

/// The span of a node, number by number, and then the node.
struct PlacedParts<'de> {
    node: &'de Node,
    next: u8,
}

impl<'de> SeqAccess<'de> for PlacedParts<'de> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        let Span { source, start, end } = self.node.span;
        let part = self.next;
        self.next += 1;
        let number = |value: u32| -> U32Deserializer<Fault> { value.into_deserializer() };
        match part {
            0 => seed.deserialize(number(source)).map(Some),
            1 => seed.deserialize(number(start)).map(Some),
            2 => seed.deserialize(number(end)).map(Some),
            3 => seed.deserialize(self.node).map(Some),
            _ => Ok(None),
        }
    }
}

struct Word<'de>(&'de str);

impl<'de> EnumAccess<'de> for Word<'de> {
    type Error = Fault;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Fault> {
        let value = seed.deserialize(BorrowedStrDeserializer::<Fault>::new(self.0))?;
        Ok((value, self))
    }
}

impl<'de> VariantAccess<'de> for Word<'de> {
    type Error = Fault;

    fn unit_variant(self) -> Result<(), Fault> {
        Ok(())
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, _seed: T) -> Result<T::Value, Fault> {
        Err(Fault::new(format!("{} needs a value", quote(self.0))))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _len: usize, _visitor: V) -> Result<V::Value, Fault> {
        Err(Fault::new(format!("{} needs a value", quote(self.0))))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _fields: &'static [&'static str],
        _visitor: V,
    ) -> Result<V::Value, Fault> {
        Err(Fault::new(format!("{} needs a value", quote(self.0))))
    }
}
