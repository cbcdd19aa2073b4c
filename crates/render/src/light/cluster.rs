//! Lights taken together: where they are, where they shine, how much, and what a point may expect of them.
//!
//! # Source
//! Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018; in the form of Pharr,
//! Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 12.6.3.

use glam::Vec3;
use heliostat_geometry::Aabb;
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

    /// A cone around both.
    fn union(self, other: Self) -> Self {
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
        let inner = self.normals.angle;
        let outer = (inner + self.spread).min(PI);
        // The cap of the normals in full, and around it the cosine from there.
        let around =
            2.0 * outer * inner.sin() - (inner - 2.0 * outer).cos() - 2.0 * inner * inner.sin() + inner.cos();
        self.intensity * (TAU * (1.0 - inner.cos()) + FRAC_PI_2 * around)
    }

    /// What points ask of it.
    pub(super) fn beam(&self) -> Beam {
        let half = 0.5 * self.bounds.size();
        let (sin, cos) = self.normals.angle.sin_cos();
        Beam {
            centre: self.bounds.centre(),
            radius_squared: half.length_squared(),
            axis: self.normals.axis,
            normals: Angle { sin, cos },
            least_cos: self.spread.cos(),
            intensity: self.intensity,
            two_sided: self.two_sided,
        }
    }
}

/// A cluster as points see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beam {
    centre: Vec3,
    /// Of the ball around the box.
    radius_squared: f32,
    axis: Vec3,
    /// Half angle of the cone of normals.
    normals: Angle,
    /// Cosine of the angle from a normal at which light ends.
    least_cos: f32,
    intensity: f32,
    two_sided: bool,
}

impl Beam {
    /// About the irradiance at `p` on a surface with normal `n`, which is 0 in a medium; 0 only where no light comes from here, at least to either side
    /// of the surface.
    #[inline]
    pub(super) fn importance(&self, p: Vec3, n: Vec3) -> f32 {
        let way = p - self.centre;
        let distance_squared = way.length_squared();
        let nearest = distance_squared.max(self.radius_squared);
        if nearest == 0.0 {
            return 0.0;
        }
        let strength = self.intensity / nearest;
        if distance_squared <= self.radius_squared {
            return strength;
        }
        let way = way / distance_squared.sqrt();
        // The angle under which the ball is seen weakens the say of both cosines.
        let sin2 = self.radius_squared / distance_squared;
        let seen = Angle { sin: sin2.sqrt(), cos: (1.0 - sin2).sqrt() };
        let cos = self.axis.dot(way);
        let off_axis = Angle::of_cos(if self.two_sided { cos.abs() } else { cos });
        let leaving = off_axis.less(self.normals).less(seen);
        if leaving.cos <= self.least_cos {
            return 0.0;
        }
        // A point of a medium has no normal, and takes light from anywhere.
        let facing = if n == Vec3::ZERO { 1.0 } else { n.dot(way).abs() };
        let arriving = Angle::of_cos(facing).less(seen);
        strength * leaving.cos.max(0.0) * arriving.cos.max(0.0)
    }
}

/// An angle in `[0, pi]` by its sine and cosine.
#[derive(Clone, Copy, Debug)]
struct Angle {
    sin: f32,
    cos: f32,
}

impl Angle {
    fn of_cos(cos: f32) -> Self {
        Self { sin: (1.0 - cos * cos).max(0.0).sqrt(), cos }
    }

    /// The difference, at least 0.
    #[inline]
    fn less(self, other: Self) -> Self {
        if self.cos > other.cos {
            return Self { sin: 0.0, cos: 1.0 };
        }
        Self {
            sin: self.sin * other.cos - self.cos * other.sin,
            cos: self.cos * other.cos + self.sin * other.sin,
        }
    }
}

/// The angle between unit vectors.
fn angle(a: Vec3, b: Vec3) -> f32 {
    a.dot(b).clamp(-1.0, 1.0).acos()
}
