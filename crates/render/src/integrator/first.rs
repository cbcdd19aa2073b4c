//! What the camera sees first, for integrators that show the surface and nothing of its light.

use super::{CameraRay, FirstHit, Sample};
use crate::shading::ShadingPoint;
use crate::world::{Eye, Owner, PassingRay, SurfaceHit, World};
use glam::Vec3;
use heliostat_scene::Rgb;

/// A surface covers where its opacity is at least this.
const COVERING: f32 = 0.5;

impl Sample {
    /// A ray that met nothing.
    pub(super) const NOTHING: Self = Self { radiance: Rgb::ZERO, alpha: 0.0, first: None };

    /// A colour on a surface.
    pub(super) fn on(first: FirstHit, radiance: Rgb) -> Self {
        Self { radiance, alpha: 1.0, first: Some(first) }
    }
}

/// The first surface along a camera ray that covers at least half.
pub(super) fn first_hit(world: &World<'_>, ray: &CameraRay) -> Option<(SurfaceHit, FirstHit)> {
    first_from(world, PassingRay::free(ray.ray), ray.time)
}

/// The same for a camera ray that has passed things already.
pub(super) fn first_from(
    world: &World<'_>,
    mut passing: PassingRay,
    time: f32,
) -> Option<(SurfaceHit, FirstHit)> {
    let dir = passing.ray.dir;
    loop {
        let surface = world.seen(&passing, time, Eye::Camera)?;
        let (object, material) = match surface.owner {
            Owner::Object { index, material } => (index, material),
            Owner::Light(_) => return Some((surface, on_light(&surface, dir))),
        };
        let point = ShadingPoint::new(world, &surface, material, dir, time);
        if point.opacity >= COVERING {
            return Some((surface, point.first_hit(object, material)));
        }
        passing = passing.behind(&surface, dir);
    }
}

/// The first hit of a ray that sees the surface of a light.
pub(super) fn on_light(surface: &SurfaceHit, dir: Vec3) -> FirstHit {
    let hit = &surface.hit;
    let normal = if hit.ns.dot(dir) < 0.0 { hit.ns } else { -hit.ns };
    FirstHit { p: hit.at.p, normal, albedo: Rgb::ONE, uv: hit.uv, object: None, material: None }
}
