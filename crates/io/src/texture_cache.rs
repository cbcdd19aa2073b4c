//! Image files for textures, each read once.

use crate::error::LoadError;
use crate::image_file::{Limits, read_image};
use crate::udim;
use heliostat_scene::Image;
use heliostat_scene::texture::Tile;
use std::collections::HashMap;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads an image file.
type Read = dyn Fn(&Path) -> Result<Image, LoadError> + Send + Sync;

/// The image files that have been read, or could not be.
pub struct TextureCache {
    read: Box<Read>,
    images: HashMap<PathBuf, Result<Arc<Image>, LoadError>>,
}

impl TextureCache {
    /// An empty cache for files within `limits`.
    pub fn new(limits: Limits) -> Self {
        Self::with_reader(move |path| read_image(path, &limits))
    }

    /// An empty cache that reads files with `read`.
    pub fn with_reader(read: impl Fn(&Path) -> Result<Image, LoadError> + Send + Sync + 'static) -> Self {
        Self { read: Box::new(read), images: HashMap::new() }
    }

    /// The image in a file; a file that could not be read before is not tried again.
    ///
    /// # Errors
    /// Those of the reader.
    pub fn image(&mut self, path: &Path) -> Result<Arc<Image>, LoadError> {
        if let Some(known) = self.images.get(path) {
            return known.clone();
        }
        let image = (self.read)(path).map(Arc::new);
        self.images.insert(path.to_owned(), image.clone());
        image
    }
}

impl TextureCache {
    /// The images that a path with `<UDIM>` in its name stands for.
    ///
    /// # Errors
    /// When there are none, one of them cannot be read, or all of them together are too large.
    pub(crate) fn tiles(&mut self, path: &Path) -> Result<Vec<Tile>, LoadError> {
        let mut tiles = Vec::new();
        for (number, file) in udim::files(path)? {
            tiles.push(Tile { number, image: self.image(&file)? });
            udim::check_size(path, &tiles)?;
        }
        Ok(tiles)
    }
}

impl fmt::Debug for TextureCache {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TextureCache").field("files", &self.images.keys()).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::image::{Encoding, Samples};
    use std::sync::atomic::{AtomicU32, Ordering};

    #[test]
    fn each_file_is_read_once_good_or_bad() {
        let reads = Arc::new(AtomicU32::new(0));
        let counter = Arc::clone(&reads);
        let mut cache = TextureCache::with_reader(move |path| {
            counter.fetch_add(1, Ordering::Relaxed);
            if path == Path::new("bad") {
                return Err(LoadError::new(path, "bad"));
            }
            let samples = Samples::U8(vec![0]);
            Ok(Image::new(1, 1, 1, Encoding::Srgb, samples))
        });
        let first = cache.image(Path::new("a")).unwrap();
        assert!(Arc::ptr_eq(&first, &cache.image(Path::new("a")).unwrap()));
        assert!(cache.image(Path::new("bad")).is_err() && cache.image(Path::new("bad")).is_err());
        assert_eq!(reads.load(Ordering::Relaxed), 2);
    }
}
