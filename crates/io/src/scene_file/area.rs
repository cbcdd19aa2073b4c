//! `area = { .. }` of a `[[light]]`: a surface that shines.
//!
//! Flat shapes shine to the side of their normal, up, before they are turned.
//!
//! # Scene file
//! ```toml
//! [[light]]
//! [light.area]
//! rectangle = { size = [1, 2] }  # exactly one of the finite shapes, or mesh = "name"; see the module `shape`
//! translate = [0, 4, 0]          # scale, rotate, translate or matrix, as for an object
//! look_at = "ball"               # in place of rotate: turns the y axis of the shape to a point or object
//! two_sided = false              # whether the back shines too
//! visible = true                 # whether camera rays, mirrors and glass see it
//! falloff = "inverse_square"     # "none"
//! ```

use super::choice::{choice, exactly_one, without_effect};
use super::light::FalloffName;
use super::number::NonZero;
use super::placement::{Matrix, impl_placement_keys};
use super::shape::{
    ConeTable, CuboidTable, CylinderTable, DiskTable, PlaneTable, RectangleTable, SphereTable, TorusTable,
    TriangleTable, impl_shape_keys,
};
use super::targets::Targets;
use super::value::{Point, Splat, Target, vector};
use crate::document::{Fault, Placed, Span};
use glam::{DAffine3, DMat3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A surface that shines.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AreaTable {
    /// A sphere around the origin.
    pub sphere: Option<Placed<SphereTable>>,
    /// A box around the origin.
    pub cuboid: Option<Placed<CuboidTable>>,
    /// Refused: a plane without end gives endless light.
    #[schemars(skip)]
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
    /// Scale, a number or `[x, y, z]`.
    pub scale: Option<Placed<Splat<NonZero, 3>>>,
    /// Turn in degrees about x, then y, then z.
    pub rotate: Option<Placed<Point>>,
    /// Shift in metres.
    pub translate: Option<Placed<Point>>,
    /// Three rows of four numbers in place of scale, rotate and translate.
    pub matrix: Option<Placed<Matrix>>,
    /// The point or object that the y axis of the shape is turned to.
    pub look_at: Option<Placed<Target>>,
    /// Whether the back shines too; `false` if left out.
    pub two_sided: Option<bool>,
    /// Whether camera rays, mirrors and glass see it; `true` if left out.
    pub visible: Option<bool>,
    /// How the light weakens on its way; `inverse_square` if left out.
    pub falloff: Option<FalloffName>,
}

impl_shape_keys!(AreaTable);
impl_placement_keys!(AreaTable);

impl AreaTable {
    /// Refuses a light without a surface, or with one that has no end.
    pub(super) fn check(&self, table: Option<Span>) -> Result<(), Fault> {
        exactly_one("the area light", "shape", table, &self.shape_keys().choices())?;
        match &self.plane {
            None => Ok(()),
            Some(plane) => Err(Fault::new("an infinite plane cannot be an area light")
                .with_help("use `rectangle` or `disk`, or a `directional` light")
                .or_at(plane.span())),
        }
    }

    /// From the space of the shape to the world.
    pub(super) fn affine(&self, targets: &Targets<'_>) -> Result<DAffine3, Fault> {
        let placed = self.placement_keys().affine()?;
        let Some(target) = &self.look_at else { return Ok(placed) };
        let turns = [choice("rotate", self.rotate.as_ref()), choice("matrix", self.matrix.as_ref())];
        without_effect("beside `look_at`", &turns)?;
        let position = self.translate.as_ref().map_or(DVec3::ZERO, |t| vector(t));
        let up = targets.direction(position, target)?;
        // The x axis stays level, so that a rectangle hangs straight.
        let right = DVec3::Y.cross(up).try_normalize().unwrap_or(DVec3::X);
        let turn = DMat3::from_cols(right, up, right.cross(up));
        Ok(DAffine3 { matrix3: turn * placed.matrix3, translation: position })
    }
}
