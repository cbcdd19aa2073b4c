//! Dotted paths such as `object.ball.translate.1`, with the place of each part.

use super::fault::Fault;
use super::placed::Span;

/// One part of a path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Segment {
    /// The part without quotes.
    pub(crate) text: String,
    /// Where it stands.
    pub(crate) span: Span,
}

impl Segment {
    /// The part as an index of an array: a number, or `x`, `y`, `z` for the first three.
    pub(crate) fn index(&self) -> Option<usize> {
        match self.text.as_str() {
            "x" => Some(0),
            "y" => Some(1),
            "z" => Some(2),
            number => number.parse().ok(),
        }
    }
}

/// A path of at least one part.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DottedPath {
    segments: Vec<Segment>,
}

impl DottedPath {
    /// Reads parts between dots; a part with dots in it stands in `"` or `'`.
    ///
    /// `offset` is the byte of the text number `source` where `path` starts; without one, every part has the
    /// place `whole`.
    ///
    /// # Errors
    /// On an empty part or an open quote.
    pub(crate) fn parse(path: &str, whole: Span, offset: Option<usize>) -> Result<Self, Fault> {
        let place = |start: usize, end: usize| match offset {
            Some(offset) => Span::new(whole.source, offset + start..offset + end),
            None => whole,
        };
        let mut segments = Vec::new();
        let mut at = 0;
        loop {
            let rest = &path[at..];
            let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''));
            let (text, length) = match quote {
                Some(quote) => {
                    let inner = &rest[1..];
                    let end = inner.find(quote).ok_or_else(|| {
                        Fault::new(format!("the quote {quote} is not closed")).or_at(place(at, path.len()))
                    })?;
                    (&inner[..end], end + 2)
                }
                None => {
                    let end = rest.find('.').unwrap_or(rest.len());
                    (&rest[..end], end)
                }
            };
            let end = at + length;
            if text.trim().is_empty() {
                return Err(Fault::new("the path has an empty part")
                    .with_help("write names between the dots, as in `object.ball.translate`")
                    .or_at(place(at, end)));
            }
            segments.push(Segment { text: text.to_owned(), span: place(at, end) });
            match path[end..].chars().next() {
                None => return Ok(Self { segments }),
                Some('.') => at = end + 1,
                Some(_) => return Err(Fault::new("expected a dot").or_at(place(end, path.len()))),
            }
        }
    }

    /// The parts.
    pub(crate) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Whether this path names `other` or something that `other` is part of, or the other way round.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        self.segments.iter().zip(&other.segments).all(|(a, b)| a.text == b.text)
    }

    /// Whether this path names `other` or something that `other` is part of.
    pub(crate) fn holds(&self, other: &Self) -> bool {
        self.segments.len() <= other.segments.len() && self.overlaps(other)
    }
}
