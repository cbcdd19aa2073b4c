//! What an object or an area light is made of: one of the analytic shapes, or a mesh.
//!
//! Flat shapes lie in the plane y = 0 and face up; cylinder and cone stand on it; sphere, cuboid and torus are
//! centred at the origin. `scale`, `rotate` and `translate` put them into the world; see [`super::placement`].
//!
//! # Scene file
//! ```toml
//! sphere    = { radius = 1 }
//! cuboid    = { size = [1, 2, 3] }                       # full side lengths
//! plane     = {}                                         # without end
//! rectangle = { size = [4, 2] }                          # along x and z
//! disk      = { radius = 1, inner_radius = 0.5 }
//! cylinder  = { radius = 1, height = 2, capped = true }
//! cone      = { radius = 1, top_radius = 0, height = 2, capped = true }
//! torus     = { major = 1, minor = 0.25 }                # around the y axis
//! triangle  = { a = [0, 0, 0], b = [1, 0, 0], c = [0, 1, 0] }
//! mesh      = "bunny"                                    # the name of a [[mesh]]
//! ```

use super::choice::{Choice, choice};
use super::number::{NonNegative, Positive};
use super::value::{Point, vector};
use crate::document::{Fault, Placed};
use glam::{DVec3, Vec2, Vec3};
use heliostat_geometry::Shape;
use heliostat_geometry::shape::{Cone, Cuboid, Cylinder, Disk, Plane, Rectangle, Sphere, Torus, Triangle};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A sphere around the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SphereTable {
    /// Radius in metres.
    pub radius: Positive,
}

/// A box around the origin, its sides along the axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CuboidTable {
    /// Lengths of the sides along x, y and z in metres.
    pub size: [Positive; 3],
}

/// The infinite plane y = 0; texture coordinates are metres.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneTable {}

/// A rectangle around the origin in the plane y = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleTable {
    /// Lengths of the sides along x and z in metres.
    pub size: [Positive; 2],
}

/// A disk around the origin in the plane y = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiskTable {
    /// Radius in metres.
    pub radius: Positive,
    /// Radius of the hole in metres, smaller than `radius`; 0 if left out.
    pub inner_radius: Option<Placed<NonNegative>>,
}

/// A cylinder around the y axis that stands on y = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CylinderTable {
    /// Radius in metres.
    pub radius: Positive,
    /// Height in metres.
    pub height: Positive,
    /// Whether both ends are closed.
    #[serde(default = "yes")]
    pub capped: bool,
}

/// A cone or a frustum around the y axis that stands on y = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConeTable {
    /// Radius at y = 0 in metres.
    pub radius: Positive,
    /// Radius at the top in metres; 0, a point, if left out.
    pub top_radius: Option<NonNegative>,
    /// Height in metres.
    pub height: Positive,
    /// Whether the ends are closed.
    #[serde(default = "yes")]
    pub capped: bool,
}

/// A ring around the y axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorusTable {
    /// Distance of the middle of the tube from the axis in metres.
    pub major: Positive,
    /// Radius of the tube in metres.
    pub minor: Positive,
}

/// One triangle, seen from the side where its corners run counter-clockwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TriangleTable {
    /// First corner.
    pub a: Point,
    /// Second corner.
    pub b: Point,
    /// Third corner.
    pub c: Point,
}

fn yes() -> bool {
    true
}

/// Borrows the keys of which a table has exactly one.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShapeKeys<'a> {
    pub(super) sphere: Option<&'a Placed<SphereTable>>,
    pub(super) cuboid: Option<&'a Placed<CuboidTable>>,
    pub(super) plane: Option<&'a Placed<PlaneTable>>,
    pub(super) rectangle: Option<&'a Placed<RectangleTable>>,
    pub(super) disk: Option<&'a Placed<DiskTable>>,
    pub(super) cylinder: Option<&'a Placed<CylinderTable>>,
    pub(super) cone: Option<&'a Placed<ConeTable>>,
    pub(super) torus: Option<&'a Placed<TorusTable>>,
    pub(super) triangle: Option<&'a Placed<TriangleTable>>,
    pub(super) mesh: Option<&'a Placed<String>>,
}

