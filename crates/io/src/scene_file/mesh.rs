//! `[[mesh]]` and `[[model]]`: OBJ and glTF files.
//!
//! A mesh is all of a file as one thing that objects share; a model is a file as it is, each group an object with
//! its own materials; of a glTF file all that it shows at the start of its animations, but not its cameras and lights.
//!
//! # Scene file
//! ```toml
//! [[mesh]]
//! name = "bunny"
//! file = "bunny.obj"             # relative to the scene file
//! smooth_angle = 60              # degrees; normals are made where the file has none, sharper edges stay edges
//! made_by = "cargo xtask assets" # optional: the command that makes the file, shown when it is missing
//!
//! [[model]]
//! name = "house"                 # the name of the file if left out; objects are called `house/group`
//! file = "house.obj"             # or .gltf, .glb
//! material = "clay"              # optional: instead of all its own materials
//! smooth_angle = 60              # of OBJ files
//! translate = [0, 0, -3]         # scale, rotate, translate or matrix, visible, casts_shadow, as for an object
//! ```

use super::number::{HalfTurn, NonZero};
use super::placement::{Matrix, impl_placement_keys};
use super::value::{Point, Splat};
use crate::document::Placed;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Degrees between two faces up to which the edge between them is smooth.
const SMOOTH_ANGLE: f64 = 60.0;

/// An OBJ file as one mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshTable {
    /// Name, unique among meshes.
    pub name: Placed<String>,
    /// Path of the OBJ file, relative to the scene file.
    pub file: Placed<String>,
    /// Largest angle in degrees of a smooth edge, where the file has no normals; 60 if left out, 0 for facets.
    pub smooth_angle: Option<HalfTurn>,
    /// The command that makes the file, shown when it is missing.
    pub made_by: Option<String>,
}

/// An OBJ or glTF file as it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModelTable {
    /// Name, unique among models, and the first part of the names of its objects; the name of the file if left out.
    pub name: Option<Placed<String>>,
    /// Path of the OBJ or glTF file (`.obj`, `.gltf`, `.glb`), relative to the scene file.
    pub file: Placed<String>,
    /// The name of a `[[material]]` that replaces those of the file.
    pub material: Option<Placed<String>>,
    /// Largest angle in degrees of a smooth edge, where the file has no normals; 60 if left out, 0 for facets.
    pub smooth_angle: Option<HalfTurn>,
    /// The command that makes the file, shown when it is missing.
    pub made_by: Option<String>,
    /// Scale, a number or `[x, y, z]`.
    pub scale: Option<Placed<Splat<NonZero, 3>>>,
    /// Turn in degrees about x, then y, then z.
    pub rotate: Option<Placed<Point>>,
    /// Shift in metres.
    pub translate: Option<Placed<Point>>,
    /// Three rows of four numbers in place of scale, rotate and translate.
    pub matrix: Option<Placed<Matrix>>,
    /// Whether camera rays see it; `true` if left out.
    pub visible: Option<bool>,
    /// Whether it throws shadows; `true` if left out.
    pub casts_shadow: Option<bool>,
}

impl_placement_keys!(ModelTable);

/// Radians of an optional angle.
pub(super) fn smooth_angle(degrees: Option<HalfTurn>) -> f32 {
    degrees.map_or(SMOOTH_ANGLE, HalfTurn::get).to_radians() as f32
}
