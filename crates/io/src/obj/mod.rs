//! Wavefront OBJ with MTL: a model as meshes, materials and textures that a scene can take in.
//!
//! Polygons of any shape, all forms of indices, objects and groups, smoothing groups, vertex colours, material libraries
//! with their textures. Points, lines, curves and surfaces are left out with a warning. A file that cannot be understood
//! is refused with line and column; what can be mended is mended and told in [`ObjModel::warnings`].
//!
//! # Way of the data
//!
//! `text` (bytes to statements) -> `parse`, `face` and `number` (statements to the arrays of `raw`, checked) -> `libraries` with `mtl`, `map`,
//! `material`, `textures` and `channel` (materials) -> `normals` (missing ones) -> `build` with `triangulate` (one mesh per
//! group) -> [`ObjModel::append_to`].
//!
//! # Why not `tobj`
//!
//! `tobj` 4 gives errors without lines, refuses files with continued lines, comments behind faces, Latin-1 bytes or
//! colours on some vertices, drops smoothing groups and the difference between `o` and `g`, gives faces without normals
//! the first normal of the file, and leaves the options of textures in their names. An adapter that checks every number
//! and index with its line, and rewrites all of that, has parsed the file by then: handing the text over to be parsed
//! once more would double the time and gain nothing. So this module is the parser, and `tobj` is the witness in its
//! tests: on well-formed files both must give the same triangles.
//!
//! # Source
//! Wavefront Technologies, "Advanced Visualizer Manual", appendix B1; "MTL Material Format" in Murray and vanRyper,
//! "Encyclopedia of Graphics File Formats", 2nd edition, 1996.

mod append;
mod build;
mod channel;
mod face;
mod files;
mod lamps;
mod libraries;
mod map;
mod material;
mod mtl;
mod normals;
mod number;
mod parse;
mod raw;
mod text;
mod textures;
mod triangulate;
mod warnings;

pub(crate) use build::unique;

pub use append::Placement;
pub use files::{DiskFiles, ObjFiles};

use crate::error::{LoadError, Warning};
use crate::file::read_file;
use crate::texture_cache::TextureCache;
use heliostat_geometry::TriMesh;
use heliostat_scene::{Material, Texture};
use std::path::Path;
use std::sync::Arc;
use text::SourceText;

/// What becomes one mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Split {
    /// The faces of each pair of object and group.
    #[default]
    Groups,
    /// All faces of the file.
    Whole,
}

/// How to read a model.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjOptions {
    /// Faces that meet at a larger angle, in radians, have an edge between them; only for corners without a normal.
    pub smooth_angle: f32,
    /// What becomes one mesh.
    pub split: Split,
    /// Whether material libraries are read; without them every material is grey.
    pub materials: bool,
    /// Longest file to read, in bytes; at most 4 GiB.
    pub max_bytes: u64,
}

impl Default for ObjOptions {
    fn default() -> Self {
        Self {
            smooth_angle: 60_f32.to_radians(),
            split: Split::Groups,
            materials: true,
            max_bytes: u64::from(u32::MAX),
        }
    }
}

/// One object or group of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjObject {
    /// `object/group`, or the one that is given; empty when neither is. Unique in the model.
    pub name: String,
    /// Triangles with normals; the slots count in `materials`.
    pub mesh: Arc<TriMesh>,
    /// Index into [`ObjModel::materials`] for each slot.
    pub materials: Vec<usize>,
}

/// A model: all ids count in its own arrays.
#[derive(Clone, Debug)]
pub struct ObjModel {
    /// In the order of the file.
    pub objects: Vec<ObjObject>,
    /// The materials that are used.
    pub materials: Vec<Material>,
    /// The textures of the materials.
    pub textures: Vec<Texture>,
    /// What was mended or left out.
    pub warnings: Vec<Warning>,
}

/// Reads a model from disk.
///
/// # Errors
/// When the file or a library of it is damaged. Missing libraries and textures are warnings.
pub fn load_obj(
    path: &Path,
    options: &ObjOptions,
    textures: &mut TextureCache,
) -> Result<ObjModel, LoadError> {
    let max_bytes = options.max_bytes.min(u64::from(u32::MAX));
    let bytes = read_file(path, max_bytes)?;
    parse_obj(path, &bytes, options, &mut DiskFiles::new(textures, max_bytes))
}

/// Reads a model from memory; `path` serves messages and is what the names of libraries are relative to.
///
/// # Errors
/// When the text or a library is damaged.
pub fn parse_obj(
    path: &Path,
    bytes: &[u8],
    options: &ObjOptions,
    files: &mut dyn ObjFiles,
) -> Result<ObjModel, LoadError> {
    let source = SourceText::decode(path, bytes)?;
    // Offsets and counts are kept in 32 bits; every vertex and corner takes at least two bytes of text.
    if source.text.len() > u32::MAX as usize {
        return Err(LoadError::new(path, "is longer than 4 GiB").with_help("split it into several files"));
    }
    let mut raw = parse::parse(&source)?;
    if !options.materials {
        raw.libraries.clear();
    }
    let mut materials = libraries::load(&source, &mut raw, files)?;
    normals::fill_in(&mut raw, options.smooth_angle);
    let objects = build::objects(&source, &mut raw, options.split, &|name| materials.of(name))?;
    lamps::darken_backs(&objects, &mut materials.materials);
    Ok(ObjModel {
        objects,
        materials: materials.materials,
        textures: materials.textures,
        warnings: raw.warnings.finish(path),
    })
}
