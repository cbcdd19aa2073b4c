//! Movement over the shutter: as few poses as keep a thing on its way.

use super::animation::Tracks;
use super::document::Document;
use super::flaw::Flaw;
use super::nodes::Nodes;
use glam::{DAffine3, DMat3, DVec3};
use heliostat_geometry::{Aabb, Transform};
use heliostat_scene::Motion;

/// Poses that are looked at, less one; a power of two.
const SEGMENTS: usize = 32;
/// So many times smaller than the thing is what it may be off its way.
const FINE: f64 = 2000.0;

/// The places of all nodes at a moment and over the shutter.
#[derive(Debug)]
pub(super) struct Stage {
    /// In the middle of the shutter.
    pub(super) places: Vec<DAffine3>,
    /// At even steps over the shutter; empty when nothing moves.
    steps: Vec<Vec<DAffine3>>,
}

impl Stage {
    /// The places around `seconds` while the shutter is open for `shutter` seconds.
    ///
    /// # Errors
    /// When a node stands beyond all numbers.
    pub(super) fn of(
        document: &Document,
        nodes: &Nodes,
        tracks: &Tracks,
        seconds: f64,
        shutter: f64,
    ) -> Result<Self, Flaw> {
        let at = |share: f64| {
            let places = nodes.places(document, tracks, seconds + (share - 0.5) * shutter);
            match places.iter().position(|place| !place.is_finite()) {
                None => Ok(places),
                Some(node) => {
                    let flaw = Flaw::new(format!("nodes[{node}]"), "stands at no finite place");
                    Err(flaw.with_help("export the file again"))
                }
            }
        };
        let moves = shutter > 0.0 && tracks.last_key().is_some();
        let steps = if moves { 0..SEGMENTS + 1 } else { 0..0 };
        let steps = steps.map(|i| at(i as f64 / SEGMENTS as f64)).collect::<Result<_, _>>()?;
        Ok(Self { places: at(0.5)?, steps })
    }

    /// The poses of a node that holds something in a box, each of them changed by `pose`; one where it stands still.
    pub(super) fn poses(
        &self,
        node: usize,
        bounds: Aabb,
        pose: impl Fn(&DAffine3) -> DAffine3,
    ) -> Vec<DAffine3> {
        let poses: Vec<_> = self.steps.iter().map(|places| pose(&places[node])).collect();
        match poses.first() {
            Some(first) if poses.iter().any(|pose| pose != first) => thinned(&poses, bounds),
            _ => vec![pose(&self.places[node])],
        }
    }

    /// The motion of a thing in a box at a node; `None` where it is flat, and so is not seen.
    pub(super) fn motion(&self, node: usize, bounds: Aabb) -> Option<Motion<Transform>> {
        let poses = self.poses(node, bounds, |pose| *pose);
        Motion::through(poses.iter().map(|pose| Transform::new(*pose)).collect::<Option<Vec<_>>>()?)
    }
}

/// Every so many-th pose, such that lines between them pass near the others.
fn thinned(poses: &[DAffine3], bounds: Aabb) -> Vec<DAffine3> {
    let bounds =
        if bounds.is_empty() { Aabb { min: glam::Vec3::NEG_ONE, max: glam::Vec3::ONE } } else { bounds };
    let corners = bounds.corners().map(|corner| corner.as_dvec3());
    let off = |pose: &DAffine3, other: &DAffine3| {
        let distance = |p: &DVec3| pose.transform_point3(*p).distance(other.transform_point3(*p));
        corners.iter().map(distance).fold(0.0, f64::max)
    };
    let size = poses[0].transform_vector3(bounds.size().as_dvec3()).length();
    let passes = |stride: usize| {
        (0..poses.len()).filter(|i| i % stride != 0).all(|i| {
            let before = i - i % stride;
            let share = (i % stride) as f64 / stride as f64;
            off(&between(&poses[before], &poses[before + stride], share), &poses[i]) <= size / FINE
        })
    };
    let mut stride = poses.len() - 1;
    while stride > 1 && !passes(stride) {
        stride /= 2;
    }
    poses.iter().step_by(stride).copied().collect()
}

/// Matrices between two poses, as the renderer takes them.
fn between(a: &DAffine3, b: &DAffine3, share: f64) -> DAffine3 {
    let mix = |a: DVec3, b: DVec3| a.lerp(b, share);
    let (ma, mb) = (a.matrix3, b.matrix3);
    DAffine3 {
        matrix3: DMat3::from_cols(
            mix(ma.x_axis, mb.x_axis),
            mix(ma.y_axis, mb.y_axis),
            mix(ma.z_axis, mb.z_axis),
        ),
        translation: mix(a.translation, b.translation),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, Vec3};

    fn poses(pose: impl Fn(f64) -> DAffine3) -> Vec<DAffine3> {
        (0..=SEGMENTS).map(|i| pose(i as f64 / SEGMENTS as f64)).collect()
    }

    #[test]
    fn a_straight_way_takes_two_poses_and_a_turn_as_many_as_it_needs() {
        let unit = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
        let straight = poses(|t| DAffine3::from_translation(DVec3::X * t));
        assert_eq!(thinned(&straight, unit).len(), 2);
        let turning = |turn: f64| poses(move |t| DAffine3::from_quat(DQuat::from_rotation_z(turn * t)));
        assert_eq!(thinned(&turning(0.1), unit).len(), 3);
        assert_eq!(thinned(&turning(6.0), unit).len(), SEGMENTS + 1);
    }
}
