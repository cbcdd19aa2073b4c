//! Objects: a geometry with materials at a place.

use crate::ids::{GroupId, MaterialId, MeshId};
use crate::motion::Motion;
use heliostat_geometry::{Shape, Transform};

/// What an object is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// An analytic shape.
    Shape(Shape),
    /// A mesh that objects may share.
    Mesh(MeshId),
    /// Objects in a space of their own, which objects may share.
    Group(GroupId),
}

/// A geometry with materials at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Name, unique in a scene; becomes the Cryptomatte name.
    pub name: String,
    /// The geometry, in local space.
    pub geometry: Geometry,
    /// One material per slot of the mesh; a shape has slot 0. The last one serves slots beyond the end. None for a group,
    /// whose objects have their own.
    pub materials: Vec<MaterialId>,
    /// Over the shutter, from local space to world space, or to that of the group that holds the object.
    pub motion: Motion<Transform>,
    /// Whether camera rays see it. What a group holds is seen where both it and the group are.
    pub visible: bool,
    /// Whether it throws shadows; in a group, where the group does too. What does not is not there for shadow rays, and for paths
    /// neither for scattered ones: only the camera, mirrors and clear glass see it, and it takes no light from its surroundings.
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
