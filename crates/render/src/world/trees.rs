//! One tree per mesh, kept as long as the mesh is in use.

use super::WorldError;
use heliostat_geometry::TriMesh;
use heliostat_index::{BuildParams, MeshTree};
use heliostat_scene::Scene;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};
use std::sync::Arc;

/// Trees of meshes, to be reused while the same meshes come back: the frames of an animation.
///
/// A mesh is the same when it is the same `Arc`, which the cache holds on to, so that an address is not given twice.
#[derive(Debug, Default)]
pub struct TreeCache {
    entries: Vec<(Arc<TriMesh>, Arc<MeshTree>)>,
}

impl TreeCache {
    /// A tree for each mesh of the scene, in their order. Trees of other meshes are dropped.
    pub(super) fn trees(&mut self, scene: &Scene) -> Result<Vec<Arc<MeshTree>>, WorldError> {
        let mut missing: Vec<&Arc<TriMesh>> = Vec::new();
        for mesh in &scene.meshes {
            if self.find(mesh).is_none() && !missing.iter().any(|other| Arc::ptr_eq(other, mesh)) {
                missing.push(mesh);
            }
        }
        let built: Result<Vec<_>, _> = missing.par_iter().map(|mesh| build(scene, mesh)).collect();
        self.entries.extend(missing.into_iter().cloned().zip(built?));
        self.entries.retain(|(kept, _)| scene.meshes.iter().any(|mesh| Arc::ptr_eq(kept, mesh)));
        Ok(scene.meshes.iter().filter_map(|mesh| self.find(mesh)).collect())
    }

    fn find(&self, mesh: &Arc<TriMesh>) -> Option<Arc<MeshTree>> {
        self.entries.iter().find(|(kept, _)| Arc::ptr_eq(kept, mesh)).map(|(_, tree)| Arc::clone(tree))
    }
}

/// Checks a mesh and builds its tree.
fn build(scene: &Scene, mesh: &Arc<TriMesh>) -> Result<Arc<MeshTree>, WorldError> {
    let place = || scene.meshes.iter().position(|other| Arc::ptr_eq(other, mesh)).unwrap_or_default();
    let tree = MeshTree::build(mesh, &BuildParams::BALANCED)
        .map_err(|source| WorldError::MeshTree { mesh: place(), source })?;
    Ok(Arc::new(tree))
}
