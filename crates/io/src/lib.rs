//! Files in and out: scene files, glTF, OBJ with MTL, textures, PNG and OpenEXR.

pub mod animation;
pub mod atomic;
pub mod compare;
mod document;
pub mod error;
pub mod exr_file;
pub mod file;
pub mod gltf;
mod ies;
pub mod image_file;
pub mod model;
pub mod nearest;
pub mod obj;
mod parallel;
pub mod picture;
pub mod png_file;
pub mod save_error;
pub mod scene_file;
pub mod schema;
pub mod source;
pub mod texture_cache;
mod udim;
pub mod view;
pub mod volume_file;

pub use error::{LoadError, Warning};
pub use save_error::SaveError;
pub use source::{OpenOptions, Shot, Source, open};
pub use view::{View, ViewTransform};
