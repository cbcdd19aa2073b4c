//! Where a geometry stands over the shutter.

use heliostat_geometry::{Aabb, Transform};
use heliostat_scene::Motion;
use std::ops::Deref;

/// Where something is over the shutter.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Place<'s> {
    /// It does not move.
    Still(&'s Transform),
    /// It moves: the matrix of a moment is worked out for each ray.
    Moving(&'s Motion),
}

/// The transform of a moment.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Now<'s> {
    /// The same at all times.
    Still(&'s Transform),
    /// Interpolated.
    Moving(Transform),
}

impl Deref for Now<'_> {
    type Target = Transform;

    #[inline]
    fn deref(&self) -> &Transform {
        match self {
            Self::Still(transform) => transform,
            Self::Moving(transform) => transform,
        }
    }
}

impl<'s> Place<'s> {
    /// The place of something that moves so.
    pub(crate) fn of(motion: &'s Motion) -> Self {
        if motion.is_moving() { Self::Moving(motion) } else { Self::Still(motion.first()) }
    }

    /// The transform of a moment; `None` where the interpolated matrix has no inverse and nothing is seen.
    #[inline]
    pub(crate) fn now(&self, time: f32) -> Option<Now<'s>> {
        match self {
            Self::Still(transform) => Some(Now::Still(transform)),
            Self::Moving(motion) => {
                let (before, after, weight) = motion.around(time);
                before.lerp(after, weight).map(Now::Moving)
            }
        }
    }

    /// The box in world space of what has the box `local`, over the whole shutter.
    ///
    /// Points move on straight lines between two poses, so the boxes at the poses bound all that lies between.
    pub(crate) fn bounds(&self, local: Aabb) -> Aabb {
        match self {
            Self::Still(transform) => transform.bounds(local),
            Self::Moving(motion) => {
                motion.poses().iter().fold(Aabb::EMPTY, |around, pose| around.union(pose.bounds(local)))
            }
        }
    }
}
