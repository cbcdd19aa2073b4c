//! Whether a ray may meet a thing, before it is asked: by a sphere or a box around it.

mod few;

use super::World;
use super::blocker::Blocker;
use super::solid::Solid;
pub(super) use few::{FEW, FewBoxes};
use glam::Vec3;
use heliostat_geometry::error_bound::{cell_padding, gamma, inverse_direction};
use heliostat_geometry::{Aabb, Ray};

/// What lies around a thing.
#[derive(Clone, Copy, Debug)]
pub(super) enum Bound {
    /// Nothing that is worth a question.
    Unbounded,
    /// A sphere.
    Sphere(Ball),
    /// A box, and the sphere around it, which is asked first.
    Box(Ball, Aabb),
}

/// A sphere that holds another one, wherever rounding put that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    centre: Vec3,
    radius_squared: f32,
}

impl Ball {
    fn around(centre: Vec3, radius: f32) -> Self {
        // A ray that crosses a surface starts a few error bounds before it.
        let radius = radius + gamma(32) * (centre.length() + radius);
        Self { centre, radius_squared: radius * radius }
    }
}

impl World<'_> {
    /// A ball around an object whose surface is one: its centre and radius, rounded up.
    pub(crate) fn ball_around(&self, object: u32) -> Option<(Vec3, f32)> {
        let Some(Blocker::Sphere(sphere)) = self.solids[object as usize].blocker else { return None };
        let (centre, radius) = (sphere.centre.as_vec3(), sphere.radius as f32);
        Some((centre, radius + gamma(4) * (centre.length() + radius)))
    }
}

impl Bound {
    /// The bound of a thing that is not empty.
    pub(super) fn new(solid: &Solid<'_>) -> Self {
        if let Some(Blocker::Sphere(sphere)) = solid.blocker {
            return Self::Sphere(Ball::around(sphere.centre.as_vec3(), sphere.radius as f32));
        }
        let bounds = solid.bounds;
        if !bounds.is_finite() {
            return Self::Unbounded;
        }
        Self::Box(Ball::around(bounds.centre(), 0.5 * bounds.size().length()), bounds)
    }

    /// Whether a ray may meet what lies inside in its range; false only where it does not.
    #[inline]
    pub(super) fn may_meet(&self, ray: &Ray) -> bool {
        match self {
            Self::Unbounded => true,
            Self::Sphere(ball) => meets_ball(ray, ball),
            Self::Box(ball, bounds) => meets_ball(ray, ball) && meets_box(ray, bounds),
        }
    }
}

/// The bound of rounding is that of [`heliostat_geometry::error_bound::line_and_sphere`], with the mean of both squares
/// instead of their geometric mean: a little larger, and free of roots.
#[inline]
fn meets_ball(ray: &Ray, ball: &Ball) -> bool {
    let to_centre = ball.centre - ray.origin;
    let distance_squared = to_centre.length_squared();
    let outer = ball.radius_squared + gamma(32) * (distance_squared + ball.radius_squared);
    let along = to_centre.dot(ray.dir);
    let is_behind = along < 0.0 && distance_squared > outer;
    let passes = to_centre.cross(ray.dir).length_squared() > outer * ray.dir.length_squared();
    // A NaN, from numbers that overflow, does not say that it misses.
    let misses = is_behind || passes;
    !misses
}

fn meets_box(ray: &Ray, bounds: &Aabb) -> bool {
    BoxRay::new(ray).may_meet(bounds, ray.range.max)
}

/// A ray that asks for several boxes.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxRay {
    origin: Vec3,
    inverse: Vec3,
    /// Largest coordinate of the origin.
    reach: f32,
    start: f32,
}

impl BoxRay {
    #[inline]
    pub(super) fn new(ray: &Ray) -> Self {
        Self {
            origin: ray.origin,
            inverse: Vec3::from(inverse_direction(ray.dir.into())),
            reach: ray.origin.abs().max_element(),
            start: ray.range.min,
        }
    }

    /// Whether the ray may meet what lies in the box, from its start up to `end`; false only where it does not.
    ///
    /// # Source
    /// Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986; distances are grown by their rounding as in Ize, "Robust BVH
    /// Ray Traversal", JCGT 2013.
    #[inline]
    pub(super) fn may_meet(&self, bounds: &Aabb, end: f32) -> bool {
        let reach = self.reach + bounds.min.abs().max(bounds.max.abs()).max_element();
        let a = (bounds.min - self.origin) * self.inverse;
        let b = (bounds.max - self.origin) * self.inverse;
        let padding = cell_padding(reach, reach) * self.inverse.abs();
        let near = (a.min(b) - padding).max_element().max(self.start);
        let far = (a.max(b) + padding).min_element().min(end);
        // A NaN, from numbers that overflow, does not say that it misses.
        let misses = near > far;
        !misses
    }
}

#[cfg(test)]
mod tests;
