//! Objects: a geometry with materials at a place.

use crate::ids::{MaterialId, MeshId};
use crate::motion::Motion;
use heliostat_geometry::{Shape, Transform};

/// What an object is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// An analytic shape.
    Shape(Shape),
    /// A mesh that objects may share.
    Mesh(MeshId),
}

/// A geometry with materials at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Name, unique in a scene; becomes the Cryptomatte name.
    pub name: String,
    /// The geometry, in local space.
    pub geometry: Geometry,
    /// One material per slot of the mesh; a shape has slot 0. The last one serves slots beyond the end.
    pub materials: Vec<MaterialId>,
    /// From local to world space over the shutter.
    pub motion: Motion<Transform>,
    /// Whether camera rays see it.
    pub visible: bool,
    /// Whether it throws shadows.
    pub casts_shadow: bool,
}

impl Object {
    /// The material of a slot.
    ///
    /// # Panics
    /// When the object has no material; [`crate::Scene::validate`] refuses such objects.
    pub fn material(&self, slot: u16) -> MaterialId {
        self.materials[usize::from(slot).min(self.materials.len() - 1)]
    }
}
