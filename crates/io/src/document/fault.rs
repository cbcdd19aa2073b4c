//! What is wrong with a document, before it is known which text the place belongs to.

use super::node::float_text;
use super::placed::Span;
use crate::error::quote;
use crate::nearest::suggestion;
use serde::de::{Error, Expected, Unexpected};
use std::fmt;

/// One sentence about a place in a document.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault(Box<Content>);

#[derive(Clone, Debug, PartialEq)]
struct Content {
    span: Option<Span>,
    message: String,
    help: Option<String>,
    /// Whether the name of the table that the fault lies in makes the message clearer.
    wants_table: bool,
}

impl Fault {
    /// A fault without a place.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self(Box::new(Content { span: None, message: message.into(), help: None, wants_table: false }))
    }

    /// Sets the place, unless there is a nearer one already.
    #[must_use]
    pub(crate) fn or_at(mut self, span: impl Into<Option<Span>>) -> Self {
        self.0.span = self.0.span.or(span.into());
        self
    }

    /// Sets the mend.
    #[must_use]
    pub(crate) fn with_help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Names the table in the message, where it asked for one.
    #[must_use]
    pub(super) fn in_table(mut self, key: &str) -> Self {
        if std::mem::take(&mut self.0.wants_table) {
            self.0.message = format!("{} in {}", self.0.message, quote(key));
        }
        self
    }

    /// The name `name` is not one of `known`.
    pub(crate) fn unknown<'a>(
        kind: &str,
        name: &str,
        known: impl IntoIterator<Item = &'a str> + Clone,
    ) -> Self {
        let mut fault = Self::new(format!("unknown {kind} {}", quote(name)));
        fault.0.help = suggestion(name, known);
        fault
    }

    /// The place, if one is known.
    pub(crate) fn span(&self) -> Option<Span> {
        self.0.span
    }

    /// The sentence.
    pub(crate) fn message(&self) -> &str {
        &self.0.message
    }

    /// The mend.
    pub(crate) fn help(&self) -> Option<&str> {
        self.0.help.as_deref()
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.message)
    }
}

impl std::error::Error for Fault {}

impl Error for Fault {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(message.to_string())
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        let expected = plain(&expected.to_string());
        let fault = Self::new(format!("expected {expected}, found {}", described(found)));
        match found {
            Unexpected::Str(text) if is_bare_value(text) => fault.with_help("remove the quotes"),
            Unexpected::Str(_) | Unexpected::Map | Unexpected::Seq => fault,
            _ if expected.contains("in quotes") => fault.with_help("put it in quotes"),
            _ => fault,
        }
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::invalid_type(found, expected)
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Self::new(format!("expected {}, found {length}", plain(&expected.to_string())))
    }

    fn unknown_variant(name: &str, known: &'static [&'static str]) -> Self {
        Self::unknown("value", name, known.iter().copied())
    }

    fn unknown_field(name: &str, known: &'static [&'static str]) -> Self {
        let fault = Self::unknown("key", name, known.iter().copied());
        if fault.help().is_some() {
            return fault;
        }
        let known: Vec<_> = known.iter().map(|key| quote(key)).collect();
        fault.with_help(format!("known: {}", known.join(", ")))
    }

    fn missing_field(name: &'static str) -> Self {
        let mut fault = Self::new(format!("missing key {}", quote(name)))
            .with_help(format!("add {}", quote(&format!("{name} = ..."))));
        fault.0.wants_table = true;
        fault
    }

    fn duplicate_field(name: &'static str) -> Self {
        Self::new(format!("key {} is there twice", quote(name))).with_help("remove one")
    }
}

/// Whether a text would be a number or a truth value without its quotes.
fn is_bare_value(text: &str) -> bool {
    matches!(text, "true" | "false") || text.parse::<f64>().is_ok()
}

/// serde's names of Rust types in the words of a scene file.
fn plain(expected: &str) -> String {
    if let Some(count) = expected.strip_prefix("an array of length ") {
        return format!("an array of {count} values");
    }
    match expected {
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number of at least 0",
        "i8" | "i16" | "i32" | "i64" => "a whole number",
        "f32" | "f64" => "a number",
        "a string" => "text in quotes",
        "a boolean" => "true or false",
        "a sequence" => "an array",
        other => other,
    }
    .to_owned()
}

/// A found value in the words of a scene file.
pub(super) fn described(found: Unexpected<'_>) -> String {
    match found {
        Unexpected::Bool(value) => format!("`{value}`"),
        Unexpected::Unsigned(value) => value.to_string(),
        Unexpected::Signed(value) => value.to_string(),
        Unexpected::Float(value) => float_text(value),
        Unexpected::Str(text) => format!("the text {}", quote(text)),
        Unexpected::Map => "a table".to_owned(),
        Unexpected::Seq => "an array".to_owned(),
        other => other.to_string(),
    }
}
