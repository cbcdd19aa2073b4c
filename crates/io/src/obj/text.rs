//! The text of an OBJ or MTL file as statements whose words know their place.
//!
//! Nothing is copied or joined: a statement is a slice of the file, so every word of it has a byte offset, and an error
//! gets its line and column only when there is one. Handled here, so that nobody else has to: byte-order mark,
//! bytes that are not UTF-8, line ends of all systems, lines continued by a backslash, comments behind data.

use crate::error::{LoadError, Place, Warning};
use std::borrow::Cow;
use std::path::Path;

/// Longest piece of a line that an error carries around its mark, in bytes before and after.
const EXCERPT: usize = 160;

/// A decoded file.
#[derive(Debug)]
pub(super) struct SourceText<'a> {
    pub(super) path: &'a Path,
    pub(super) text: Cow<'a, str>,
}

impl<'a> SourceText<'a> {
    /// Decodes UTF-8; each byte that is not UTF-8 stands for the Latin-1 character of its number.
    pub(super) fn decode(path: &'a Path, bytes: &'a [u8]) -> Result<Self, LoadError> {
        if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            return Err(LoadError::new(path, "is UTF-16 text").with_help("save it as UTF-8"));
        }
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut text = match std::str::from_utf8(bytes) {
            Ok(text) => Cow::Borrowed(text),
            Err(_) => Cow::Owned(decode_latin1_rests(bytes)),
        };
        // Macintosh files before OS X end their lines with a carriage return alone.
        if text.contains('\r') && !text.contains('\n') {
            text = Cow::Owned(text.replace('\r', "\n"));
        }
        Ok(Self { path, text })
    }

    /// The statements in the order of the file; empty lines and comments are none.
    pub(super) fn statements(&self) -> Statements<'_> {
        Statements { rest: &self.text }
    }

    /// Where `word`, a slice of the text, starts.
    pub(super) fn offset(&self, word: &str) -> usize {
        (word.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize).min(self.text.len())
    }

    /// An error at `word`, a slice of the text.
    pub(super) fn error(&self, word: &str, message: impl Into<String>) -> LoadError {
        LoadError::new(self.path, message).at(self.place(word))
    }

    /// A warning at `word`, a slice of the text.
    pub(super) fn warning(&self, word: &str, message: impl Into<String>) -> Warning {
        self.error(word, message).into_warning()
    }

    /// A warning at the statement that starts at `offset`.
    pub(super) fn warning_at(&self, offset: usize, message: impl Into<String>) -> Warning {
        self.warning(self.first_word_at(offset), message)
    }

    /// An error at the statement that starts at `offset`.
    pub(super) fn error_at(&self, offset: usize, message: impl Into<String>) -> LoadError {
        self.error(self.first_word_at(offset), message)
    }

    fn first_word_at(&self, offset: usize) -> &str {
        self.text.get(offset..).unwrap_or_default().split_ascii_whitespace().next().unwrap_or_default()
    }

    fn place(&self, word: &str) -> Place {
        let text = &*self.text;
        let span = self.offset(word)..(self.offset(word) + word.len()).min(text.len());
        let line_start = text[..span.start].rfind('\n').map_or(0, |i| i + 1);
        let line_end = text[span.start..].find('\n').map_or(text.len(), |i| span.start + i);
        let line = 1 + text[..line_start].bytes().filter(|&b| b == b'\n').count();
        let column = 1 + text[line_start..span.start].chars().count();
        // A line of a gigabyte does not travel with its error.
        let cut = char_boundary(text, span.start.saturating_sub(EXCERPT).max(line_start))
            ..char_boundary(text, line_end.min(span.start + EXCERPT));
        let shown = text[cut.clone()].trim_end_matches('\r');
        let mark = span.start - cut.start..span.end.min(cut.end) - cut.start;
        let place = Place::in_lines(shown.into(), line, mark);
        Place { column, ..place }
    }
}

fn char_boundary(text: &str, at: usize) -> usize {
    (0..=at).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

fn decode_latin1_rests(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() + bytes.len() / 8);
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        text.extend(chunk.invalid().iter().map(|&b| char::from(b)));
    }
    text
}

/// Iterates over the statements of a file.
#[derive(Clone, Debug)]
pub(super) struct Statements<'a> {
    rest: &'a str,
}

impl<'a> Iterator for Statements<'a> {
    type Item = Statement<'a>;

    fn next(&mut self) -> Option<Statement<'a>> {
        loop {
            if self.rest.is_empty() {
                return None;
            }
            let (end, next) = statement_end(self.rest);
            let line = self.rest[..end].trim_ascii_start();
            self.rest = &self.rest[next..];
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let keyword_end = line.find(|c: char| c.is_ascii_whitespace()).unwrap_or(line.len());
            let (keyword, arguments) = line.split_at(keyword_end);
            // `g#comment` and the like: the comment may start inside the first word.
            let keyword = keyword.split('#').next().unwrap_or_default();
            return Some(Statement { keyword, arguments });
        }
    }
}

/// Where the first statement ends and where the next one starts.
fn statement_end(text: &str) -> (usize, usize) {
    let mut from = 0;
    loop {
        let end = text[from..].find('\n').map_or(text.len(), |i| from + i);
        let line = text[from..end].trim_ascii_end();
        // A backslash at the end of a comment is the end of a Windows path, not a continuation.
        if end < text.len() && line.ends_with('\\') && !line.contains('#') {
            from = end + 1;
            continue;
        }
        return (end, (end + 1).min(text.len()));
    }
}

