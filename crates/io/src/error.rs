//! What is wrong with a file, where, and how to mend it.
//!
//! Errors and warnings carry the same [`Report`]: a path, a [`Place`] with the text around it, one sentence and a
//! mend. Their `Display` is one line, `file:line:column: message; help`, with no control characters in it; whoever
//! draws the excerpt with a mark under the place finds everything in the fields.

use std::borrow::Cow;
use std::fmt;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A place in a text file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The text around the place, or the whole file.
    pub excerpt: Arc<str>,
    /// Line number of the first line of `excerpt`.
    pub excerpt_line: usize,
    /// The marked bytes of `excerpt`; on character boundaries, may be empty.
    pub span: Range<usize>,
}

impl Place {
    /// The bytes `span` of a whole file. A span out of range or inside a character is moved to fit.
    pub fn in_file(text: Arc<str>, span: Range<usize>) -> Self {
        Self::in_lines(text, 1, span)
    }

    /// The bytes `span` of some lines of a file, the first of which has the number `excerpt_line`.
    pub fn in_lines(excerpt: Arc<str>, excerpt_line: usize, span: Range<usize>) -> Self {
        let start = floor_char_boundary(&excerpt, span.start);
        let end = floor_char_boundary(&excerpt, span.end.max(start));
        let before = &excerpt[..start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        Self {
            line: excerpt_line + before.bytes().filter(|&b| b == b'\n').count(),
            column: 1 + before[line_start..].chars().count(),
            excerpt_line,
            span: start..end,
            excerpt,
        }
    }
}

/// The largest character boundary that is not above `at`.
fn floor_char_boundary(text: &str, at: usize) -> usize {
    let at = at.min(text.len());
    (0..=at).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

/// One sentence about a file: the common content of [`LoadError`] and [`Warning`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The file.
    pub path: PathBuf,
    /// The place in it, where there is one.
    pub place: Option<Place>,
    /// What is wrong; starts in lower case, no full stop.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", one_line(&self.path.to_string_lossy()))?;
        if let Some(place) = &self.place {
            write!(f, ":{}:{}", place.line, place.column)?;
        }
        write!(f, ": {}", one_line(&self.message))?;
        match &self.help {
            Some(help) => write!(f, "; {}", one_line(help)),
            None => Ok(()),
        }
    }
}

/// A file that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoadError(Box<Report>);

impl LoadError {
    /// `message` about a file as a whole.
    pub fn new(path: impl Into<PathBuf>, message: impl Into<String>) -> Self {
        Self(Box::new(Report { path: path.into(), place: None, message: message.into(), help: None }))
    }

    /// A failure of the operating system to read `path`.
    pub fn io(path: impl Into<PathBuf>, error: &io::Error) -> Self {
        let path = path.into();
        match error.kind() {
            io::ErrorKind::NotFound => Self::new(&path, "file not found").with_help(missing_help(&path)),
            io::ErrorKind::PermissionDenied => {
                Self::new(path, "permission to read denied").with_help("make the file readable for this user")
            }
            _ => Self::new(path, format!("cannot be read: {error}")),
        }
    }

    /// Adds the place.
    #[must_use]
    pub fn at(mut self, place: Place) -> Self {
        self.0.place = Some(place);
        self
    }

    /// Adds how to mend it.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// The content.
    pub fn report(&self) -> &Report {
        &self.0
    }

    /// The same, for those who go on without the file.
    pub fn into_warning(self) -> Warning {
        Warning(*self.0)
    }
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for LoadError {}

/// Something that was mended or left out; the picture is made, but may not be what was meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning(Report);

impl Warning {
    /// `message` about a file as a whole.
    pub fn new(path: impl Into<PathBuf>, message: impl Into<String>) -> Self {
        LoadError::new(path, message).into_warning()
    }

    /// Adds the place.
    #[must_use]
    pub fn at(mut self, place: Place) -> Self {
        self.0.place = Some(place);
        self
    }

    /// Adds how to mend it.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// The content.
    pub fn report(&self) -> &Report {
        &self.0
    }

    /// The same, for those who want no warnings.
    pub fn into_error(self) -> LoadError {
        LoadError(Box::new(self.0))
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A mend for a missing file: names the folder when it is the folder that is missing.
fn missing_help(path: &Path) -> String {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            format!("there is no folder {}", folder.display())
        }
        _ => "check the spelling and the folder".to_owned(),
    }
}

/// `text` with line ends and other control characters shown as escapes.
fn one_line(text: &str) -> Cow<'_, str> {
    if !text.contains(char::is_control) {
        return Cow::Borrowed(text);
    }
    let escape = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    Cow::Owned(text.chars().map(escape).collect())
}

/// `text` from a file in backquotes, cut to a length that leaves the message readable.
pub fn quote(text: &str) -> String {
    const LONGEST: usize = 60;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("`{}...`", one_line(&text[..end])),
        None => format!("`{}`", one_line(text)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_counts_lines_and_characters_from_one() {
        let text: Arc<str> = "eins\nzwölf = 12\n".into();
        let at = text.find("12").unwrap();
        let place = Place::in_file(text, at..at + 2);
        assert_eq!((place.line, place.column), (2, 9));
        assert_eq!(&place.excerpt[place.span.clone()], "12");
    }

    #[test]
    fn a_place_in_an_excerpt_keeps_the_line_of_the_file() {
        let place = Place::in_lines("f 1 2 x".into(), 97, 6..7);
        assert_eq!((place.line, place.column), (97, 7));
    }

    #[test]
    fn a_span_outside_the_text_is_moved_to_fit() {
        for span in [0..0, 1..3, 2..2, 3..90, 90..99] {
            let place = Place::in_file("ö\n".into(), span);
            let _ = &place.excerpt[place.span.clone()];
            assert!(place.line <= 2);
        }
    }

    #[test]
    fn display_is_one_line_without_control_characters() {
        let error = LoadError::new("a\nb.obj", "no\u{1b}[31m")
            .at(Place::in_lines("v 1".into(), 7, 2..3))
            .with_help("write\nthree numbers");
        assert_eq!(error.to_string(), "a\\nb.obj:7:3: no\\u{1b}[31m; write\\nthree numbers");
    }

    #[test]
    fn long_quotes_are_cut() {
        assert_eq!(quote("abc"), "`abc`");
        assert_eq!(quote(&"ä".repeat(1000)), format!("`{}...`", "ä".repeat(60)));
    }

    #[test]
    fn a_missing_folder_is_named() {
        let missing = io::Error::from(io::ErrorKind::NotFound);
        let error = LoadError::io("no-such-folder/a.png", &missing);
        assert_eq!(
            error.to_string(),
            "no-such-folder/a.png: file not found; there is no folder no-such-folder"
        );
    }
}
