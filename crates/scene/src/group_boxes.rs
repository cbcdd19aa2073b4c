//! The boxes around groups, over the shutter.

use crate::census::Census;
use crate::group::Group;
use crate::object::{Geometry, Object};
use crate::scene::Scene;
use heliostat_geometry::{Aabb, Transform};

/// A box around each group of a scene, in the space of the group, that holds all of it at every moment of the shutter.
///
/// What moves inside something that moves is bounded twice: the box of its whole way is what moves on the outside. So the
/// box holds although the product of two matrices that are interpolated linearly is not linear itself.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupBoxes {
    bounds: Vec<Aabb>,
}

impl GroupBoxes {
    /// The boxes of all groups of the scene that was counted.
    ///
    /// # Panics
    /// When the census is that of another scene.
    pub fn new(scene: &Scene, census: &Census) -> Self {
        let mut boxes = Self { bounds: vec![Aabb::EMPTY; scene.groups.len()] };
        for id in census.order() {
            let group = &scene.groups[id.index()];
            boxes.bounds[id.index()] = union(boxes.places(scene, group));
        }
        boxes
    }

    /// The box of a geometry in its own space; unbounded for the infinite plane, empty where there is nothing.
    ///
    /// # Panics
    /// When the scene has no such mesh or group.
    pub fn geometry(&self, scene: &Scene, geometry: &Geometry) -> Aabb {
        match geometry {
            Geometry::Shape(shape) => shape.geometry().bounds(),
            Geometry::Mesh(id) => scene.meshes[id.index()].bounds(),
            Geometry::Group(id) => self.bounds[id.index()],
        }
    }

    /// The box of an object over the shutter: in world space, or in that of the group that holds it.
    ///
    /// # Panics
    /// As [`GroupBoxes::geometry`].
    pub fn object(&self, scene: &Scene, object: &Object) -> Aabb {
        object.motion.bounds(self.geometry(scene, &object.geometry))
    }

    /// The box of each object of a group, in the space of its objects.
    ///
    /// # Panics
    /// As [`GroupBoxes::geometry`].
    pub fn objects(&self, scene: &Scene, group: &Group) -> Vec<Aabb> {
        group.objects.iter().map(|object| self.object(scene, object)).collect()
    }

    /// The box of each copy of a group, in the space of the group; empty where the place has no inverse.
    ///
    /// # Panics
    /// As [`GroupBoxes::geometry`].
    pub fn places(&self, scene: &Scene, group: &Group) -> Vec<Aabb> {
        let inside = union(self.objects(scene, group));
        let at = |place| Transform::new(place).map_or(Aabb::EMPTY, |place| place.bounds(inside));
        group.places.iter().map(|&place| at(place)).collect()
    }
}

fn union(boxes: Vec<Aabb>) -> Aabb {
    boxes.into_iter().fold(Aabb::EMPTY, Aabb::union)
}
