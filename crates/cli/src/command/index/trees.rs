//! The trees of a scene: one per mesh, over its triangles, one or two per group, over the boxes of its objects and those of its
//! copies, and one over the boxes of the objects.

use crate::args::value::Tree;
use crate::diagnose::Failure;
use crate::exit::Exit;
use heliostat_geometry::Aabb;
use heliostat_index::{BspTree, BuildError, BuildParams, MeshTree, TreeStats};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Census, GroupBoxes, Object, Scene};

/// One tree, with what it is over.
#[derive(Debug)]
pub(super) struct SceneTree {
    pub(super) which: Tree,
    /// `objects`, `group 0` or `copies 0` and the name of the group, or `mesh 0` and the first object that shows it.
    pub(super) name: String,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Boxes(BspTree),
    Mesh(MeshTree),
}

impl SceneTree {
    /// The tree.
    pub(super) fn tree(&self) -> &BspTree {
        match &self.kind {
            Kind::Boxes(tree) => tree,
            Kind::Mesh(tree) => tree.tree(),
        }
    }

    /// Its figures.
    pub(super) fn stats(&self) -> TreeStats {
        match &self.kind {
            Kind::Boxes(tree) => tree.stats(),
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
    let census = Census::new(scene).map_err(|e| Failure::new(Exit::Input, e.to_string()))?;
    let boxes = GroupBoxes::new(scene, &census);
    for (number, group) in scene.groups.iter().enumerate() {
        let inside = (Tree::Group(number), "group", boxes.objects(scene, group));
        let copies = (Tree::Copies(number), "copies", boxes.places(scene, group));
        for (which, what, boxes) in [inside, copies].into_iter().filter(|(_, _, boxes)| boxes.len() > 1) {
            trees.push(over_boxes(which, format!("{what} {number} ({})", group.name), boxes, params)?);
        }
    }
    let objects = scene.objects.iter().map(|object| boxes.object(scene, object)).collect();
    trees.push(over_boxes(Tree::Objects, "objects".to_owned(), objects, params)?);
    Ok(trees)
}

fn over_boxes(
    which: Tree,
    name: String,
    mut boxes: Vec<Aabb>,
    params: &BuildParams,
) -> Result<SceneTree, Failure> {
    boxes.retain(|bounds| !bounds.is_empty());
    let tree = BspTree::build(&boxes, params).map_err(|e| failure(&name, &e))?;
    Ok(SceneTree { which, name, kind: Kind::Boxes(tree) })
}

/// `mesh 0`, and the name of the first object that shows it.
pub(super) fn mesh_name(scene: &Scene, number: usize) -> String {
    let shows = |object: &&Object| matches!(object.geometry, Geometry::Mesh(id) if id.index() == number);
    let members = scene.groups.iter().flat_map(|group| &group.objects);
    match scene.objects.iter().chain(members).find(shows) {
        Some(object) => format!("mesh {number} ({})", object.name),
        None => format!("mesh {number}"),
    }
}

/// A mesh that no tree can be built over came out of a file.
pub(super) fn failure(name: &str, error: &BuildError) -> Failure {
    Failure::new(Exit::Input, format!("{name}: {error}"))
}
