//! The trees of a scene: one per mesh, over its triangles, and one over the boxes of the objects.

use crate::args::value::Tree;
use crate::diagnose::Failure;
use crate::exit::Exit;
use heliostat_geometry::Aabb;
use heliostat_index::{BspTree, BuildError, BuildParams, MeshTree, TreeStats};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Object, Scene};

/// One tree, with what it is over.
#[derive(Debug)]
pub(super) struct SceneTree {
    pub(super) which: Tree,
    /// `objects`, or `mesh 0` and the first object that shows it.
    pub(super) name: String,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Objects(BspTree),
    Mesh(MeshTree),
}

impl SceneTree {
    /// The tree.
    pub(super) fn tree(&self) -> &BspTree {
        match &self.kind {
            Kind::Objects(tree) => tree,
            Kind::Mesh(tree) => tree.tree(),
        }
    }

    /// Its figures.
    pub(super) fn stats(&self) -> TreeStats {
        match &self.kind {
            Kind::Objects(tree) => tree.stats(),
            Kind::Mesh(tree) => tree.stats(),
        }
    }
}

/// Builds all trees of a scene.
pub(super) fn build(scene: &Scene, params: &BuildParams) -> Result<Vec<SceneTree>, Failure> {
    let mut trees = Vec::new();
    for (number, mesh) in scene.meshes.iter().enumerate() {
        let name = mesh_name(scene, number);
        let tree = MeshTree::build(mesh, params).map_err(|e| failure(&name, &e))?;
        trees.push(SceneTree { which: Tree::Mesh(number), name, kind: Kind::Mesh(tree) });
    }
    let boxes: Vec<Aabb> = scene.objects.iter().map(|o| bounds(scene, o)).filter(|b| !b.is_empty()).collect();
    let tree = BspTree::build(&boxes, params).map_err(|e| failure("objects", &e))?;
    trees.push(SceneTree { which: Tree::Objects, name: "objects".into(), kind: Kind::Objects(tree) });
    Ok(trees)
}

/// `mesh 0`, and the name of the first object that shows it.
pub(super) fn mesh_name(scene: &Scene, number: usize) -> String {
    let shows = |object: &&Object| matches!(object.geometry, Geometry::Mesh(id) if id.index() == number);
    match scene.objects.iter().find(shows) {
        Some(object) => format!("mesh {number} ({})", object.name),
        None => format!("mesh {number}"),
    }
}

/// The box of an object over the shutter: between two poses every point moves on a straight line.
fn bounds(scene: &Scene, object: &Object) -> Aabb {
    let local = match &object.geometry {
        Geometry::Shape(shape) => shape.geometry().bounds(),
        Geometry::Mesh(id) => scene.meshes[id.index()].bounds(),
    };
    object.motion.poses().iter().fold(Aabb::EMPTY, |all, pose| all.union(pose.bounds(local)))
}

/// A mesh that no tree can be built over came out of a file.
pub(super) fn failure(name: &str, error: &BuildError) -> Failure {
    Failure::new(Exit::Input, format!("{name}: {error}"))
}
