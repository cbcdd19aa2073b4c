//! What kept a file from being written, and how to mend it.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// A file that could not be written. Its `Display` is one line: `path: message; help`.
#[derive(Debug)]
pub struct SaveError {
    path: PathBuf,
    message: String,
    help: Option<String>,
    source: Option<io::Error>,
}

impl SaveError {
    /// `message` about the file to be written; starts in lower case, no full stop.
    pub fn new(path: impl Into<PathBuf>, message: impl Into<String>) -> Self {
        Self { path: path.into(), message: message.into(), help: None, source: None }
    }

    /// A failure of the operating system to write `path`.
    pub fn io(path: &Path, error: io::Error) -> Self {
        let (message, help) = explain(path, &error);
        Self { path: path.to_owned(), message, help, source: Some(error) }
    }

    /// Adds how to mend it.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is wrong.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// How to mend it.
    pub fn help(&self) -> Option<&str> {
        self.help.as_deref()
    }

    /// The failure of the operating system behind it: a broken pipe is nothing to complain about.
    pub fn io_kind(&self) -> Option<io::ErrorKind> {
        self.source.as_ref().map(io::Error::kind)
    }
}

/// Message and mend for a failure to write `path`.
fn explain(path: &Path, error: &io::Error) -> (String, Option<String>) {
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder_name = folder.display();
    let (message, help) = match error.kind() {
        io::ErrorKind::NotFound if !folder.is_dir() => {
            (format!("there is no folder {folder_name}"), format!("create it: mkdir -p {folder_name}"))
        }
        io::ErrorKind::NotADirectory => {
            (format!("{folder_name} is not a folder"), "choose another folder".to_owned())
        }
        io::ErrorKind::IsADirectory => {
            ("is a folder".to_owned(), "name a file, for example one in this folder".to_owned())
        }
        io::ErrorKind::PermissionDenied => (
            "permission to write denied".to_owned(),
            format!("make the file and the folder {folder_name} writable, or choose another folder"),
        ),
        io::ErrorKind::ReadOnlyFilesystem => {
            ("the file system is read-only".to_owned(), "choose another folder".to_owned())
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            ("no space left".to_owned(), "free some space, or choose another disk".to_owned())
        }
        io::ErrorKind::InvalidFilename => (error.to_string(), "choose a shorter name".to_owned()),
        _ => return (format!("cannot be written: {error}"), None),
    };
    (message, Some(help))
}

impl fmt::Display for SaveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Paths may hold line ends and terminal escapes; a message is one line.
        let clean = |text: &str| text.replace(char::is_control, "?");
        write!(f, "{}: {}", clean(&self.path.to_string_lossy()), clean(&self.message))?;
        self.help.as_deref().map_or(Ok(()), |help| write!(f, "; {}", clean(help)))
    }
}

impl std::error::Error for SaveError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.source.as_ref().map(|e| e as _)
    }
}
