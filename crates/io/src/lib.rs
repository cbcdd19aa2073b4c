//! Files in and out: scene files, OBJ with MTL, textures, PNG and OpenEXR.

pub mod error;
pub mod file;
pub mod nearest;

pub use error::{LoadError, Warning};
