//! Open Image Denoise, found at run time: nothing is linked, and programs start without it.
//!
//! ```no_run
//! use heliostat_oidn::{Oidn, Picture};
//! # fn main() -> Result<(), heliostat_oidn::OidnError> {
//! let oidn = Oidn::find(None)?;
//! let color = vec![0.5; 3 * 64 * 64];
//! let picture = Picture { width: 64, height: 64, color: &color, albedo: None, normal: None };
//! let clean = oidn.denoise(&picture, 2)?;
//! # Ok(())
//! # }
//! ```
//!
//! # Source
//! Open Image Denoise 2 documentation, "API" and "RT" filter; its header `oidn.h`.

mod error;
mod find;
mod native;

pub use error::OidnError;
pub use find::ENVIRONMENT;

use native::Native;
use std::path::{Path, PathBuf};

/// A library that was found, with every function that is needed.
#[derive(Debug)]
pub struct Oidn {
    native: Native,
    path: PathBuf,
}

/// What is denoised: linear light and, if they are known, what helps to tell noise from detail. Each image has three
/// floats per pixel, row by row.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// Pixels per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Light, of any brightness; no number in it may be NaN or infinite.
    pub color: &'a [f32],
    /// Colours of surfaces in `[0, 1]`.
    pub albedo: Option<&'a [f32]>,
    /// Shading normals, `[-1, 1]`, 0 where there is no surface; looked at only together with `albedo`.
    pub normal: Option<&'a [f32]>,
}

impl Oidn {
    /// Opens the library at `given`, a file or a folder that holds it; without one, the one that the environment variable
    /// [`ENVIRONMENT`] names; without that, one of the system under its usual names.
    ///
    /// # Errors
    /// When there is no such library, or it lacks a function of version 2.
    pub fn find(given: Option<&Path>) -> Result<Self, OidnError> {
        let (native, path) = find::open(given)?;
        Ok(Self { native, path })
    }

    /// What was opened, as it was named.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Denoises on the processor with `threads` threads, 0 for all; three floats per pixel.
    ///
    /// # Errors
    /// When an image has another size than it says, or the library refuses: an unknown processor, too little memory.
    pub fn denoise(&self, picture: &Picture<'_>, threads: usize) -> Result<Vec<f32>, OidnError> {
        let floats = picture.width.checked_mul(picture.height).and_then(|n| n.checked_mul(3));
        let images = [Some(picture.color), picture.albedo, picture.normal];
        for image in images.into_iter().flatten() {
            if floats != Some(image.len()) {
                return Err(OidnError::Size {
                    width: picture.width,
                    height: picture.height,
                    floats: image.len(),
                });
            }
        }
        if picture.color.is_empty() {
            return Ok(Vec::new());
        }
        self.native.denoise(picture, threads)
    }

    /// Version of the library, as in `2.5.1`.
    ///
    /// # Errors
    /// When it knows no device on this machine.
    pub fn version(&self) -> Result<String, OidnError> {
        let number = self.native.version()?;
        Ok(format!("{}.{}.{}", number / 10_000, number / 100 % 100, number % 100))
    }
}
