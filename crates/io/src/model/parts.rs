//! What stands in the scene of a model, one mesh at a time, wherever it stands.

use super::doubled_areas;
use glam::{DAffine3, DVec3, Vec3};
use heliostat_geometry::{Aabb, TriMesh};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Group, Material, Object, Scene};

/// A mesh as an object shows it.
pub(super) struct Part<'s> {
    pub(super) mesh: &'s TriMesh,
    pub(super) object: &'s Object,
    /// From the space of the mesh to the world, where the shutter opens.
    pub(super) place: DAffine3,
    /// Whether it is one of the copies of a group.
    pub(super) is_copy: bool,
}

/// Shows every mesh of a scene, those of groups once for each copy.
pub(super) fn each_part<'s>(scene: &'s Scene, visit: &mut dyn FnMut(&Part<'s>)) {
    each_of(scene, &scene.objects, DAffine3::IDENTITY, 0, visit);
}

fn each_of<'s>(
    scene: &'s Scene,
    objects: &'s [Object],
    outer: DAffine3,
    depth: u32,
    visit: &mut dyn FnMut(&Part<'s>),
) {
    for object in objects {
        let place = outer * object.motion.first().matrix();
        match &object.geometry {
            Geometry::Shape(_) => {}
            Geometry::Mesh(id) => {
                if let Some(mesh) = scene.meshes.get(id.index()) {
                    visit(&Part { mesh, object, place, is_copy: depth > 0 });
                }
            }
            Geometry::Group(id) => {
                let group = scene.groups.get(id.index()).filter(|_| depth < Group::MAX_DEPTH);
                for group in group.into_iter() {
                    for copy in &group.places {
                        each_of(scene, &group.objects, place * *copy, depth + 1, visit);
                    }
                }
            }
        }
    }
}

impl<'s> Part<'s> {
    /// Corners of each triangle in the world, beside its material and twice its area times its normal.
    pub(super) fn triangles(
        &self,
        scene: &'s Scene,
    ) -> impl Iterator<Item = (&'s Material, [Vec3; 3], DVec3)> {
        let (object, place) = (self.object, self.place);
        let is_still = place == DAffine3::IDENTITY;
        let mesh = self.mesh;
        (0..).zip(doubled_areas(mesh)).map(move |(i, (corners, area))| {
            let material = &scene.materials[object.material(mesh.slot(i)).index()];
            if is_still {
                return (material, corners, area);
            }
            let corners = corners.map(|p| place.transform_point3(p.as_dvec3()));
            let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            (material, corners.map(|p| p.as_vec3()), area)
        })
    }

    /// Points around it in the world: its vertices; of copies, which may be many, the corners of their box.
    pub(super) fn points(&self, visit: &mut dyn FnMut(DVec3)) {
        let mut add = |p: &Vec3| visit(self.place.transform_point3(p.as_dvec3()));
        if self.is_copy {
            self.mesh.bounds().corners().iter().for_each(&mut add);
        } else {
            self.mesh.positions.iter().for_each(&mut add);
        }
    }
}

/// The box around all of a scene.
pub(super) fn bounds_of(scene: &Scene) -> Aabb {
    let mut bounds = Aabb::EMPTY;
    each_part(scene, &mut |part| {
        if part.place == DAffine3::IDENTITY {
            bounds = bounds.union(part.mesh.bounds());
        } else {
            part.points(&mut |p| bounds = bounds.grow(p.as_vec3()));
        }
    });
    bounds
}
