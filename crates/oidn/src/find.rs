//! Where the library is looked for.

use crate::error::OidnError;
use crate::native::Native;
use std::path::{Path, PathBuf};

/// The environment variable that names the library, or the folder that holds it.
pub const ENVIRONMENT: &str = "HELIOSTAT_OIDN";

/// The usual names on this system, the best one first.
const NAMES: &[&str] = if cfg!(windows) {
    &["OpenImageDenoise.dll"]
} else if cfg!(target_os = "macos") {
    &["libOpenImageDenoise.2.dylib", "libOpenImageDenoise.dylib"]
} else {
    &["libOpenImageDenoise.so.2", "libOpenImageDenoise.so"]
};

/// Opens the library that was named, or the system's.
pub(crate) fn open(given: Option<&Path>) -> Result<(Native, PathBuf), OidnError> {
    let from_environment = || std::env::var_os(ENVIRONMENT).filter(|v| !v.is_empty()).map(PathBuf::from);
    if let Some(path) = given.map(Path::to_path_buf).or_else(from_environment) {
        let file = in_folder(&path);
        return Ok((Native::open(&file)?, file));
    }
    let mut first = None;
    for name in NAMES {
        match Native::open(Path::new(name)) {
            Ok(native) => return Ok((native, PathBuf::from(name))),
            // A library that is there and of no use is worth telling; one that is not there is not.
            Err(error @ OidnError::Incomplete { .. }) => first = first.or(Some(error)),
            Err(_) => {}
        }
    }
    Err(first.unwrap_or(OidnError::NotFound))
}

/// The library in a folder or in the `lib` below it; a file is itself. A bare name is left to the system, a path is not.
fn in_folder(path: &Path) -> PathBuf {
    if !path.is_dir() {
        return path.to_path_buf();
    }
    let folders = [path.to_path_buf(), path.join("lib")];
    let files = folders.iter().flat_map(|folder| NAMES.iter().map(|name| folder.join(name)));
    files.into_iter().find(|file| file.is_file()).unwrap_or_else(|| path.join(NAMES[0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_stands_for_its_library() {
        let folder = std::env::temp_dir().join(format!("heliostat-oidn-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("lib")).unwrap();
        let file = folder.join("lib").join(NAMES[0]);
        std::fs::write(&file, b"no library").unwrap();
        assert_eq!(in_folder(&folder), file);
        assert_eq!(in_folder(&file), file);
        let error = open(Some(&folder)).unwrap_err();
        assert!(matches!(&error, OidnError::CannotOpen { path, .. } if *path == file), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
