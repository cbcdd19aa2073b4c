//! What can go wrong with a library that is found at run time.

use crate::find::ENVIRONMENT;
use std::path::PathBuf;

/// Why nothing was denoised.
#[derive(Debug, thiserror::Error)]
pub enum OidnError {
    /// No library under any of the usual names.
    #[error(
        "Open Image Denoise 2 is not installed; install it (openimagedenoise.org, or `pip install pyoidn`) and name \
         libOpenImageDenoise with --oidn LIB or in {ENVIRONMENT}"
    )]
    NotFound,
    /// The library that was named cannot be opened.
    #[error(
        "{}: cannot be opened as Open Image Denoise: {cause}; name the file libOpenImageDenoise.so.2 (.dylib, .dll) \
         or its folder", path.display()
    )]
    CannotOpen {
        /// The file.
        path: PathBuf,
        /// What the system says.
        cause: String,
    },
    /// It lacks a function.
    #[error("{}: has no `{function}`; install version 2 of Open Image Denoise", path.display())]
    Incomplete {
        /// The file.
        path: PathBuf,
        /// The function.
        function: &'static str,
    },
    /// It refused to work.
    #[error(
        "Open Image Denoise: {message} (error {code}); see its system requirements, or try another version"
    )]
    Refused {
        /// Its number.
        code: i32,
        /// Its words.
        message: String,
    },
    /// An image is not as large as it says.
    #[error("{width} x {height} pixels are not {floats} floats; give three floats per pixel")]
    Size {
        /// Pixels per row.
        width: usize,
        /// Rows.
        height: usize,
        /// What there is.
        floats: usize,
    },
}
