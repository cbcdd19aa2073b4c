//! The tree of a document: values with places, free to be edited.

use super::fault::Fault;
use super::placed::Span;
use toml::de::{DeTable, DeValue};

/// A value and where it was written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) span: Span,
    pub(crate) value: Value,
}

/// A TOML value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Bool(bool),
    Integer(i128),
    Float(f64),
    /// A number between keyframes: serves as a float and, rounded, as a whole number.
    Animated(f64),
    Text(String),
    /// A date or time, which no key of a scene takes.
    Date,
    Array(Vec<Node>),
    Table(Table),
    /// No value: whoever reads it gets the fault.
    Refused(Fault),
}

/// A key and where it was written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Key {
    pub(crate) text: String,
    pub(crate) span: Span,
}

/// Keys with values, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Table {
    pub(crate) entries: Vec<(Key, Node)>,
}

impl Table {
    /// The value of `key`.
    pub(crate) fn get(&self, key: &str) -> Option<&Node> {
        self.entries.iter().find(|(k, _)| k.text == key).map(|(_, node)| node)
    }

    /// The value of `key`, made by `absent` where there is none.
    pub(crate) fn entry(&mut self, key: Key, absent: impl FnOnce() -> Node) -> &mut Node {
        let index = match self.entries.iter().position(|(k, _)| k.text == key.text) {
            Some(index) => index,
            None => {
                self.entries.push((key, absent()));
                self.entries.len() - 1
            }
        };
        &mut self.entries[index].1
    }
}

impl Node {
    /// What kind of value this is, with its article.
    pub(crate) fn kind(&self) -> &'static str {
        match self.value {
            Value::Bool(_) => "true or false",
            Value::Integer(_) | Value::Float(_) | Value::Animated(_) => "a number",
            Value::Text(_) => "a text",
            Value::Date => "a date",
            Value::Array(_) => "an array",
            Value::Table(_) => "a table",
            Value::Refused(_) => "no value",
        }
    }

    /// The number, if this is one.
    pub(crate) fn number(&self) -> Option<f64> {
        match self.value {
            Value::Integer(v) => Some(v as f64),
            Value::Float(v) | Value::Animated(v) => Some(v),
            _ => None,
        }
    }
}

/// `value` as TOML would write it, whole ones without a fraction.
pub(super) fn float_text(value: f64) -> String {
    if value.is_nan() {
        return "nan".to_owned();
    }
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// The tree of a whole document, which is text number `source`.
///
/// # Errors
/// Where `text` is no TOML.
pub(crate) fn parse_document(text: &str, source: u32) -> Result<Node, Fault> {
    let root = DeTable::parse(text).map_err(|error| syntax_fault(&error, source, text, 0))?;
    let entries = table_from(root.get_ref(), source, 0)?;
    Ok(Node { span: Span::new(source, root.span()), value: Value::Table(entries) })
}

/// One value, which stands at byte `offset` of text number `source`.
///
/// # Errors
/// Where `text` is no TOML value.
pub(crate) fn parse_value(text: &str, source: u32, offset: usize) -> Result<Node, Fault> {
    let value = DeValue::parse(text).map_err(|error| syntax_fault(&error, source, text, offset))?;
    node_from(value.get_ref(), value.span(), source, offset)
}

fn syntax_fault(error: &toml::de::Error, source: u32, text: &str, offset: usize) -> Fault {
    let range = error.span().unwrap_or(text.len()..text.len());
    Fault::new(first_lower(error.message()))
        .or_at(Span::new(source, range.start + offset..range.end + offset))
}

/// The messages of this project start in lower case.
fn first_lower(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}

fn table_from(table: &DeTable<'_>, source: u32, offset: usize) -> Result<Table, Fault> {
    let mut entries = Vec::with_capacity(table.len());
    for (key, value) in table {
        let span = key.span();
        let key = Key {
            text: key.get_ref().to_string(),
            span: Span::new(source, span.start + offset..span.end + offset),
        };
        entries.push((key, node_from(value.get_ref(), value.span(), source, offset)?));
    }
    Ok(Table { entries })
}

fn node_from(
    value: &DeValue<'_>,
    range: std::ops::Range<usize>,
    source: u32,
    offset: usize,
) -> Result<Node, Fault> {
    let span = Span::new(source, range.start + offset..range.end + offset);
    let too_large = || Fault::new("the number is too large").or_at(span);
    let value = match value {
        DeValue::Boolean(v) => Value::Bool(*v),
        DeValue::Integer(v) => {
            Value::Integer(i128::from_str_radix(v.as_str(), v.radix()).map_err(|_| too_large())?)
        }
        DeValue::Float(v) => {
            let number: f64 = v.as_str().parse().map_err(|_| Fault::new("this is no number").or_at(span))?;
            if number.is_infinite() && !v.as_str().contains("inf") {
                return Err(too_large());
            }
            Value::Float(number)
        }
        DeValue::String(v) => Value::Text(v.to_string()),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(items) => {
            let nodes = items.iter().map(|item| node_from(item.get_ref(), item.span(), source, offset));
            Value::Array(nodes.collect::<Result<_, _>>()?)
        }
        DeValue::Table(table) => Value::Table(table_from(table, source, offset)?),
    };
    Ok(Node { span, value })
}
