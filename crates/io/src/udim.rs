//! UDIM: images side by side, one for each unit square of texture coordinates, whose names differ in a number.
//!
//! Number 1001 is the square at the origin; ten of them make a row, and rows go upwards.

use crate::error::{LoadError, quote};
use crate::image_file::Limits;
use heliostat_scene::texture::Tile;
use std::path::{Path, PathBuf};

/// What stands for the number in a name.
pub(crate) const MARK: &str = "<UDIM>";

/// Whether a name stands for many files.
pub(crate) fn is_tiled(name: &str) -> bool {
    name.contains(MARK)
}

/// The files that a path with [`MARK`] in its last part stands for, by their numbers.
///
/// # Errors
/// When there are none.
pub(crate) fn files(path: &Path) -> Result<Vec<(u32, PathBuf)>, LoadError> {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Some((before, after)) = name.split_once(MARK) else {
        return Err(LoadError::new(path, format!("has {MARK} in the name of a folder"))
            .with_help("write it in the name of the file"));
    };
    let number = |entry: &str| {
        let digits = entry.strip_prefix(before)?.strip_suffix(after)?;
        let is_number = digits.len() == 4 && digits.bytes().all(|b| b.is_ascii_digit());
        digits.parse().ok().filter(|number| is_number && *number > 1000)
    };
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut files: Vec<_> = names.filter_map(|name| Some((number(&name)?, folder.join(&name)))).collect();
    files.sort_unstable();
    if files.is_empty() {
        return Err(
            LoadError::new(path, "no tile found").with_help(format!("the first one is {before}1001{after}"))
        );
    }
    Ok(files)
}

/// Checks that all tiles together are within the limits of one image file.
///
/// # Errors
/// When they are not.
pub(crate) fn check_size(path: &Path, tiles: &[Tile]) -> Result<(), LoadError> {
    let most = Limits::default().bytes;
    let bytes: u64 = tiles.iter().map(|tile| tile.image.bytes() as u64).sum();
    if bytes <= most {
        return Ok(());
    }
    Err(LoadError::new(path, format!("{} tiles are {bytes} bytes, more than {most}", tiles.len()))
        .with_help("scale them down"))
}

/// A sentence about tiles that are missing between others of their row.
pub(crate) fn gaps(name: &str, numbers: &[u32]) -> Option<String> {
    let row = |number: u32| (number - 1001) / 10;
    let pairs = numbers.windows(2).filter(|pair| row(pair[0]) == row(pair[1]));
    let missing: Vec<String> =
        pairs.flat_map(|pair| pair[0] + 1..pair[1]).map(|number| number.to_string()).collect();
    (!missing.is_empty())
        .then(|| format!("{}: no tile {}; magenta stands there", quote(name), missing.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_found_by_their_numbers() {
        let folder = tempfile::tempdir().unwrap();
        for name in
            ["a.1011.png", "a.1001.png", "a.1000.png", "a.101.png", "a.10011.png", "b.1002.png", "a.1001.jpg"]
        {
            std::fs::write(folder.path().join(name), b"").unwrap();
        }
        let found = files(&folder.path().join("a.<UDIM>.png")).unwrap();
        assert_eq!(found.iter().map(|(number, _)| *number).collect::<Vec<_>>(), [1001, 1011]);
        let error = files(&folder.path().join("c.<UDIM>.png")).unwrap_err().to_string();
        assert!(error.ends_with("no tile found; the first one is c.1001.png"), "{error}");
    }

    #[test]
    fn gaps_within_a_row_are_told() {
        assert_eq!(gaps("a", &[1001, 1002, 1012]), None);
        let told = gaps("a", &[1001, 1004, 1011]).unwrap();
        assert_eq!(told, "`a`: no tile 1002, 1003; magenta stands there");
    }
}
