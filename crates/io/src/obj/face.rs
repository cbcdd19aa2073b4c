//! Corners of faces: `v`, `v/vt`, `v//vn`, `v/vt/vn`, each index from 1 or, negative, from the end.

use super::text::SourceText;
use crate::error::{LoadError, quote};

/// Stands for an index that a corner leaves out.
pub(super) const NONE: u32 = u32::MAX;

/// Indices from 0 into the positions, texture coordinates and normals of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Corner {
    pub(super) position: u32,
    /// [`NONE`] where left out.
    pub(super) uv: u32,
    /// [`NONE`] where left out.
    pub(super) normal: u32,
}

/// How many of each there are so far: what negative indices count from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counts {
    pub(super) positions: usize,
    pub(super) uvs: usize,
    pub(super) normals: usize,
}

/// Reads one corner. Indices above the counts are left to the caller: what they name may still follow.
pub(super) fn corner(source: &SourceText<'_>, word: &str, counts: Counts) -> Result<Corner, LoadError> {
    let mut parts = word.split('/');
    let position = parts.next().unwrap_or_default();
    let corner = Corner {
        position: index(source, position, word, "vertex", counts.positions)?,
        uv: optional(source, parts.next(), word, "texture coordinate", counts.uvs)?,
        normal: optional(source, parts.next(), word, "normal", counts.normals)?,
    };
    match parts.next() {
        None => Ok(corner),
        Some(_) => Err(not_a_corner(source, word)),
    }
}

fn optional(
    source: &SourceText<'_>,
    part: Option<&str>,
    word: &str,
    what: &str,
    count: usize,
) -> Result<u32, LoadError> {
    match part {
        None | Some("") => Ok(NONE),
        Some(part) => index(source, part, word, what, count),
    }
}

fn index(
    source: &SourceText<'_>,
    part: &str,
    word: &str,
    what: &str,
    count: usize,
) -> Result<u32, LoadError> {
    let number: i64 = part.parse().map_err(|_| not_a_corner(source, word))?;
    let from_zero = if number > 0 { number - 1 } else { number.saturating_add(count as i64) };
    if number == 0 {
        return Err(source.error(part, format!("there is no {what} 0")).with_help("indices count from 1"));
    }
    u32::try_from(from_zero).ok().filter(|&i| i != NONE).ok_or_else(|| {
        let message = format!("there is no {what} {number}");
        source.error(part, message).with_help(format!("{count} are defined before this line"))
    })
}

fn not_a_corner(source: &SourceText<'_>, word: &str) -> LoadError {
    source
        .error(word, format!("{} is not a corner of a face", quote(word)))
        .with_help("expected `v`, `v/vt`, `v//vn` or `v/vt/vn` with whole numbers")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn read(word: &str) -> Result<[u32; 3], String> {
        let source = SourceText::decode(Path::new("a.obj"), word.as_bytes()).unwrap();
        let counts = Counts { positions: 10, uvs: 20, normals: 30 };
        corner(&source, &source.text, counts)
            .map(|c| [c.position, c.uv, c.normal])
            .map_err(|error| error.to_string())
    }

    #[test]
    fn the_four_forms_are_read() {
        assert_eq!(read("3"), Ok([2, NONE, NONE]));
        assert_eq!(read("3/4"), Ok([2, 3, NONE]));
        assert_eq!(read("3//5"), Ok([2, NONE, 4]));
        assert_eq!(read("3/4/5"), Ok([2, 3, 4]));
        assert_eq!(read("3/"), Ok([2, NONE, NONE]));
        assert_eq!(read("3//"), Ok([2, NONE, NONE]));
    }

    #[test]
    fn negative_indices_count_from_the_end() {
        assert_eq!(read("-1/-20/-2"), Ok([9, 0, 28]));
        assert_eq!(
            read("-11").unwrap_err(),
            "a.obj:1:1: there is no vertex -11; 10 are defined before this line"
        );
        assert!(read("1/-21").unwrap_err().contains("no texture coordinate -21"));
    }

    #[test]
    fn zero_and_rubbish_are_refused() {
        assert_eq!(read("1/2/0").unwrap_err(), "a.obj:1:5: there is no normal 0; indices count from 1");
        for word in ["a", "1.5", "1/2/3/4", "/1", "1/a", "99999999999999999999", "--1"] {
            assert!(read(word).unwrap_err().contains("is not a corner of a face"), "{word}");
        }
        for word in ["4294967296", "9223372036854775807", "-9223372036854775808"] {
            assert!(read(word).unwrap_err().contains("there is no vertex"), "{word}");
        }
    }
}
