//! Where a path runs: its ray, and the bodies that it runs through.

use crate::integrator::{CameraRay, left_of};
use crate::interiors::Interiors;
use crate::path_point::{Covering, Onward, PathPoint};
use crate::world::{Eye, PassingRay, SurfaceHit, World};
use glam::Vec3;
use heliostat_geometry::Ray;
use heliostat_scene::Rgb;

/// A ray and what it runs through.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Track {
    pub(crate) passing: PassingRay,
    pub(crate) around: Interiors,
}

impl Track {
    /// A ray of the camera.
    pub(crate) fn from_camera(world: &World<'_>, ray: &CameraRay) -> Self {
        let free = Self::free(world, ray.ray, ray.time);
        Self { passing: free.passing.with_cone(ray.cone), ..free }
    }

    /// A ray without width that starts in free space.
    pub(crate) fn free(world: &World<'_>, ray: Ray, time: f32) -> Self {
        Self { passing: PassingRay::free(ray), around: world.around(ray.origin, time) }
    }

    /// What the ray meets first that the eye sees.
    #[inline]
    pub(crate) fn seen(&self, world: &World<'_>, time: f32, eye: Eye) -> Option<SurfaceHit> {
        world.seen_inside(&self.passing, self.around.last(), time, eye)
    }

    /// Direction of the ray, of any length.
    #[inline]
    pub(crate) fn dir(&self) -> Vec3 {
        self.passing.ray.dir
    }

    /// The share of light that is left of the way to a surface: what the ray runs through absorbs, or what it leaves there (`leaves`)
    /// and was not known to be in, because the camera stands in it, or one thing in another.
    #[inline]
    pub(crate) fn left(&self, leaves: Option<Rgb>, surface: &SurfaceHit) -> Rgb {
        match self.around.ruling().map(|inside| inside.absorption).or(leaves) {
            Some(absorption) => left_of(absorption, surface.hit.t * self.dir().length()),
            None => Rgb::ONE,
        }
    }

    /// Goes on as if there were no surface.
    pub(crate) fn pass(&mut self, covering: &Covering<'_>, surface: &SurfaceHit) {
        let dir = self.dir();
        self.passing = self.passing.behind(surface, dir);
        self.around.change(&covering.straight_change(surface, dir));
    }

    /// Goes the way that a point sends it.
    #[inline]
    pub(crate) fn take(&mut self, onward: &Onward, point: &PathPoint<'_>) {
        point.send(onward, &mut self.passing, &mut self.around);
    }
}
