//! Where the files come from that an OBJ file names: material libraries and images.
//!
//! Names in OBJ files were often written on another computer. A name is tried as it is beside the file that has it, then
//! without regard to upper and lower case, then by its last part alone.

use crate::error::LoadError;
use crate::file::read_file;
use crate::nearest::suggestion;
use crate::texture_cache::TextureCache;
use heliostat_scene::Image;
use heliostat_scene::texture::Tile;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Gives the content of the files that an OBJ file and its libraries name.
pub trait ObjFiles {
    /// The path and the bytes of the library `name` (with `/` between folders), named in the file `from`.
    ///
    /// # Errors
    /// When there is no such file or it cannot be read.
    fn library(&mut self, from: &Path, name: &str) -> Result<(PathBuf, Vec<u8>), LoadError>;

    /// The image `name` (with `/` between folders), named in the file `from`.
    ///
    /// # Errors
    /// When there is no such file or it is no image.
    fn image(&mut self, from: &Path, name: &str) -> Result<Arc<Image>, LoadError>;

    /// The images that `name` with `<UDIM>` in it stands for, named in the file `from`.
    ///
    /// # Errors
    /// When there are none or one is no image; always, where folders cannot be looked into.
    fn tiles(&mut self, from: &Path, name: &str) -> Result<Vec<Tile>, LoadError> {
        Err(LoadError::new(from, format!("tiles are not looked for: {name}")))
    }
}

/// Files on disk, images through a cache.
#[derive(Debug)]
pub struct DiskFiles<'a> {
    textures: &'a mut TextureCache,
    max_bytes: u64,
}

impl<'a> DiskFiles<'a> {
    /// Images through `textures`, libraries of at most `max_bytes`.
    pub fn new(textures: &'a mut TextureCache, max_bytes: u64) -> Self {
        Self { textures, max_bytes }
    }
}

impl ObjFiles for DiskFiles<'_> {
    fn library(&mut self, from: &Path, name: &str) -> Result<(PathBuf, Vec<u8>), LoadError> {
        let path = find(from, name)?;
        let bytes = read_file(&path, self.max_bytes)?;
        Ok((path, bytes))
    }

    fn image(&mut self, from: &Path, name: &str) -> Result<Arc<Image>, LoadError> {
        self.textures.image(&find(from, name)?)
    }

    fn tiles(&mut self, from: &Path, name: &str) -> Result<Vec<Tile>, LoadError> {
        self.textures.tiles(&from.parent().unwrap_or(Path::new("")).join(name))
    }
}

/// The file that `name` in the file `from` means.
fn find(from: &Path, name: &str) -> Result<PathBuf, LoadError> {
    let folder = from.parent().unwrap_or(Path::new(""));
    let exact = folder.join(name);
    if exact.is_file() {
        return Ok(exact);
    }
    // Behind a drive letter begins a path of another computer; only its last part can be of use.
    let last = name.rsplit(['/', ':']).next().unwrap_or(name);
    let names = names_in(folder);
    ignoring_case(folder, name)
        .or_else(|| Some(folder.join(same_ignoring_case(&names, last)?)).filter(|path| path.is_file()))
        .ok_or_else(|| {
            let error = LoadError::new(&exact, "file not found");
            match suggestion(last, names.iter().map(String::as_str)) {
                Some(help) => error.with_help(help),
                None => error.with_help(format!("put it beside {}", from.display())),
            }
        })
}

/// `name` below `folder`, each part spelt as it is on disk.
fn ignoring_case(folder: &Path, name: &str) -> Option<PathBuf> {
    let mut path = folder.to_owned();
    for part in name.split('/').filter(|part| !part.is_empty() && *part != ".") {
        let next = path.join(part);
        path = if part == ".." || next.exists() {
            next
        } else {
            let names = names_in(&path);
            path.join(same_ignoring_case(&names, part)?)
        };
    }
    path.is_file().then_some(path)
}

fn same_ignoring_case<'a>(names: &'a [String], wanted: &str) -> Option<&'a str> {
    let wanted = wanted.to_lowercase();
    names.iter().find(|name| name.to_lowercase() == wanted).map(String::as_str)
}

/// The names in a folder, sorted; none when it cannot be read.
fn names_in(folder: &Path) -> Vec<String> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let Ok(entries) = folder.read_dir() else {
        return Vec::new();
    };
    let mut names: Vec<_> =
        entries.flatten().filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort_unstable();
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for file in files {
            let path = folder.path().join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, b"").unwrap();
        }
        folder
    }

    fn found(folder: &tempfile::TempDir, name: &str) -> Result<String, String> {
        let path = find(&folder.path().join("a.obj"), name).map_err(|error| error.to_string())?;
        Ok(path.strip_prefix(folder.path()).unwrap().to_string_lossy().into_owned())
    }

    #[test]
    fn names_are_found_as_written_first() {
        let folder = folder(&["wood.png", "Wood.png", "tex/wood.png"]);
        assert_eq!(found(&folder, "wood.png").unwrap(), "wood.png");
        assert_eq!(found(&folder, "Wood.png").unwrap(), "Wood.png");
        assert_eq!(found(&folder, "./tex/wood.png").unwrap(), "tex/wood.png");
    }

    #[test]
    fn case_and_foreign_folders_do_not_matter() {
        let folder = folder(&["tex/Wood.PNG", "stone.jpg"]);
        assert_eq!(found(&folder, "TEX/wood.png").unwrap(), "tex/Wood.PNG");
        assert_eq!(found(&folder, "C:/Users/me/Stone.JPG").unwrap(), "stone.jpg");
        assert_eq!(found(&folder, "/no/such/folder/stone.jpg").unwrap(), "stone.jpg");
    }

    #[test]
    fn a_near_name_is_suggested() {
        let folder = folder(&["stone.jpg"]);
        assert!(
            found(&folder, "stoone.jpg").unwrap_err().ends_with("file not found; did you mean `stone.jpg`?")
        );
        assert!(find(Path::new("no-such-folder/a.obj"), "b.png").is_err());
    }
}
