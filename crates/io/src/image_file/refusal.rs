//! Why an image is not read: three kinds, each with its mend.

use crate::error::LoadError;
use std::path::Path;

/// A sentence about a file, without its name.
#[derive(Debug)]
pub(crate) enum Refusal {
    /// It breaks the rules of its format, or ends too early.
    Damaged(String),
    /// It is sound, but of a kind that is not read.
    Variant(String),
    /// It is larger than the limits.
    Large(String),
}

impl From<String> for Refusal {
    /// Readers of bytes find damage; the other kinds say so.
    fn from(message: String) -> Self {
        Self::Damaged(message)
    }
}

impl From<&str> for Refusal {
    fn from(message: &str) -> Self {
        Self::Damaged(message.to_owned())
    }
}

impl Refusal {
    /// The error about the file at `path`.
    pub(crate) fn about(self, path: &Path) -> LoadError {
        let (message, help) = match self {
            Self::Damaged(message) => (message, "export it again, or copy it again from where it came"),
            Self::Variant(message) => {
                (message, "save it as PNG or JPEG, or as flat EXR in RGB with ZIP compression")
            }
            Self::Large(message) => (message, "scale it down"),
        };
        LoadError::new(path, message).with_help(help)
    }
}
