//! Files that are either the old ones or whole: written beside their target, synced, renamed.
//!
//! A reader, or a machine that loses power, never sees half a picture. Streams and devices (`/dev/stdout`, a named pipe)
//! cannot be replaced and are written directly.

use crate::save_error::SaveError;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Writes the file at `path` through `write`; when it fails, whatever was at `path` stays.
///
/// A new file has the permissions that the user's umask gives, a replaced one keeps its own. A symbolic link stays and
/// its target is replaced.
///
/// # Errors
/// Where the folder is missing, the target is a folder or not writable, the disk is full, or `write` fails.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), SaveError> {
    let result = if is_stream(path) { write_stream(path, write) } else { replace(path, write) };
    result.map_err(|error| SaveError::io(path, error))
}

/// Whether `path` names something that is open or endless rather than a file.
fn is_stream(path: &Path) -> bool {
    // These may be redirected into a file: it is still the open stream that was asked for.
    let open_ones = ["/dev/stdout", "/dev/stderr", "/dev/fd", "/proc"];
    open_ones.iter().any(|open| path.starts_with(open))
        || fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir())
}

fn write_stream(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::new(OpenOptions::new().write(true).open(path)?);
    write(&mut out)?;
    out.flush()
}

fn replace(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let target = follow_links(path)?;
    let old = old_metadata(&target)?;
    let folder = target.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // Dropping `temporary` on any error below removes it.
    let temporary = temporary_beside(&target, folder)?;
    let mut out = BufWriter::new(temporary);
    write(&mut out)?;
    let temporary = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    if let Some(old) = old {
        temporary.as_file().set_permissions(old.permissions())?;
    }
    // The content must be on the disk before the name points to it.
    temporary.as_file().sync_all()?;
    temporary.persist(&target).map_err(|e| e.error)?;
    sync_folder(folder);
    Ok(())
}

/// Where a chain of symbolic links ends; the end need not exist.
fn follow_links(path: &Path) -> io::Result<PathBuf> {
    /// As many as Linux follows.
    const MOST_LINKS: u32 = 40;
    let mut at = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&at) {
            Ok(next) => at = at.parent().unwrap_or(Path::new("")).join(next),
            // No link, or nothing there at all.
            Err(_) => return Ok(at),
        }
    }
    Err(io::Error::other("too many symbolic links, or a circle of them"))
}

/// The metadata of a file that is about to be replaced, once it is sure that the user may write it.
fn old_metadata(target: &Path) -> io::Result<Option<fs::Metadata>> {
    match fs::metadata(target) {
        Ok(old) if old.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(old) => {
            // Renaming would replace a write-protected file without a word.
            OpenOptions::new().write(true).open(target)?;
            Ok(Some(old))
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            if target.as_os_str().to_string_lossy().ends_with('/') {
                return Err(io::ErrorKind::IsADirectory.into());
            }
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

/// An empty file in `folder`, hidden, readable by whom the umask lets.
fn temporary_beside(target: &Path, folder: &Path) -> io::Result<NamedTempFile> {
    /// Characters of the name; leaves room for the random part within the 255 bytes of a file name.
    const LONGEST: usize = 40;
    let name = target.file_name().ok_or(io::ErrorKind::IsADirectory)?.to_string_lossy();
    let prefix = format!(".{}.", name.chars().take(LONGEST).collect::<String>());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    #[cfg(unix)]
    let builder = builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

/// Puts the new name on the disk. Some network file systems refuse; the file is in place all the same.
fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}
