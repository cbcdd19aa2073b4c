//! What a point may expect of several clusters of lights, side by side: loops over lanes that the compiler makes vectors of.
//!
//! # Source
//! See [`super::cluster`]; the surface term is kept one-sided where a surface lets no light through, which leaves out what lies
//! behind it.

use super::Lookout;
use super::cluster::Cluster;
use crate::lanes::widest;
use glam::Vec3;
use pulp::NullaryFnOnce;

/// Clusters side by side.
pub(super) const WIDTH: usize = 8;

/// One number for each of them.
pub(super) type Lane = [f32; WIDTH];

/// Clusters as points see them; a place without one sends nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beams {
    /// Centres of the boxes, by axis.
    centre: [Lane; 3],
    /// Of the balls around the boxes.
    radius_squared: Lane,
    /// Axes of the cones of normals.
    axis: [Lane; 3],
    /// Sine and cosine of the half angles of these cones.
    sin: Lane,
    cos: Lane,
    /// Cosine of the angle from a normal at which light ends.
    least_cos: Lane,
    intensity: Lane,
    /// -1 where light leaves against the normals too, else 1.
    side: Lane,
}

/// An angle in `[0, pi]` by its sine and cosine.
#[derive(Clone, Copy, Debug)]
struct Angle {
    sin: f32,
    cos: f32,
}

impl Beams {
    /// No cluster.
    pub(super) const NONE: Self = Self {
        centre: [[0.0; WIDTH]; 3],
        radius_squared: [1.0; WIDTH],
        axis: [[0.0; WIDTH]; 3],
        sin: [0.0; WIDTH],
        cos: [1.0; WIDTH],
        least_cos: [1.0; WIDTH],
        intensity: [0.0; WIDTH],
        side: [1.0; WIDTH],
    };

    /// Puts a cluster in a place.
    pub(super) fn set(&mut self, place: usize, cluster: &Cluster) {
        let (sin, cos) = cluster.normals.angle.sin_cos();
        let (centre, axis) = (cluster.bounds.centre(), cluster.normals.axis);
        for i in 0..3 {
            (self.centre[i][place], self.axis[i][place]) = (centre[i], axis[i]);
        }
        // A single point is a ball that nothing is inside of.
        let radius_squared = (0.5 * cluster.bounds.size()).length_squared();
        self.radius_squared[place] = radius_squared.max(f32::MIN_POSITIVE);
        (self.sin[place], self.cos[place]) = (sin, cos);
        self.least_cos[place] = cluster.spread.cos();
        self.intensity[place] = cluster.intensity;
        self.side[place] = if cluster.two_sided { -1.0 } else { 1.0 };
    }

    /// About the irradiance from each; 0 only where no light comes from there.
    #[inline]
    pub(super) fn importances(&self, from: &Lookout) -> Lane {
        let side = if from.is_open { -1.0 } else { 1.0 };
        // A point of a medium has no normal, and takes light from anywhere.
        let least = if from.n == Vec3::ZERO { 1.0 } else { -1.0 };
        widest(Judge { beams: self, p: from.p, n: from.n, sides: [side, least] })
    }

    /// One lane, without branches. `side` is -1 for surfaces that let light through; `least` the smallest cosine there is at
    /// the point.
    #[inline(always)]
    fn importance(&self, i: usize, p: Vec3, n: Vec3, [side, least]: [f32; 2]) -> f32 {
        let way = p - Vec3::new(self.centre[0][i], self.centre[1][i], self.centre[2][i]);
        let axis = Vec3::new(self.axis[0][i], self.axis[1][i], self.axis[2][i]);
        let (distance_squared, radius_squared) = (way.length_squared(), self.radius_squared[i]);
        let is_inside = distance_squared <= radius_squared;
        let strength = self.intensity[i] / distance_squared.max(radius_squared);
        let scale = 1.0 / distance_squared.max(f32::MIN_POSITIVE).sqrt();
        // The angle under which the ball is seen weakens the say of both cosines.
        let sin2 = (radius_squared * scale * scale).min(1.0);
        let seen = Angle { sin: sin2.sqrt(), cos: (1.0 - sin2).sqrt() };
        let cos = scale * axis.dot(way);
        let off_axis = Angle::of_cos(cos.max(self.side[i] * cos));
        let leaving = off_axis.less(Angle { sin: self.sin[i], cos: self.cos[i] }).less(seen);
        let cos = -scale * n.dot(way);
        let arriving = Angle::of_cos(cos.max(side * cos).max(least)).less(seen);
        let share = leaving.cos.max(0.0) * arriving.cos.max(0.0);
        let share = if leaving.cos < self.least_cos[i] { 0.0 } else { share };
        strength * if is_inside { 1.0 } else { share }
    }
}

/// The work of [`Beams::importances`].
struct Judge<'a> {
    beams: &'a Beams,
    p: Vec3,
    n: Vec3,
    sides: [f32; 2],
}

impl NullaryFnOnce for Judge<'_> {
    type Output = Lane;

    #[inline(always)]
    fn call(self) -> Lane {
        let mut importances = [0.0; WIDTH];
        for (i, importance) in importances.iter_mut().enumerate() {
            *importance = self.beams.importance(i, self.p, self.n, self.sides);
        }
        importances
    }
}

impl Angle {
    #[inline(always)]
    fn of_cos(cos: f32) -> Self {
        Self { sin: (1.0 - cos * cos).max(0.0).sqrt(), cos }
    }

    /// The difference, at least 0.
    #[inline(always)]
    fn less(self, other: Self) -> Self {
        let is_more = self.cos > other.cos;
        let sin = self.sin * other.cos - self.cos * other.sin;
        let cos = self.cos * other.cos + self.sin * other.sin;
        Self { sin: if is_more { 0.0 } else { sin }, cos: if is_more { 1.0 } else { cos } }
    }
}
