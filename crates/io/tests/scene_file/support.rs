//! Scene files made on the spot.

use heliostat_io::error::Report;
use heliostat_io::{LoadError, OpenOptions, Shot, Source, open};
use std::path::PathBuf;

/// A folder that vanishes with the scene file in it.
pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, content).unwrap();
        path
    }

    pub(crate) fn open(&self, text: &str, options: &OpenOptions) -> Result<Source, LoadError> {
        open(&self.write("scene.toml", text), options)
    }
}

/// The first shot of a scene file.
pub(crate) fn shot(text: &str) -> Result<Shot, LoadError> {
    shot_with(text, &OpenOptions::default())
}

/// The first shot of a scene file with flags.
pub(crate) fn shot_with(text: &str, options: &OpenOptions) -> Result<Shot, LoadError> {
    let source = Folder::new().open(text, options)?;
    source.shot(source.first_frame())
}

/// The flags `--set PATH=VALUE`.
pub(crate) fn set(pairs: &[(&str, &str)]) -> OpenOptions {
    let overrides = pairs.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
    OpenOptions { overrides, ..OpenOptions::default() }
}

/// Asserts that a text is refused, at the place between `«` and `»`.
pub(crate) fn refused(marked: &str, message: &str, help: &str) {
    let start = marked.find('«').expect("a mark in the text");
    let text = marked.replace('«', "");
    let end = text.find('»').expect("an end of the mark");
    let text = text.replace('»', "");
    let error = shot(&text).expect_err(marked);
    let report = error.report();
    let place = report.place.as_ref().unwrap_or_else(|| panic!("no place: {error}"));
    assert_eq!(report.message, message, "{error}");
    assert_eq!(report.help.as_deref().unwrap_or_default(), help, "{error}");
    assert_eq!(&place.excerpt[place.span.clone()], &text[start..end], "{error}");
    assert_eq!(place.span, start..end, "{error}");
    let line = 1 + text[..start].matches('\n').count();
    let column = 1 + text[..start].rsplit('\n').next().unwrap().chars().count();
    assert_eq!((place.line, place.column), (line, column), "{error}");
    assert_eq!(error.to_string(), expected_line(report, line, column));
}

fn expected_line(report: &Report, line: usize, column: usize) -> String {
    let help = report.help.as_ref().map(|help| format!("; {help}")).unwrap_or_default();
    format!("{}:{line}:{column}: {}{help}", report.path.display(), report.message)
}
