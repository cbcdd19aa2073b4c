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
    /// Worked out for this moment.
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
            Self::Moving(motion) => between(motion, time).map(Now::Moving),
        }
    }

    /// [`Place::now`], in `room` only if it moves: a transform at rest is not moved about.
    #[inline]
    pub(super) fn at<'a>(&'a self, time: f32, room: &'a mut Option<Transform>) -> Option<&'a Transform> {
        match self {
            Self::Still(transform) => Some(transform),
            Self::Moving(motion) => Some(room.insert(between(motion, time)?)),
        }
    }

    /// Shows the map of a moment to world space to a closure, where this is a place in a space that `outer` maps there; `None` as
    /// in [`Place::now`].
    #[inline]
    pub(super) fn below<T>(
        &self,
        outer: &Transform,
        time: f32,
        look: impl FnOnce(&Transform) -> Option<T>,
    ) -> Option<T> {
        match self {
            Self::Still(inner) if inner.is_identity() => look(outer),
            _ if outer.is_identity() => look(self.at(time, &mut None)?),
            Self::Still(inner) => look(&inner.then(outer)?),
            Self::Moving(motion) => look(&between(motion, time)?.then(outer)?),
        }
    }

    /// The box in world space of what has the box `local`, over the whole shutter.
    pub(crate) fn bounds(&self, local: Aabb) -> Aabb {
        match self {
            Self::Still(transform) => transform.bounds(local),
            Self::Moving(motion) => motion.bounds(local),
        }
    }
}

/// The transform of a moment; `None` where it has no inverse.
#[inline(never)]
fn between(motion: &Motion, time: f32) -> Option<Transform> {
    let (before, after, weight) = motion.around(time);
    before.lerp(after, weight)
}
