//! The boundary between the film and what finds radiance along a camera ray.
//!
//! The film side makes a [`CameraRay`] and a [`Sampler`], an [`Integrator`] answers with a [`Sample`]. Integrators hold
//! no state that changes: every random number comes from the sampler, every count goes to the counters.

mod ambient_occlusion;
mod cost;
mod depth;
mod direct;
mod first;
mod next_event;
mod normals;
mod path;
mod path_simple;
mod roulette;
mod uv;
mod volpath;
mod whitted;

pub(crate) use next_event::left_of;
pub(crate) use path::HOLES;
pub(crate) use roulette::survive;

pub use ambient_occlusion::AmbientOcclusion;
pub use cost::Cost;
pub use depth::Depth;
pub use direct::Direct;
pub use normals::Normals;
pub use path::Path;
pub use path_simple::PathSimple;
pub use uv::Uv;
pub use volpath::VolPath;
pub use whitted::Whitted;

use crate::counters::RayCounters;
use crate::guiding::{Course, Guide};
use crate::ray_cone::RayCone;
use crate::sampler::Sampler;
use crate::world::World;
use glam::{Vec2, Vec3};
use heliostat_geometry::Ray;
use heliostat_scene::settings::IntegratorKind;
use heliostat_scene::{MaterialId, RenderSettings, Rgb};
use std::ops::Range;

/// A ray of the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraRay {
    /// The ray in world space, with a unit direction.
    pub ray: Ray,
    /// When it is traced, in `[0, 1]` over the shutter.
    pub time: f32,
    /// Position of the camera at that time; the origin of the ray may lie elsewhere on the lens.
    pub eye: Vec3,
    /// Unit direction in which the camera looks at that time.
    pub forward: Vec3,
    /// How much of the picture it stands for; no width where the scene has no textures to be filtered.
    pub cone: RayCone,
}

impl CameraRay {
    /// Distance of `p` from the camera along the direction in which it looks: the depth of the `Z` layer.
    pub fn perpendicular_depth(&self, p: Vec3) -> f32 {
        (p - self.eye).dot(self.forward)
    }
}

/// What the ray met first, for the layers beside the beauty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstHit {
    /// Position in world space.
    pub p: Vec3,
    /// Unit shading normal in world space, turned to the viewer.
    pub normal: Vec3,
    /// Share of the light that the surface sends on, per channel in `[0, 1]`.
    pub albedo: Rgb,
    /// Surface parameters; [`Whitted`] may leave them 0 where neither the material nor a layer looks at them.
    pub uv: Vec2,
    /// Index of the object in the scene; `None` for the surface of an area light.
    pub object: Option<u32>,
    /// Its material; `None` for the surface of an area light.
    pub material: Option<MaterialId>,
}

/// What came along a camera ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Radiance, premultiplied by `alpha`; linear, unbounded above.
    pub radiance: Rgb,
    /// Coverage in `[0, 1]`: 1 minus the weight with which the ray left the scene unbent or refracted, when the background is
    /// transparent.
    pub alpha: f32,
    /// The first surface that is not cut away, if any.
    pub first: Option<FirstHit>,
}

/// Finds the radiance along a camera ray.
pub trait Integrator: Sync {
    /// The radiance that arrives along `ray`. The caller counts the camera ray itself in `counters.camera`; everything
    /// that follows is counted here.
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample;

    /// What it learns of a scene before the first sample, by practice on the whole picture; `None` where that is nothing, or the
    /// practice was cancelled.
    fn learn(&self, _world: &World<'_>, _course: &Course<'_>) -> Option<Guide> {
        None
    }

    /// The integrator, led by what it has learnt. `None` where it is this one.
    fn led<'a>(&'a self, _guide: &'a Guide) -> Option<Box<dyn Integrator + 'a>> {
        None
    }

    /// How many samples in a row something has to be worked out for beforehand, at most; `None` where nothing has to be.
    fn samples_at_once(&self) -> Option<u32> {
        None
    }

    /// The integrator for some samples in a row, with what was worked out for them: the same for whatever range holds a sample.
    /// `None` where it is this one.
    fn for_samples<'a>(
        &'a self,
        _world: &World<'_>,
        _samples: Range<u32>,
    ) -> Option<Box<dyn Integrator + 'a>> {
        None
    }
}

/// The integrator that the settings name.
pub fn create(settings: &RenderSettings) -> Box<dyn Integrator> {
    match settings.integrator {
        IntegratorKind::Whitted => Box::new(Whitted::new(settings)),
        IntegratorKind::Normals => Box::new(Normals),
        IntegratorKind::Depth => Box::new(Depth),
        IntegratorKind::Uv => Box::new(Uv),
        IntegratorKind::AmbientOcclusion => Box::new(AmbientOcclusion::new(settings)),
        IntegratorKind::Cost => Box::new(Cost),
        IntegratorKind::Direct => Box::new(Direct::new(settings)),
        IntegratorKind::PathSimple => Box::new(PathSimple::new(settings)),
        IntegratorKind::Path => Box::new(Path::new(settings)),
        IntegratorKind::VolPath => Box::new(VolPath::new(settings)),
    }
}