impl ShapeKeys<'_> {
    /// The keys as a choice.
    pub(super) fn choices(&self) -> [Choice; 10] {
        [
            choice("sphere", self.sphere),
            choice("cuboid", self.cuboid),
            choice("plane", self.plane),
            choice("rectangle", self.rectangle),
            choice("disk", self.disk),
            choice("cylinder", self.cylinder),
            choice("cone", self.cone),
            choice("torus", self.torus),
            choice("triangle", self.triangle),
            choice("mesh", self.mesh),
        ]
    }

    /// The first analytic shape that is there; `None` leaves the mesh.
    ///
    /// # Errors
    /// Where the measures of a shape contradict each other.
    pub(super) fn shape(&self) -> Result<Option<Shape>, Fault> {
        let shape = if let Some(t) = self.sphere {
            Shape::Sphere(Sphere { radius: t.radius.f32() })
        } else if let Some(t) = self.cuboid {
            Shape::Cuboid(Cuboid { size: Vec3::from_array(t.size.map(Positive::f32)) })
        } else if self.plane.is_some() {
            Shape::Plane(Plane)
        } else if let Some(t) = self.rectangle {
            Shape::Rectangle(Rectangle { size: Vec2::from_array(t.size.map(Positive::f32)) })
        } else if let Some(t) = self.disk {
            disk(t)?
        } else if let Some(t) = self.cylinder {
            Shape::Cylinder(Cylinder { radius: t.radius.f32(), height: t.height.f32(), capped: t.capped })
        } else if let Some(t) = self.cone {
            Shape::Cone(Cone {
                radius: t.radius.f32(),
                top_radius: t.top_radius.unwrap_or(NonNegative::ZERO).f32(),
                height: t.height.f32(),
                capped: t.capped,
            })
        } else if let Some(t) = self.torus {
            Shape::Torus(Torus { major: t.major.f32(), minor: t.minor.f32() })
        } else if let Some(t) = self.triangle {
            triangle(t)?
        } else {
            return Ok(None);
        };
        Ok(Some(shape))
    }
}

fn disk(table: &DiskTable) -> Result<Shape, Fault> {
    let (radius, inner) = (table.radius.f32(), table.inner_radius.as_ref());
    let inner_radius = inner.map_or(0.0, |inner| inner.f32());
    if inner_radius >= radius {
        return Err(Fault::new("`inner_radius` must be smaller than `radius`")
            .with_help(format!("choose a number below {radius}"))
            .or_at(inner.and_then(Placed::span)));
    }
    Ok(Shape::Disk(Disk { radius, inner_radius }))
}

fn triangle(table: &Placed<TriangleTable>) -> Result<Shape, Fault> {
    let [a, b, c] = [&table.a, &table.b, &table.c].map(vector);
    if (b - a).cross(c - a) == DVec3::ZERO {
        return Err(Fault::new("the corners of the triangle lie on a line")
            .with_help("move one of them off the line through the others")
            .or_at(table.span()));
    }
    Ok(Shape::Triangle(Triangle { a: a.as_vec3(), b: b.as_vec3(), c: c.as_vec3() }))
}

/// Implements `shape_keys` for a table that has the ten keys.
macro_rules! impl_shape_keys {
    ($table:ty) => {
        impl $table {
            /// The keys of which exactly one says what this is made of.
            pub(super) fn shape_keys(&self) -> $crate::scene_file::shape::ShapeKeys<'_> {
                $crate::scene_file::shape::ShapeKeys {
                    sphere: self.sphere.as_ref(),
                    cuboid: self.cuboid.as_ref(),
                    plane: self.plane.as_ref(),
                    rectangle: self.rectangle.as_ref(),
                    disk: self.disk.as_ref(),
                    cylinder: self.cylinder.as_ref(),
                    cone: self.cone.as_ref(),
                    torus: self.torus.as_ref(),
                    triangle: self.triangle.as_ref(),
                    mesh: self.mesh.as_ref(),
                }
            }
        }
    };
}
pub(super) use impl_shape_keys;
