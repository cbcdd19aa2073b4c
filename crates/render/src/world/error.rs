//! Why a scene could not be made ready for rays.

use heliostat_index::BuildError;
use heliostat_scene::Scene;

/// Why a scene could not be made ready for rays.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {
    /// Something refers to something that the scene does not have.
    #[error("{user} refers to {what} {index}, but the scene has only {count}")]
    Dangling {
        /// What refers to it, with its name.
        user: String,
        /// What kind of thing is missing.
        what: &'static str,
        /// Its index.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// An object has no material.
    #[error("object `{object}` has no material; give it one")]
    NoMaterial {
        /// Name of the object.
        object: String,
    },
    /// An image has not as many samples as its size says.
    #[error("the image of {user} is {width} by {height} pixels, but does not hold as many samples")]
    Image {
        /// What shows it, with its name.
        user: String,
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A mesh is damaged, or no tree could be built over it.
    #[error("mesh {mesh} cannot be used")]
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