/// A keyword and what follows it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Statement<'a> {
    /// The first word.
    pub(super) keyword: &'a str,
    /// All behind it, with comments and continuation marks.
    arguments: &'a str,
}

impl<'a> Statement<'a> {
    /// The words behind the keyword, up to a comment.
    pub(super) fn words(&self) -> impl Iterator<Item = &'a str> + Clone + use<'a> {
        let data = &self.arguments[..self.arguments.find('#').unwrap_or(self.arguments.len())];
        data.split_ascii_whitespace().map(|word| word.trim_end_matches('\\')).filter(|word| !word.is_empty())
    }

    /// The arguments as one name or path that may hold blanks; a comment starts with a free-standing `#`, because
    /// names like `Material #25` are common.
    pub(super) fn name(&self) -> &'a str {
        let comment = self.arguments.match_indices('#').map(|(i, _)| i).find(|&i| {
            let bytes = self.arguments.as_bytes();
            let blank = |i: usize| bytes.get(i).is_none_or(u8::is_ascii_whitespace);
            i > 0 && blank(i - 1) && blank(i + 1)
        });
        self.arguments[..comment.unwrap_or(self.arguments.len())].trim()
    }

    /// Marks the last argument, or the keyword when there is none: where something is missing.
    pub(super) fn last_word(&self) -> &'a str {
        self.words().last().unwrap_or(self.keyword)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(bytes: &[u8]) -> Vec<Vec<String>> {
        let source = SourceText::decode(Path::new("a.obj"), bytes).unwrap();
        source
            .statements()
            .map(|s| std::iter::once(s.keyword).chain(s.words()).map(str::to_owned).collect())
            .collect()
    }

    #[test]
    fn line_ends_of_all_systems_are_line_ends() {
        for text in ["v 1 2 3\nf 1", "v 1 2 3\r\nf 1\r\n", "v 1 2 3\rf 1\r", "\n\n  v\t1 2  3 \n\nf 1"] {
            assert_eq!(words(text.as_bytes()), [vec!["v", "1", "2", "3"], vec!["f", "1"]], "{text:?}");
        }
    }

    #[test]
    fn continued_lines_are_one_statement() {
        for text in ["f 1 2 \\\n3 4", "f 1 2\\\r\n 3 \\\r\n\t4", "f \\\n\\\n1 2 3 4"] {
            assert_eq!(words(text.as_bytes()), [vec!["f", "1", "2", "3", "4"]], "{text:?}");
        }
    }

    #[test]
    fn a_backslash_ends_neither_the_file_nor_a_comment_badly() {
        assert_eq!(words(b"f 1 2 \\"), [vec!["f", "1", "2"]]);
        assert_eq!(words(b"# C:\\models\\\nv 1 2 3"), [vec!["v", "1", "2", "3"]]);
        assert_eq!(words(b"g a # in C:\\\nv 1 2 3"), [vec!["g", "a"], vec!["v", "1", "2", "3"]]);
    }

    #[test]
    fn comments_behind_data_are_cut() {
        assert_eq!(
            words(b"Kd 1 2 3 # red\nf 1 2 3#x\n#f 1"),
            [vec!["Kd", "1", "2", "3"], vec!["f", "1", "2", "3"]]
        );
    }

    #[test]
    fn names_keep_blanks_and_numbers() {
        let name = |text: &str| {
            let source = SourceText::decode(Path::new("a.obj"), text.as_bytes()).unwrap();
            source.statements().next().unwrap().name().to_owned()
        };
        assert_eq!(name("usemtl  a, b  c \r\n"), "a, b  c");
        assert_eq!(name("usemtl Material #25"), "Material #25");
        assert_eq!(name("usemtl wood # the floor"), "wood");
    }

    #[test]
    fn marks_and_foreign_bytes_are_decoded() {
        assert_eq!(words(b"\xef\xbb\xbfv 1 2 3"), [vec!["v", "1", "2", "3"]]);
        assert_eq!(words(b"g d\xe9k"), [vec!["g", "d\u{e9}k"]]);
        assert_eq!(words("g dék".as_bytes()), [vec!["g", "dék"]]);
        let utf16 = SourceText::decode(Path::new("a.obj"), b"\xff\xfev\0");
        assert!(utf16.unwrap_err().to_string().contains("UTF-16"));
    }

    #[test]
    fn a_word_knows_its_line_and_column() {
        let text = "v 1 2 3\n# é\nf 1 \\\n  2 oops";
        let source = SourceText::decode(Path::new("a.obj"), text.as_bytes()).unwrap();
        let word = source.statements().last().unwrap().last_word();
        assert_eq!(source.offset(word), text.find("oops").unwrap());
        assert_eq!(source.error(word, "bad").to_string(), "a.obj:4:5: bad");
    }

    #[test]
    fn the_excerpt_of_a_long_line_is_short() {
        let text = format!("f {} x {}", "1 ".repeat(9999), "é ".repeat(9999));
        let source = SourceText::decode(Path::new("a.obj"), text.as_bytes()).unwrap();
        let word = source.statements().next().unwrap().words().nth(9999).unwrap();
        let error = source.error(word, "bad");
        let place = error.report().place.as_ref().unwrap();
        assert_eq!(&place.excerpt[place.span.clone()], "x");
        assert_eq!((place.line, place.column), (1, 20002));
        assert!(place.excerpt.len() <= 2 * EXCERPT);
    }
}
