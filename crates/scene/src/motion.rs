//! Things that move while the shutter is open.

use heliostat_geometry::{Aabb, Transform};

/// Evenly spaced poses over the shutter, the first at its opening and the last at its closing.
///
/// Between two poses the *matrices* are interpolated linearly, so that every point moves on a straight line and the
/// union of the boxes at the poses bounds the motion. Turning things get as many poses as their path needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion<T = Transform> {
    /// At least one pose; one pose means that nothing moves.
    poses: Vec<T>,
}

impl<T> Motion<T> {
    /// No movement.
    pub fn still(pose: T) -> Self {
        Self { poses: vec![pose] }
    }

    /// Movement through `poses`; `None` when there are none.
    pub fn through(poses: Vec<T>) -> Option<Self> {
        (!poses.is_empty()).then_some(Self { poses })
    }

    /// The poses.
    pub fn poses(&self) -> &[T] {
        &self.poses
    }

    /// The pose at the opening of the shutter.
    pub fn first(&self) -> &T {
        &self.poses[0]
    }

    /// Whether there is more than one pose.
    pub fn is_moving(&self) -> bool {
        self.poses.len() > 1
    }

    /// The two poses around `time` in `[0, 1]` over the shutter, and the weight of the second.
    pub fn around(&self, time: f32) -> (&T, &T, f32) {
        let segments = self.poses.len() - 1;
        let position = time.clamp(0.0, 1.0) * segments as f32;
        let first = (position as usize).min(segments.saturating_sub(1));
        let second = (first + 1).min(segments);
        (&self.poses[first], &self.poses[second], position - first as f32)
    }
}

impl Motion<Transform> {
    /// The box, over the whole shutter, of what has the box `local` before it is moved.
    ///
    /// Points move on straight lines between two poses, so the boxes at the poses bound all that lies between. It holds as
    /// well for what moves inside `local` meanwhile.
    pub fn bounds(&self, local: Aabb) -> Aabb {
        self.poses.iter().fold(Aabb::EMPTY, |around, pose| around.union(pose.bounds(local)))
    }
}
