//! Files in memory for OBJ tests.

use heliostat_io::LoadError;
use heliostat_io::obj::ObjFiles;
use heliostat_scene::Image;
use heliostat_scene::image::{Encoding, Samples};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Libraries and images by name.
#[derive(Debug, Default)]
pub(crate) struct MemoryFiles {
    pub(crate) libraries: HashMap<String, Vec<u8>>,
    pub(crate) images: HashMap<String, Arc<Image>>,
}

impl MemoryFiles {
    pub(crate) fn library(&mut self, name: &str, text: impl Into<String>) {
        self.libraries.insert(name.to_owned(), text.into().into_bytes());
    }

    /// An image of one row.
    pub(crate) fn image(&mut self, name: &str, channels: u8, values: &[u8]) {
        let width = (values.len() / usize::from(channels)) as u32;
        let samples = Samples::U8(values.to_vec());
        let image = Image::new(width, 1, channels, Encoding::Srgb, samples);
        self.images.insert(name.to_owned(), Arc::new(image));
    }
}

impl ObjFiles for MemoryFiles {
    fn library(&mut self, _: &Path, name: &str) -> Result<(PathBuf, Vec<u8>), LoadError> {
        let found = self.libraries.get(name).map(|bytes| (PathBuf::from(name), bytes.clone()));
        found.ok_or_else(|| LoadError::new(name, "file not found"))
    }

    fn image(&mut self, _: &Path, name: &str) -> Result<Arc<Image>, LoadError> {
        let name = name.trim_start_matches("./");
        self.images.get(name).cloned().ok_or_else(|| LoadError::new(name, "file not found"))
    }
}
