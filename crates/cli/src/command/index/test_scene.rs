//! What tests of verification and replay share.

use heliostat_geometry::{Ray, TriMesh};
use heliostat_index::verify::Disagreement;
use heliostat_scene::Scene;
use std::sync::Arc;

/// One triangle in the plane z = 0.
pub(super) fn scene() -> Scene {
    let positions = vec![[0.0, 0.0, 0.0].into(), [1.0, 0.0, 0.0].into(), [0.0, 1.0, 0.0].into()];
    let mesh = TriMesh { positions, triangles: vec![[0, 1, 2]], ..TriMesh::default() };
    Scene { meshes: vec![Arc::new(mesh)], ..Scene::default() }
}

/// An index that contradicts itself on this ray.
pub(super) fn disagreement(ray: Ray) -> Disagreement {
    Disagreement { number: 7, ray, index: "best".into(), expected: None, got: None, got_any: true }
}
