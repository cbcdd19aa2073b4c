//! Reading whole files with a limit.

use crate::error::LoadError;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The bytes of a regular file of at most `limit` bytes.
///
/// # Errors
/// When the file is missing, unreadable, no regular file (a pipe or device could block or never end) or longer.
pub fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, LoadError> {
    let io_error = |error| LoadError::io(path, &error);
    // Asked before opening: opening a pipe blocks until somebody writes to it.
    let metadata = path.metadata().map_err(io_error)?;
    if metadata.is_dir() {
        return Err(LoadError::new(path, "is a folder").with_help("name a file in it"));
    }
    if !metadata.is_file() {
        return Err(LoadError::new(path, "is not a regular file").with_help("copy its content into a file"));
    }
    let too_long = || {
        LoadError::new(path, format!("is longer than the limit of {limit} bytes"))
            .with_help("split or shrink the file")
    };
    if metadata.len() > limit {
        return Err(too_long());
    }
    let mut bytes = Vec::with_capacity(metadata.len() as usize);
    // The file may have grown since: never read more than the limit and one.
    File::open(path)
        .and_then(|file| file.take(limit.saturating_add(1)).read_to_end(&mut bytes))
        .map_err(io_error)?;
    if bytes.len() as u64 > limit { Err(too_long()) } else { Ok(bytes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_is_the_last_size_that_passes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, b"12345").unwrap();
        assert_eq!(read_file(&path, 5).unwrap(), b"12345");
        assert!(read_file(&path, 4).unwrap_err().to_string().contains("limit of 4 bytes"));
    }

    #[test]
    fn folders_and_missing_files_are_told_apart() {
        let folder = tempfile::tempdir().unwrap();
        assert!(read_file(folder.path(), 9).unwrap_err().to_string().contains("is a folder"));
        assert!(read_file(&folder.path().join("b"), 9).unwrap_err().to_string().contains("not found"));
    }
}
