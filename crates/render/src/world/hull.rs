//! A convex hull around something, as a box or an ellipsoid in any position: how far it reaches along an axis.

use super::place::Place;
use glam::{DVec3, Vec3};
use heliostat_geometry::error_bound::{gamma, projection};
use heliostat_geometry::{Aabb, Shape, Transform};

/// A parallelepiped, or the ellipsoid inside it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hull {
    pub(super) centre: Vec3,
    /// From the centre to the middle of three faces.
    edges: [Vec3; 3],
    /// Whether the ellipsoid is meant.
    is_round: bool,
    /// Whether rays to it go on behind it.
    pub(super) is_endless: bool,
    /// Of a sphere around its centre that holds it, to a few roundings.
    pub(super) radius: f32,
}

impl Hull {
    /// A box along the axes.
    pub(crate) fn of_box(bounds: Aabb) -> Self {
        let centre = bounds.centre();
        let half = (bounds.max - centre).max(centre - bounds.min);
        Self::around(centre, [Vec3::X * half.x, Vec3::Y * half.y, Vec3::Z * half.z], false)
    }

    /// Around the image of a shape, or of a thing with the box `local`; around all of its ways if it moves.
    pub(crate) fn new(local: Aabb, shape: Option<&Shape>, place: &Place<'_>) -> Self {
        match place {
            Place::Still(transform) if local.is_finite() => Self::of_image(local, shape, transform),
            _ => Self::of_box(place.bounds(local)),
        }
    }

    fn of_image(local: Aabb, shape: Option<&Shape>, transform: &Transform) -> Self {
        let linear = transform.matrix().matrix3;
        let centre = 0.5 * (local.min.as_dvec3() + local.max.as_dvec3());
        let half = local.max.as_dvec3() - centre;
        // A disk lies in its rectangle as an ellipsoid does, with no height.
        let is_round = matches!(shape, Some(Shape::Sphere(_) | Shape::Disk(_)));
        let edge = |column: DVec3, length: f64| (length * column).as_vec3();
        let centre = transform.matrix().transform_point3(centre).as_vec3();
        let edges = [edge(linear.x_axis, half.x), edge(linear.y_axis, half.y), edge(linear.z_axis, half.z)];
        Self::around(centre, edges, is_round)
    }

    fn around(centre: Vec3, edges: [Vec3; 3], is_round: bool) -> Self {
        let [a, b, c] = edges;
        // The farthest corner; its opposite lies equally far out.
        let corners = [a + b + c, a + b - c, a - b + c, a - b - c];
        let radius = corners.into_iter().map(Vec3::length).fold(0.0, f32::max);
        Self { centre, edges, is_round, is_endless: false, radius }
    }

    /// The same for a light that lies behind it, infinitely far away.
    pub(crate) fn endless(self) -> Self {
        Self { is_endless: true, ..self }
    }

    /// The largest cosine between the unit vector `axis` and a direction from `p` to the hull; rounded up.
    pub(crate) fn nearest_cosine(&self, p: Vec3, axis: Vec3) -> f32 {
        let way = self.centre - p;
        let distance = way.length();
        let sin_radius = self.radius / distance;
        let cos = axis.dot(way) / distance;
        let cos_radius = (1.0 - sin_radius * sin_radius).sqrt();
        // False for a NaN, from a point inside.
        let is_outside = cos < cos_radius;
        if !is_outside {
            return 1.0;
        }
        // The cosine of the angle to the centre less that of the radius.
        cos * cos_radius + (1.0 - cos * cos).max(0.0).sqrt() * sin_radius + gamma(64)
    }

    /// Whether all of it lies behind the plane through `p` with normal `n`.
    pub(crate) fn is_behind(&self, p: Vec3, n: Vec3) -> bool {
        n.dot(self.centre - p) < -self.extent(n) - projection(self.reach() + p.abs(), n)
    }

    /// Half of its length along `axis`, times the length of `axis`.
    #[inline]
    pub(super) fn extent(&self, axis: Vec3) -> f32 {
        let along = Vec3::new(self.edges[0].dot(axis), self.edges[1].dot(axis), self.edges[2].dot(axis));
        if self.is_round { along.length() } else { along.abs().element_sum() }
    }

    /// Largest magnitudes of the numbers that make up its points.
    pub(super) fn reach(&self) -> Vec3 {
        self.centre.abs() + self.edges[0].abs() + self.edges[1].abs() + self.edges[2].abs()
    }
}
