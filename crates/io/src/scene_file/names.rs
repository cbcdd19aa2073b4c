//! Names: what refers to what, and what a thing without a name is called.

use crate::document::{Fault, Placed, Span};
use crate::error::quote;
use std::collections::HashMap;
use std::path::Path;

/// The name of the `index`-th table of a section that does not give one: `light`, `light2`, `light3`, ...
///
/// A model is called after its file.
pub(crate) fn implicit_name(section: &str, index: usize, file: Option<&str>) -> String {
    let stem = file.and_then(|file| Path::new(file).file_stem());
    match (stem, index) {
        (Some(stem), _) => stem.to_string_lossy().into_owned(),
        (None, 0) => section.to_owned(),
        (None, _) => format!("{section}{}", index + 1),
    }
}

/// The names of one section, each with its index.
#[derive(Clone, Debug)]
pub(super) struct Names {
    section: &'static str,
    names: Vec<String>,
    indices: HashMap<String, usize>,
}

impl Names {
    /// Collects names with the places to blame.
    ///
    /// # Errors
    /// At the second of two equal names, or an empty one.
    pub(super) fn new(
        section: &'static str,
        names: impl IntoIterator<Item = (String, Option<Span>)>,
    ) -> Result<Self, Fault> {
        let mut this = Self { section, names: Vec::new(), indices: HashMap::new() };
        for (name, span) in names {
            this.add(name, span)?;
        }
        Ok(this)
    }

    /// Adds a name and gives its index.
    ///
    /// # Errors
    /// When the name is there already, or empty.
    pub(super) fn add(&mut self, name: String, span: Option<Span>) -> Result<usize, Fault> {
        if name.is_empty() {
            return Err(Fault::new("the name is empty").with_help("write at least one letter").or_at(span));
        }
        let index = self.names.len();
        if self.indices.insert(name.clone(), index).is_some() {
            return Err(Fault::new(format!("a second {} is named {}", self.section, quote(&name)))
                .with_help("give each its own `name`")
                .or_at(span));
        }
        self.names.push(name);
        Ok(index)
    }

    /// The index of a name.
    ///
    /// # Errors
    /// When there is none; the help offers a near one.
    pub(super) fn find(&self, name: &Placed<String>) -> Result<usize, Fault> {
        self.index(name).ok_or_else(|| self.unknown(name).or_at(name.span()))
    }

    /// The index of a name, if it is known.
    pub(super) fn index(&self, name: &str) -> Option<usize> {
        self.indices.get(name).copied()
    }

    /// What to say about a name that is not known.
    pub(super) fn unknown(&self, name: &str) -> Fault {
        let fault = Fault::unknown(self.section, name, self.iter());
        match fault.help() {
            Some(_) => fault,
            None => fault.with_help(format!("add a [[{}]] of that name", self.section)),
        }
    }

    /// The names in order.
    pub(super) fn iter(&self) -> impl Iterator<Item = &str> + Clone {
        self.names.iter().map(String::as_str)
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.names.len()
    }

    /// The name with that index.
    pub(super) fn name(&self, index: usize) -> &str {
        &self.names[index]
    }
}

/// The name of a table that may leave it out, and the place to blame for it.
pub(super) fn name_or_implicit(
    name: Option<&Placed<String>>,
    table: Option<Span>,
    section: &str,
    index: usize,
    file: Option<&str>,
) -> (String, Option<Span>) {
    match name {
        Some(name) => (name.to_string(), name.span()),
        None => (implicit_name(section, index, file), table),
    }
}
