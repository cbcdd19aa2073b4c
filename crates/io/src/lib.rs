//! Files in and out: scene files, OBJ with MTL, textures, PNG and OpenEXR.

pub mod error;
pub mod file;
pub mod nearest;
pub mod view;

pub use error::{LoadError, Warning};
pub use view::{View, ViewTransform};
