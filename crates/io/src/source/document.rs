//! The document behind a source: the file with its overrides and keyframes, at any time.

use super::OpenOptions;
use crate::animation::Track;
use crate::document::{DottedPath, Fault, Node, Sources, Span, Value, parse_document, parse_value};
use crate::error::quote;
use crate::scene_file::{SceneFile, set};

/// A parsed file, with what changes it.
#[derive(Debug)]
pub(super) struct Timeline {
    root: Node,
    overrides: Vec<(DottedPath, Node)>,
    tracks: Vec<Track>,
}

impl Timeline {
    /// Parses `text`, which is the file of `sources`, and adds the texts of the overrides to them.
    ///
    /// # Errors
    /// Where the text or an override is wrong by itself.
    pub(super) fn new(text: &str, sources: &mut Sources, options: &OpenOptions) -> Result<Self, Fault> {
        let mut root = parse_document(text, 0)?;
        let overrides = overrides(options, sources)?;
        for (path, value) in &overrides {
            set(&mut root, path.segments(), value.clone())?;
        }
        let file: SceneFile = root.read()?;
        let tracks = tracks(&file, &overrides, sources)?;
        Ok(Self { root, overrides, tracks })
    }

    /// The file at a time in seconds.
    ///
    /// # Errors
    /// Where the values at that time do not have the form of a scene file.
    pub(super) fn at(&self, seconds: f64) -> Result<SceneFile, Fault> {
        if self.tracks.is_empty() {
            return self.root.read();
        }
        let mut root = self.root.clone();
        for track in &self.tracks {
            set(&mut root, track.path().segments(), track.at(seconds))?;
        }
        // Once more, for overrides that hold a component of an animated value.
        for (path, value) in &self.overrides {
            set(&mut root, path.segments(), value.clone())?;
        }
        root.read()
    }

    /// Whether anything changes with time.
    pub(super) fn moves(&self) -> bool {
        !self.tracks.is_empty()
    }

    /// Time of the last key in seconds.
    pub(super) fn last_key(&self) -> Option<f64> {
        self.tracks.iter().map(Track::last_key).reduce(f64::max)
    }

    /// The first override that sets something outside of `sections`.
    pub(super) fn override_outside(&self, sections: &[&str]) -> Option<&DottedPath> {
        let is_outside = |path: &&DottedPath| !sections.contains(&path.segments()[0].text.as_str());
        self.overrides.iter().map(|(path, _)| path).find(is_outside)
    }
}

/// The overrides as paths and values, each a text of its own among the sources.
fn overrides(options: &OpenOptions, sources: &mut Sources) -> Result<Vec<(DottedPath, Node)>, Fault> {
    let mut overrides = Vec::new();
    for (path, value) in &options.overrides {
        let text = format!("{path}={value}");
        let source = sources.add("--set", &text);
        let whole = Span::new(source, 0..text.len());
        let value = override_value(value, source, path.len() + 1)?;
        overrides.push((DottedPath::parse(path, whole, Some(0))?, value));
    }
    if let Some(name) = &options.camera {
        let source = sources.add("--camera", name);
        let span = Span::new(source, 0..name.len());
        let value = Node { span, value: Value::Text(name.clone()) };
        overrides.push((DottedPath::parse("render.camera", span, None)?, value));
    }
    Ok(overrides)
}

/// A TOML value; a bare word is a text, so that no shell needs two layers of quotes.
fn override_value(text: &str, source: u32, offset: usize) -> Result<Node, Fault> {
    let is_word = |text: &str| {
        text.starts_with(|c: char| c.is_alphabetic())
            && text.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '/' | ' '))
    };
    match parse_value(text, source, offset) {
        Err(_) if is_word(text) => Ok(Node {
            span: Span::new(source, offset..offset + text.len()),
            value: Value::Text(text.to_owned()),
        }),
        Err(fault) => {
            Err(fault
                .with_help("write PATH=VALUE, VALUE as in the scene file: 40, [0, 1, 0], true or \"text\""))
        }
        Ok(node) => Ok(node),
    }
}

/// The animations, less those whose target an override holds still.
fn tracks(
    file: &SceneFile,
    overrides: &[(DottedPath, Node)],
    sources: &Sources,
) -> Result<Vec<Track>, Fault> {
    let mut tracks: Vec<Track> = Vec::new();
    for table in &file.animation {
        let track = Track::new(table, |span| sources.text(span))?;
        if tracks.iter().any(|other| other.path().overlaps(track.path())) {
            return Err(Fault::new(format!("{} is animated twice", quote(&table.target)))
                .with_help("put all keys into one [[animation]]")
                .or_at(table.target.span()));
        }
        tracks.push(track);
    }
    tracks.retain(|track| !overrides.iter().any(|(path, _)| path.holds(track.path())));
    Ok(tracks)
}
