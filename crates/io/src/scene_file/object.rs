//! `[[object]]`: a shape, a mesh or a group, with materials, at a place.
//!
//! # Scene file
//! ```toml
//! [[object]]
//! name = "ball"                  # `object`, `object2`, ... if left out
//! sphere = { radius = 1 }        # exactly one shape, or mesh = "name", see the module `shape`; or group = "name"
//! material = "glass"             # a matte grey if left out; materials = ["wall", "roof"] for the slots of a mesh
//! scale = 1                      # see the module `placement`
//! rotate = [0, 0, 0]
//! translate = [0, 1, 0]
//! visible = true                 # whether camera rays see it
//! casts_shadow = true
//! copies = { count = [3, 1, 1], step = [2, 0, 0] } # optional; see the module `copies`
//! ```

use super::choice::{at_most_one, choice, exactly_one, without_effect};
use super::copies::CopiesTable;
use super::names::Names;
use super::number::NonZero;
use super::placement::{Matrix, impl_placement_keys};
use super::shape::{
    ConeTable, CuboidTable, CylinderTable, DiskTable, PlaneTable, RectangleTable, SphereTable, TorusTable,
    TriangleTable, impl_shape_keys,
};
use super::value::{Point, Splat};
use crate::document::{Fault, Placed, Span};
use crate::error::quote;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A shape, a mesh or a group, with materials, at a place.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ObjectTable {
    /// Name, unique among objects; becomes the Cryptomatte name. `object`, `object2`, ... if left out.
    pub name: Option<Placed<String>>,
    /// A sphere around the origin.
    pub sphere: Option<Placed<SphereTable>>,
    /// A box around the origin.
    pub cuboid: Option<Placed<CuboidTable>>,
    /// The infinite plane y = 0.
    pub plane: Option<Placed<PlaneTable>>,
    /// A rectangle in the plane y = 0.
    pub rectangle: Option<Placed<RectangleTable>>,
    /// A disk in the plane y = 0.
    pub disk: Option<Placed<DiskTable>>,
    /// A cylinder that stands on y = 0.
    pub cylinder: Option<Placed<CylinderTable>>,
    /// A cone that stands on y = 0.
    pub cone: Option<Placed<ConeTable>>,
    /// A ring around the y axis.
    pub torus: Option<Placed<TorusTable>>,
    /// One triangle.
    pub triangle: Option<Placed<TriangleTable>>,
    /// The name of a `[[mesh]]`.
    pub mesh: Option<Placed<String>>,
    /// The name of a `[[group]]`.
    pub group: Option<Placed<String>>,
    /// The name of a `[[material]]`. A matte grey named `default` if left out.
    pub material: Option<Placed<String>>,
    /// Names of materials by the slots of a mesh (`usemtl` in the order of the file); the last serves all further
    /// slots.
    pub materials: Option<Placed<Vec<Placed<String>>>>,
    /// Copies in a regular array, placed by the keys below.
    pub copies: Option<Placed<CopiesTable>>,
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
    /// Whether it throws shadows; `true` if left out. What throws none is seen by the camera, by mirrors and through glass alone,
    /// and takes no light from its surroundings.
    pub casts_shadow: Option<bool>,
}

impl_shape_keys!(ObjectTable);
impl_placement_keys!(ObjectTable);

impl ObjectTable {
    /// Refuses an object that is nothing, or several things at once.
    pub(super) fn check(&self, name: &str, table: Option<Span>) -> Result<(), Fault> {
        let owner = format!("the object {}", quote(name));
        let group = [choice("group", self.group.as_ref())];
        exactly_one(&owner, "shape", table, &[&self.shape_keys().choices()[..], &group].concat())?;
        let materials =
            [choice("material", self.material.as_ref()), choice("materials", self.materials.as_ref())];
        if self.group.is_some() {
            without_effect("beside `group`, whose objects have their own", &materials)?;
        }
        at_most_one(&materials)
    }

    /// The indices of the named materials; empty when none is named.
    pub(super) fn material_indices(&self, names: &Names) -> Result<Vec<usize>, Fault> {
        if let Some(materials) = &self.materials {
            if materials.is_empty() {
                return Err(Fault::new("`materials` is empty")
                    .with_help("name at least one material, or remove the key")
                    .or_at(materials.span()));
            }
            return materials.iter().map(|name| names.find(name)).collect();
        }
        self.material.iter().map(|name| names.find(name)).collect()
    }
}
