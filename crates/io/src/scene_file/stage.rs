//! Where everything stands at one moment: poses of objects, models and cameras, and what `look_at` follows.

use super::targets::Targets;
use super::{Directory, SceneFile};
use crate::document::Fault;
use glam::{DAffine3, DVec3};
use heliostat_geometry::Aabb;

/// What does not move: the names that can be looked at, and the boxes of the things behind them in local space.
#[derive(Clone, Debug)]
pub(super) struct Cast<'a> {
    pub(super) directory: &'a Directory,
    /// One box for each object, then one for each model, then one for each object of the groups.
    pub(super) boxes: Vec<Aabb>,
}

/// Poses at one moment.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stage {
    /// Objects, then models, then the objects of the groups, which stand in the space of their group.
    pub(super) things: Vec<DAffine3>,
    pub(super) cameras: Vec<DAffine3>,
}

impl Cast<'_> {
    /// The poses of `file`, which has the same tables as the one that the cast was made from.
    ///
    /// # Errors
    /// Where a transform has no inverse, or a camera no direction.
    pub(super) fn stage(&self, file: &SceneFile) -> Result<Stage, Fault> {
        let objects = file.object.iter().map(|object| object.placement_keys().affine());
        let models = file.model.iter().map(|model| model.placement_keys().affine());
        let members = file.group.iter().flat_map(|group| &group.object);
        let members = members.map(|object| object.placement_keys().affine());
        let things: Vec<DAffine3> = objects.chain(models).chain(members).collect::<Result<_, _>>()?;
        let targets = self.targets(&things);
        let cameras = file
            .camera
            .tables()
            .into_iter()
            .map(|(camera, _)| camera.pose(&targets))
            .collect::<Result<_, _>>()?;
        Ok(Stage { things, cameras })
    }

    /// What can be looked at when the things stand there.
    pub(super) fn targets(&self, things: &[DAffine3]) -> Targets<'_> {
        let centres = things
            .iter()
            .zip(&self.boxes)
            .map(|(to_world, bounds)| to_world.transform_point3(centre(*bounds)));
        Targets { names: &self.directory.things, centres: centres.collect() }
    }
}

/// The middle of a box, the origin for one without end.
pub(super) fn centre(bounds: Aabb) -> DVec3 {
    if bounds.is_empty() || !bounds.is_finite() { DVec3::ZERO } else { bounds.centre().as_dvec3() }
}
