//! Failures as users see them: the excerpt of the file with the place marked, and last, on one line, what is wrong
//! and how to mend it. Farms match regular expressions on the last lines of a log.

use crate::exit::Exit;
use crate::out;
use heliostat_io::SaveError;
use heliostat_io::error::{LoadError, Place, Report, Warning};
use heliostat_render::RenderError;
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents,
    SourceCode, SourceSpan, SpanContents,
};
use std::fmt;
use std::io::IsTerminal;

/// Why a command did not do what it was asked for.
#[derive(Debug)]
pub(crate) struct Failure {
    exit: Exit,
    /// `what; mend`, without the word error.
    line: String,
    /// The file and the place, where it is about a file.
    source: Option<LoadError>,
}

impl Failure {
    /// `line` says what and how to mend it.
    pub(crate) fn new(exit: Exit, line: impl Into<String>) -> Self {
        let line: String = line.into();
        Self { exit, line: line.split_whitespace().collect::<Vec<_>>().join(" "), source: None }
    }

    /// A slip on the command line that clap cannot see.
    pub(crate) fn usage(line: impl Into<String>) -> Self {
        Self::new(Exit::Usage, line)
    }

    /// Prints it and tells how the process ends.
    pub(crate) fn print(&self) -> Exit {
        if let Some(excerpt) = self.source.as_ref().and_then(|e| excerpt(e.report(), miette::Severity::Error))
        {
            out::note(format_args!("{}", excerpt.trim_end()));
        }
        out::note(format_args!("error: {}", self.line));
        self.exit
    }
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        Self { exit: Exit::Input, line: error.to_string(), source: Some(error) }
    }
}

impl From<SaveError> for Failure {
    fn from(error: SaveError) -> Self {
        Self::new(Exit::Output, error.to_string())
    }
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        // Everything else is a number of the scene out of its range.
        let exit = match error {
            RenderError::OutOfMemory { .. } | RenderError::Threads(_) => Exit::Failed,
            _ => Exit::Input,
        };
        Self::new(exit, error.to_string())
    }
}

/// A warning with its excerpt, for commands that exist to show it.
pub(crate) fn print_warning(warning: &Warning) {
    if let Some(excerpt) = excerpt(warning.report(), miette::Severity::Warning) {
        out::note(format_args!("{}", excerpt.trim_end()));
    }
    out::note(format_args!("warning: {warning}"));
}

/// The lines around the place, with a mark under it.
fn excerpt(report: &Report, severity: miette::Severity) -> Option<String> {
    let excerpt = Excerpt { report, place: report.place.as_ref()?, severity };
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(theme()).with_width(110).with_links(false);
    handler.render_report(&mut text, &excerpt).ok().map(|()| text)
}

/// Unicode and colour where the terminal has them, plain letters in a log.
fn theme() -> GraphicalTheme {
    let terminal = std::io::stderr().is_terminal();
    let colour = terminal && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    match (terminal && speaks_unicode(), colour) {
        (true, true) => GraphicalTheme::unicode(),
        (true, false) => GraphicalTheme::unicode_nocolor(),
        (false, true) => GraphicalTheme { styles: miette::ThemeStyles::ansi(), ..GraphicalTheme::ascii() },
        (false, false) => GraphicalTheme::none(),
    }
}

/// What the locale says; Windows terminals all do.
fn speaks_unicode() -> bool {
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"]
        .iter()
        .filter_map(|name| std::env::var(name).ok())
        .find(|value| !value.is_empty())
        .unwrap_or_default()
        .to_ascii_uppercase();
    cfg!(windows) || locale.contains("UTF-8") || locale.contains("UTF8")
}

/// A report as miette draws it.
#[derive(Debug)]
struct Excerpt<'a> {
    report: &'a Report,
    place: &'a Place,
    severity: miette::Severity,
}

impl fmt::Display for Excerpt<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.report.message)
    }
}

impl std::error::Error for Excerpt<'_> {}

impl Diagnostic for Excerpt<'_> {
    fn severity(&self) -> Option<miette::Severity> {
        Some(self.severity)
    }

    fn help<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        self.report.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = SourceSpan::from(self.place.span.clone());
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(None, span))))
    }
}

impl SourceCode for Excerpt<'_> {
    fn read_span<'b>(
        &'b self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'b> + 'b>, MietteError> {
        let part = (*self.place.excerpt).read_span(span, before, after)?;
        // Line numbers are those of the file, not of the excerpt.
        Ok(Box::new(MietteSpanContents::new_named(
            self.report.path.to_string_lossy().into_owned(),
            part.data(),
            *part.span(),
            part.line() + self.place.excerpt_line - 1,
            part.column(),
            part.line_count(),
        )))
    }
}
