//! Light sources made ready: each gives samples of the light that arrives at a point.
//!
//! A [`LightSample`] knows the direction, what arrives from there, and where the shadow ray ends. Whether anything
//! stands in between is asked by [`direct`].

mod area;
mod bundle;
mod delta;
pub(crate) mod direct;
mod emitter;
mod flat;
mod sphere;

use crate::world::{Hull, Lamp};
use area::{AreaLight, FlatLamp};
use delta::{DirectionalLight, PointLight};
use glam::{Vec2, Vec3};
use heliostat_geometry::{Aabb, SurfacePoint};
use heliostat_scene::light::LightKind;
use heliostat_scene::{Light, Rgb, Scene};
use std::borrow::Cow;

/// Shadow rays per point towards an object whose material shines.
const SHINING_OBJECT_SAMPLES: u32 = 16;

/// Where the way of the light begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Target {
    /// Infinitely far away.
    Sky,
    /// A point in free space.
    Point(Vec3),
    /// A point on the surface of an object, which must not shade itself.
    Surface(SurfacePoint),
}

/// Light that arrives at a point from one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LightSample {
    /// Unit direction to the light.
    pub(crate) to_light: Vec3,
    /// Irradiance on a surface that faces the light, as if all of the light came through this sample.
    pub(crate) arriving: Rgb,
    /// Where the shadow ray ends.
    pub(crate) target: Target,
}

/// One light source made ready.
#[derive(Debug)]
pub(crate) struct PreparedLight<'s> {
    /// Samples per shading point, at least 1; 1 where all samples are the same.
    pub(crate) samples: u32,
    /// Whether samples differ: the light covers more than a point or a direction.
    pub(crate) is_extended: bool,
    /// Around an area light.
    surface: Option<Hull>,
    source: Source<'s>,
}

/// The kinds that shine from somewhere.
#[derive(Debug)]
enum Source<'s> {
    Point(PointLight),
    Directional(DirectionalLight),
    Area(AreaLight<'s>),
}

impl<'s> PreparedLight<'s> {
    fn new(samples: u32, source: Source<'s>) -> Self {
        let (is_extended, surface) = match &source {
            Source::Point(_) => (false, None),
            Source::Directional(light) => (light.is_wide(), None),
            Source::Area(light) => (true, light.hull()),
        };
        let samples = if is_extended { samples.max(1) } else { 1 };
        Self { samples, is_extended, surface, source }
    }

    /// A hull around all points that light comes from, as seen from `p` in a scene around which lies the box `scene`.
    ///
    /// `None` where no finite one holds them.
    #[inline]
    pub(crate) fn hull(&self, p: Vec3, scene: Aabb) -> Option<Cow<'_, Hull>> {
        match &self.source {
            Source::Point(_) => None,
            Source::Directional(light) => {
                let hull = |bounds| Cow::Owned(Hull::of_box(bounds).endless());
                light.bounds(p, scene).map(hull)
            }
            Source::Area(_) => self.surface.as_ref().map(Cow::Borrowed),
        }
    }

    /// The lamp, where it is a flat one that stands still.
    #[inline]
    fn flat_lamp(&self) -> Option<FlatLamp<'_>> {
        match &self.source {
            Source::Area(light) => light.flat_lamp(),
            Source::Point(_) | Source::Directional(_) => None,
        }
    }

    /// The light that arrives at `p` by the random numbers `u`; `None` where nothing comes this way.
    #[inline]
    pub(crate) fn sample(&self, p: Vec3, u: Vec2, time: f32) -> Option<LightSample> {
        match &self.source {
            Source::Point(light) => light.sample(p),
            Source::Directional(light) => Some(light.sample(u)),
            Source::Area(light) => light.sample(p, u, time),
        }
    }
}

/// All light sources of a scene.
#[derive(Debug)]
pub(crate) struct LightTable<'s> {
    /// Ia: the sum of the ambient lights.
    pub(crate) ambient: Rgb,
    /// The others, objects and parts of groups that shine included.
    pub(crate) lights: Vec<PreparedLight<'s>>,
}

impl<'s> LightTable<'s> {
    /// The lights of a scene whose ids are valid.
    ///
    /// `lamps` are the parts of groups that may shine.
    pub(crate) fn new(scene: &'s Scene, lamps: Vec<Lamp<'s>>) -> Self {
        let ambient = |light: &&Light| matches!(light.kind, LightKind::Ambient);
        let declared = scene.lights.iter().filter_map(|light| prepare(scene, light));
        let objects = scene.objects.iter().map(|object| AreaLight::of_object(scene, object));
        let parts = lamps.into_iter().map(|lamp| AreaLight::of_part(scene, lamp));
        let shining = objects
            .chain(parts)
            .filter_map(|light| Some(PreparedLight::new(SHINING_OBJECT_SAMPLES, Source::Area(light?))));
        Self {
            ambient: scene.lights.iter().filter(ambient).map(|light| light.intensity).sum(),
            lights: declared.chain(shining).collect(),
        }
    }
}

/// A light that shines from somewhere, made ready; `None` for an ambient or a dark one.
fn prepare<'s>(scene: &'s Scene, light: &'s Light) -> Option<PreparedLight<'s>> {
    if light.intensity == Rgb::ZERO {
        return None;
    }
    let source = match &light.kind {
        LightKind::Ambient => return None,
        LightKind::Point { position, falloff } => {
            Source::Point(PointLight::new(light.intensity, *position, *falloff))
        }
        LightKind::Spot { position, direction, inner, outer, falloff } => {
            let point = PointLight::new(light.intensity, *position, *falloff);
            Source::Point(point.into_cone(*direction, *inner, *outer))
        }
        LightKind::Directional { direction, angle } => {
            Source::Directional(DirectionalLight::new(light.intensity, *direction, *angle))
        }
        LightKind::Area { .. } => Source::Area(AreaLight::of_light(scene, light)?),
    };
    Some(PreparedLight::new(light.samples, source))
}

/// The radiance that the visible surface of area light `light` sends along `dir` from where its normal is `ng`.
pub(crate) fn seen(light: &Light, ng: Vec3, dir: Vec3) -> Rgb {
    match &light.kind {
        LightKind::Area { two_sided, .. } if *two_sided || ng.dot(dir) < 0.0 => light.intensity,
        _ => Rgb::ZERO,
    }
}
