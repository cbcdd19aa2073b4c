//! Why a scene could not be made ready for rays.

use crate::error::summary;
use heliostat_index::BuildError;
use heliostat_scene::Scene;
use heliostat_scene::validate::{Problem, SceneIssue};

/// Why a scene could not be made ready for rays.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {
    /// Something in the scene means nothing: all that was found.
    #[error("{}", summary(.0))]
    Scene(Vec<SceneIssue>),
    /// No tree could be built over a mesh.
    #[error("no index could be built over mesh {mesh}")]
    MeshTree {
        /// Index of the mesh.
        mesh: usize,
        /// Why.
        source: BuildError,
    },
    /// No tree could be built over the objects.
    #[error("{what} has no place in space; look at its transform and size")]
    Objects {
        /// What could not be placed.
        what: String,
        /// Why.
        source: BuildError,
    },
}

/// The error of an index over objects, with the name of the object that cannot be placed.
pub(super) fn objects(scene: &Scene, source: BuildError) -> WorldError {
    let bad = match source {
        BuildError::Bounds { primitive, .. } => {
            scene.objects.get(primitive as usize).map(|object| &object.name)
        }
        _ => None,
    };
    let what = bad.map_or_else(|| "the scene".to_owned(), |name| format!("object `{name}`"));
    WorldError::Objects { what, source }
}

/// Refuses a scene that does not validate. Cameras look at a world; it needs none.
pub(super) fn check(scene: &Scene) -> Result<(), WorldError> {
    let mut issues = scene.validate().err().unwrap_or_default();
    issues.retain(|issue| issue.problem != Problem::NoCamera);
    if issues.is_empty() { Ok(()) } else { Err(WorldError::Scene(issues)) }
}
