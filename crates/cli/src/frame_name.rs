//! File names with a place for the frame number: `name.####.exr` or `name.%04d.exr`.

use std::path::{Path, PathBuf};

/// A file name, cut where the frame number goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct FrameName {
    before: String,
    /// Digits, at least; `None` where there is no number.
    digits: Option<usize>,
    after: String,
}

/// Digits of a number that nobody asked for by a pattern: what farms and compositors expect.
const DEFAULT_DIGITS: usize = 4;
/// More zeros than a file name takes on any system.
const MOST_DIGITS: usize = 64;

impl FrameName {
    /// Cuts `name` at its last run of two or more `#`, or at its last `%d` or `%04d`. A single `#` is a letter.
    pub(crate) fn parse(name: &str) -> Self {
        let (start, end, digits) = match hashes(name).or_else(|| percent(name)) {
            Some(found) => found,
            None => return Self { before: name.to_owned(), digits: None, after: String::new() },
        };
        Self { before: name[..start].to_owned(), digits: Some(digits), after: name[end..].to_owned() }
    }

    /// The same with a number before the ending, where there was none.
    pub(crate) fn numbered(self) -> Self {
        if self.digits.is_some() {
            return self;
        }
        let dot = self.before.rfind('.').unwrap_or(self.before.len());
        let (stem, ending) = self.before.split_at(dot);
        Self { before: format!("{stem}."), digits: Some(DEFAULT_DIGITS), after: ending.to_owned() }
    }

    /// Whether there is a place for the number.
    pub(crate) fn is_numbered(&self) -> bool {
        self.digits.is_some()
    }

    /// The name for a frame.
    pub(crate) fn file(&self, frame: i32) -> String {
        match self.digits {
            Some(digits) => format!("{}{frame:0digits$}{}", self.before, self.after),
            None => self.before.clone(),
        }
    }

    /// The name for a frame that was stopped before its end: `name.0007.partial.exr`.
    pub(crate) fn unfinished(&self, frame: i32) -> String {
        let file = self.file(frame);
        let (stem, ending) = file.split_at(file.rfind('.').unwrap_or(file.len()));
        format!("{stem}.partial{ending}")
    }

    /// The frame number in a file name of this form.
    pub(crate) fn frame_of(&self, file: &str) -> Option<i32> {
        let number = file.strip_prefix(&self.before)?.strip_suffix(&self.after)?;
        let frame: i32 = number.parse().ok()?;
        (self.is_numbered() && self.file(frame) == file).then_some(frame)
    }
}

/// The files that `pattern` stands for, in the order of their numbers.
///
/// # Errors
/// When the folder cannot be read.
pub(crate) fn matching(pattern: &Path) -> std::io::Result<Vec<PathBuf>> {
    let Some(name) = pattern.file_name().and_then(|n| n.to_str()).map(FrameName::parse) else {
        return Ok(Vec::new());
    };
    let parent = pattern.parent().unwrap_or(Path::new(""));
    let folder = if parent.as_os_str().is_empty() { Path::new(".") } else { parent };
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let file = entry?.file_name();
        found.extend(file.to_str().and_then(|f| name.frame_of(f)).map(|frame| (frame, parent.join(&file))));
    }
    found.sort();
    Ok(found.into_iter().map(|(_, path)| path).collect())
}

/// Start, end and length of the last run of two or more `#`.
fn hashes(name: &str) -> Option<(usize, usize, usize)> {
    let mut end = name.len();
    while let Some(last) = name[..end].rfind('#') {
        let start = name[..=last].trim_end_matches('#').len();
        let length = last + 1 - start;
        if (2..=MOST_DIGITS).contains(&length) {
            return Some((start, last + 1, length));
        }
        end = start;
    }
    None
}

/// Start, end and digits of the last `%d` or `%0Nd`.
fn percent(name: &str) -> Option<(usize, usize, usize)> {
    let mut end = name.len();
    while let Some(start) = name[..end].rfind('%') {
        let rest = &name[start + 1..];
        let width = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let digits = if width == 0 { Some(1) } else { rest[..width].parse().ok() };
        if let (true, Some(digits @ 1..=MOST_DIGITS)) = (rest[width..].starts_with('d'), digits) {
            return Some((start, start + 1 + width + 1, digits));
        }
        end = start;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns() {
        let file = |name: &str, frame| FrameName::parse(name).file(frame);
        assert_eq!(file("a.####.exr", 7), "a.0007.exr");
        assert_eq!(file("a.##.exr", 12345), "a.12345.exr");
        assert_eq!(file("a.%04d.exr", 7), "a.0007.exr");
        assert_eq!(file("a%d.exr", 7), "a7.exr");
        assert_eq!(file("##_a.####.exr", 7), "##_a.0007.exr");
        assert_eq!(file("a.####.exr", -3), "a.-003.exr");
    }

    #[test]
    fn names_without_a_pattern() {
        for name in ["a.exr", "C#.png", "100%.png", "%s.png", "50%d", "%99999999999999999999d.png"] {
            let parsed = FrameName::parse(name);
            assert_eq!(parsed.is_numbered(), name == "50%d", "{name}");
        }
        assert_eq!(FrameName::parse("a.b.exr").numbered().file(7), "a.b.0007.exr");
        assert_eq!(FrameName::parse("a.##.exr").numbered().file(7), "a.07.exr");
        assert_eq!(FrameName::parse("a.##.exr").unfinished(7), "a.07.partial.exr");
    }

    #[test]
    fn frames_are_read_back() {
        let name = FrameName::parse("a.####.png");
        for frame in [-12345, -1, 0, 7, 9999, 10000, i32::MAX] {
            assert_eq!(name.frame_of(&name.file(frame)), Some(frame));
        }
        for other in ["a.7.png", "a.0007.exr", "b.0007.png", "a..png", "a.png", "a.+007.png"] {
            assert_eq!(name.frame_of(other), None, "{other}");
        }
    }

    #[test]
    fn files_are_found_in_order_of_their_numbers() {
        let folder = tempfile::tempdir().unwrap();
        for file in ["a.10.png", "a.9.png", "a.x.png", "b.1.png"] {
            std::fs::write(folder.path().join(file), "").unwrap();
        }
        let found = matching(&folder.path().join("a.%d.png")).unwrap();
        assert_eq!(found, [folder.path().join("a.9.png"), folder.path().join("a.10.png")]);
    }
}
