//! Lights taken together: where they are, where they shine, and how much. What points expect of them is in [`super::beams`].
//!
//! # Source
//! Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018; in the form of Pharr,
//! Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 12.6.3.

use glam::Vec3;
use heliostat_geometry::error_bound::gamma_f64;
use heliostat_geometry::{Aabb, Transform};
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// One light, or several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cluster {
    /// Around all points that light comes from.
    pub(super) bounds: Aabb,
    /// Sum of the radiant intensities in the brightest direction of each, in W/sr.
    pub(super) intensity: f32,
    /// Around all normals.
    pub(super) normals: Cone,
    /// How far from a normal light is sent, in radians.
    pub(super) spread: f32,
    /// Whether light leaves against the normals too.
    pub(super) two_sided: bool,
}

/// Directions around an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cone {
    /// Unit vector.
    pub(super) axis: Vec3,
    /// Half angle in radians, up to pi.
    pub(super) angle: f32,
}

impl Cone {
    /// All directions.
    pub(super) const ALL: Self = Self { axis: Vec3::Z, angle: PI };

    /// The cone of the normals of a surface that is placed in the world; all directions where the map bends it.
    pub(super) fn placed(self, place: &Transform) -> Self {
        let linear = place.matrix().matrix3;
        let scale = linear.determinant().abs().cbrt();
        let round = gamma_f64(64) * scale;
        let keeps_angles = [linear.x_axis, linear.y_axis, linear.z_axis];
        let is_similar = keeps_angles.iter().all(|axis| (axis.length() - scale).abs() <= round);
        if self.angle > 0.0 && !is_similar {
            return Self::ALL;
        }
        Self { axis: place.normal(self.axis), ..self }
    }

    /// A cone around both.
    pub(super) fn union(self, other: Self) -> Self {
        let (wide, narrow) = if self.angle >= other.angle { (self, other) } else { (other, self) };
        let between = angle(wide.axis, narrow.axis);
        if (between + narrow.angle).min(PI) <= wide.angle {
            return wide;
        }
        let half = 0.5 * (wide.angle + between + narrow.angle);
        let across = (narrow.axis - narrow.axis.dot(wide.axis) * wide.axis).try_normalize();
        match across {
            Some(across) if half < PI => {
                let (sin, cos) = (half - wide.angle).sin_cos();
                Self { axis: cos * wide.axis + sin * across, angle: half }
            }
            _ => Self { angle: PI, ..wide },
        }
    }
}

impl Cluster {
    /// Everything that is sent, in W, about.
    pub(super) fn power(&self) -> f32 {
        let sides: f32 = if self.two_sided { 2.0 } else { 1.0 };
        sides.min(4.0 * PI / self.solid_angle()) * self.intensity * self.solid_angle()
    }

    /// Both together.
    pub(super) fn union(self, other: Self) -> Self {
        Self {
            bounds: self.bounds.union(other.bounds),
            intensity: self.intensity + other.intensity,
            normals: self.normals.union(other.normals),
            spread: self.spread.max(other.spread),
            two_sided: self.two_sided || other.two_sided,
        }
    }

    /// What it costs to have these in one node: intensity times the solid angle into which it shines.
    pub(super) fn cost(&self) -> f32 {
        self.intensity * self.solid_angle()
    }

    /// The solid angle into which one side shines, weighed by the cosine from the normals.
    fn solid_angle(&self) -> f32 {
        let inner = self.normals.angle;
        let outer = (inner + self.spread).min(PI);
        // The cap of the normals in full, and around it the cosine from there.
        let around =
            2.0 * outer * inner.sin() - (inner - 2.0 * outer).cos() - 2.0 * inner * inner.sin() + inner.cos();
        TAU * (1.0 - inner.cos()) + FRAC_PI_2 * around
    }
}

/// The angle between unit vectors.
fn angle(a: Vec3, b: Vec3) -> f32 {
    a.dot(b).clamp(-1.0, 1.0).acos()
}
