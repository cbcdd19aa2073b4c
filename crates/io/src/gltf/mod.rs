//! glTF 2.0, as JSON with files beside it or as one GLB: a model as a scene.
//!
//! # Way of the data
//!
//! `container` and `json` (bytes to the structures of the crate `gltf`) -> `document` with `uri` and `meshopt` (buffers and their
//! views) -> `accessor` (numbers, checked) -> `mesh` (triangles, morphed and bent), `material` with `textures` and
//! `images`, `animation` with `nodes` and `motion` (where things are), `lights`, `cameras`, `instancing`, `variants` -> `scene`
//! (a [`Scene`] at a moment). `contents` tells what a file holds without reading its buffers.
//!
//! # Conventions
//!
//! Each primitive becomes an object and, with all others of the same accessors, one mesh; nodes become its transform,
//! composed in `f64`. Texture coordinates are turned to grow upwards. Lights keep their numbers: a candela is a watt per
//! steradian here, a lux a watt per square metre. Of materials see `material`. Meshes that bend or morph are as they are in the
//! middle of the shutter; nodes and cameras move while it is open. All animations play at once.
//!
//! # What a damaged file can do
//!
//! Every number that leads somewhere is checked, every length is held against the bytes that are there before anything is
//! allocated for it, and the hierarchy is walked without recursion. The crate's own readers trust what they read; they are
//! not used.
//!
//! # Source
//! Khronos, "glTF 2.0 Specification", version 2.0.1, 2021, and the ratified extensions in its registry.

mod accessor;
mod animation;
mod cameras;
mod container;
mod contents;
mod document;
mod draco;
mod extensions;
mod flaw;
mod images;
mod instancing;
mod json;
mod lights;
mod material;
mod mesh;
mod meshopt;
mod motion;
mod nodes;
mod scene;
mod textures;
mod uri;
mod variants;

pub use contents::{Contents, ImageSize, Named};

use crate::error::{LoadError, Warning};
use crate::nearest::nearest_name;
use animation::Tracks;
use document::Document;
use flaw::Flaw;
use heliostat_geometry::TriMesh;
use heliostat_scene::Scene;
use images::Images;
use lights::Lights;
use mesh::PrimitiveKey;
use nodes::Nodes;
use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex};

/// A glTF file that is open: what was read of it once serves every moment.
#[derive(Debug)]
pub struct GltfModel {
    document: Document,
    nodes: Nodes,
    tracks: Tracks,
    lights: Lights,
    images: Images,
    variants: Vec<String>,
    /// Meshes that neither bend nor morph.
    meshes: Mutex<HashMap<PrimitiveKey, Arc<TriMesh>>>,
}

/// When and how a model is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The time of its animations in seconds.
    pub seconds: f64,
    /// How long the shutter is open around that time, in seconds.
    pub shutter: f64,
    /// Width over height of the picture, for its cameras.
    pub aspect: f32,
    /// Index of the variant of its materials; `None` for those of its own.
    pub variant: Option<usize>,
}

impl Default for Moment {
    fn default() -> Self {
        Self { seconds: 0.0, shutter: 0.0, aspect: 16.0 / 9.0, variant: None }
    }
}

impl GltfModel {
    /// Opens a `.gltf` or `.glb`; meshes and images wait until a scene is asked for.
    ///
    /// # Errors
    /// When it is missing, damaged, or needs an extension that is not read.
    pub fn open(path: &Path) -> Result<Self, LoadError> {
        Self::of(Document::open(path)?).map_err(|flaw| flaw.into_error(path))
    }

    /// Opens a model from the bytes of its file; `path` serves messages and is what the names of files are relative to.
    ///
    /// # Errors
    /// As [`GltfModel::open`].
    pub fn parse(path: &Path, bytes: Vec<u8>) -> Result<Self, LoadError> {
        let document = Document::new(path, bytes);
        document.and_then(Self::of).map_err(|flaw| flaw.into_error(path))
    }

    fn of(document: Document) -> Result<Self, Flaw> {
        Ok(Self {
            nodes: Nodes::of(&document)?,
            tracks: Tracks::of(&document)?,
            lights: Lights::of(&document)?,
            images: Images::of(&document),
            variants: variants::names(&document)?,
            meshes: Mutex::default(),
            document,
        })
    }

    /// The scene at a moment, with what was left out or mended. It has the file's own cameras and lights, and no background.
    ///
    /// # Errors
    /// When something that is shown is damaged. Missing images are warnings.
    pub fn scene(&self, moment: &Moment) -> Result<(Scene, Vec<Warning>), LoadError> {
        let path = &self.document.path;
        let (scene, flaws) = scene::read(self, moment).map_err(|flaw| flaw.into_error(path))?;
        Ok((scene, flaws.into_iter().map(|flaw| flaw.into_warning(path)).collect()))
    }

    /// The time of the last key of its animations in seconds; `None` where nothing moves.
    pub fn last_key(&self) -> Option<f64> {
        self.tracks.last_key()
    }

    /// The names of the cameras that scenes have.
    pub fn camera_names(&self) -> Vec<String> {
        cameras::names(&self.document, &self.nodes.shown)
    }

    /// The names of the variants of its materials.
    pub fn variants(&self) -> &[String] {
        &self.variants
    }

    /// The index of a variant.
    ///
    /// # Errors
    /// When there is none of that name.
    pub fn variant(&self, name: &str) -> Result<usize, LoadError> {
        let names = || self.variants.iter().map(String::as_str);
        let found = self.variants.iter().position(|variant| variant == name);
        found.ok_or_else(|| {
            let help = match (nearest_name(name, names()), self.variants.is_empty()) {
                (_, true) => "it has no variants at all".to_owned(),
                (Some(near), _) => format!("did you mean `{near}`?"),
                (None, _) => format!("it has {}", names().collect::<Vec<_>>().join(", ")),
            };
            let message = format!("has no variant {}", crate::error::quote(name));
            LoadError::new(&self.document.path, message).with_help(help)
        })
    }

    /// What is in the file.
    pub fn contents(&self) -> Contents {
        contents::of(self)
    }
}

#[cfg(test)]
mod tests;
