//! What is wrong inside a glTF file: the place in its JSON, one sentence, and the mend.

use crate::error::{LoadError, Warning};
use std::path::Path;

/// Something that is wrong at a place such as `meshes[3].primitives[0].attributes.POSITION`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Flaw {
    place: String,
    message: String,
    help: Option<String>,
}

impl Flaw {
    /// `message` about the place; an empty place is the whole file.
    pub(super) fn new(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self { place: place.into(), message: message.into(), help: None }
    }

    /// A number that leads beyond the end of its array.
    pub(super) fn dangling(place: impl Into<String>, array: &str, index: usize, count: usize) -> Self {
        let message = format!("names {array}[{index}], but there are {count}");
        Self::new(place, message).with_help("export the file again")
    }

    /// Adds how to mend it.
    #[must_use]
    pub(super) fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The same as an error of the file.
    pub(super) fn into_error(self, path: &Path) -> LoadError {
        let message =
            if self.place.is_empty() { self.message } else { format!("{}: {}", self.place, self.message) };
        let error = LoadError::new(path, message);
        match self.help {
            Some(help) => error.with_help(help),
            None => error,
        }
    }

    /// The same for those who go on without the thing.
    pub(super) fn into_warning(self, path: &Path) -> Warning {
        self.into_error(path).into_warning()
    }
}
