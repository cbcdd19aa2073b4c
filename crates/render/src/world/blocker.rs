//! What stands in the way of several rays from one place: a verdict for all lanes in `f32`, with doubt wherever rounding
//! could decide. Rays in doubt are left to the exact test of the shape, so that the answer is the same.

mod box_test;
mod chords;

use super::place::Place;
use super::shadow_rays::ShadowRays;
use crate::lanes::Mask;
use crate::world_sphere::WorldSphere;
use box_test::BoxTest;
pub(super) use chords::Chords;
use glam::Vec3;
use heliostat_geometry::Shape;

/// A shape that has a quick test.
#[derive(Clone, Copy, Debug)]
pub(super) enum Blocker {
    /// A sphere in world space.
    Sphere(WorldSphere),
    /// A box in any position.
    Cuboid(BoxTest),
    /// An infinite plane: a point of it and its unit normal.
    Plane(Vec3, Vec3),
}

/// Which rays of a bundle meet a shape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Verdict {
    /// Rays that meet it.
    pub(super) hit: Mask,
    /// Rays of which it is not known; none of them is in `hit`.
    pub(super) doubt: Mask,
}

impl Verdict {
    /// Nothing is known.
    pub(super) const DOUBT: Self = Self { hit: 0, doubt: Mask::MAX };
}

impl Blocker {
    /// The quick test of a shape; `None` where there is none.
    pub(super) fn new(shape: &Shape, place: &Place<'_>) -> Option<Self> {
        let Place::Still(transform) = place else { return None };
        match shape {
            Shape::Sphere(sphere) => WorldSphere::new(sphere.radius, transform).map(Self::Sphere),
            Shape::Cuboid(cuboid) => Some(Self::Cuboid(BoxTest::new(cuboid, transform))),
            Shape::Plane(_) => Some(Self::Plane(transform.point(Vec3::ZERO), transform.normal(Vec3::Y))),
            _ => None,
        }
    }

    /// Which rays meet the shape.
    #[inline]
    pub(super) fn verdict(&self, rays: &ShadowRays<'_>) -> Verdict {
        match self {
            Self::Sphere(sphere) => Chords::new(sphere, rays).map_or(Verdict::DOUBT, |chords| chords.verdict),
            Self::Cuboid(cuboid) => cuboid.verdict(rays),
            Self::Plane(..) => Verdict::DOUBT,
        }
    }
}

#[cfg(test)]
mod tests;
