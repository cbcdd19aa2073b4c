//! The texts that a document is made of: the file, and one per override.

use super::fault::Fault;
use super::placed::Span;
use crate::error::{LoadError, Place, Warning};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Texts by the number that spans carry; number 0 is the file.
#[derive(Clone, Debug)]
pub(crate) struct Sources {
    texts: Vec<(PathBuf, Arc<str>)>,
}

impl Sources {
    /// The file alone.
    pub(crate) fn new(path: &Path, text: &str) -> Self {
        Self { texts: vec![(path.to_owned(), text.into())] }
    }

    /// Adds the text of a flag and gives its number.
    pub(crate) fn add(&mut self, flag: &str, text: &str) -> u32 {
        self.texts.push((flag.into(), text.into()));
        self.texts.len() as u32 - 1
    }

    /// The text at a span.
    pub(crate) fn text(&self, span: Span) -> &str {
        self.texts.get(span.source as usize).and_then(|(_, text)| text.get(span.range())).unwrap_or_default()
    }

    /// The fault with the text around its place.
    pub(crate) fn error(&self, fault: &Fault) -> LoadError {
        let (path, text) = &self.texts[fault.span().map_or(0, |span| span.source as usize)];
        let mut error = LoadError::new(path, fault.message());
        if let Some(span) = fault.span() {
            error = error.at(self.place(text, span));
        }
        match fault.help() {
            Some(help) => error.with_help(help),
            None => error,
        }
    }

    /// The fault as a warning.
    pub(crate) fn warning(&self, fault: &Fault) -> Warning {
        self.error(fault).into_warning()
    }

    fn place(&self, text: &Arc<str>, span: Span) -> Place {
        Place::in_file(Arc::clone(text), span.range())
    }
}
