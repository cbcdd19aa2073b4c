//! Why a scene could not be made ready for rays.

use super::group::GroupError;
use crate::error::summary;
use heliostat_index::BuildError;
use heliostat_scene::validate::{ItemKind, Problem, SceneIssue};
use heliostat_scene::{Census, Scene};

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
    /// No tree could be built over the objects, or over those of a group.
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

/// The error of an index of a group, with the name of what cannot be placed.
pub(super) fn group(scene: &Scene, error: GroupError) -> WorldError {
    let GroupError { group, member, source } = error;
    let group = &scene.groups[group.index()];
    let member = member.and_then(|i| group.objects.get(i));
    let what = match member {
        Some(object) => format!("object `{}` of group `{}`", object.name, group.name),
        None => format!("group `{}`", group.name),
    };
    WorldError::Objects { what, source }
}

/// Refuses a scene that does not validate, and counts its groups. Cameras look at a world; it needs none.
pub(super) fn check(scene: &Scene) -> Result<Census, WorldError> {
    let mut issues = scene.validate().err().unwrap_or_default();
    issues.retain(|issue| issue.problem != Problem::NoCamera);
    if !issues.is_empty() {
        return Err(WorldError::Scene(issues));
    }
    // A valid scene can be counted.
    Census::new(scene).map_err(|error| {
        let index = error.group().index();
        let name = scene.groups.get(index).map(|group| group.name.clone()).unwrap_or_default();
        let problem = Problem::Groups(error);
        WorldError::Scene(vec![SceneIssue { kind: ItemKind::Group, index, name, problem }])
    })
}
