//! Light sources made ready: each gives samples of the light that arrives at a point.
//!
//! A [`LightSample`] knows the direction, what arrives from there, and where the shadow ray ends. Whether anything
//! stands in between is asked by [`direct`]. Whitted's recursion asks every light; paths ask one, and [`whole`] chooses which.

mod area;
mod beams;
mod bundle;
mod choice;
mod cluster;
mod delta;
pub(crate) mod direct;
pub(crate) mod emission;
mod emitter;
mod flat;
mod lamps;
mod points;
mod sky;
mod sphere;
mod spherical_rectangle;
mod sums;
mod table2d;
mod tree;
mod whole;

pub(crate) use whole::Lookout;

use crate::atmosphere::SunDisk;
use crate::world::{Hull, Lamp};
use area::{AreaLight, FlatLamp};
use choice::{LightSampler, Reach};
use delta::{DirectionalLight, PointLight};
use glam::{Vec2, Vec3};
use heliostat_geometry::{Aabb, SurfacePoint};
use heliostat_scene::light::LightKind;
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::LightChoice;
use heliostat_scene::{Light, MaterialId, Object, Rgb, Scene};
use lamps::Lamps;
use points::Points;
use sky::Sky;
use std::borrow::Cow;
use std::f32::consts::FRAC_1_PI;
use std::sync::Arc;

/// Shadow rays per point towards an object whose material shines.
const SHINING_OBJECT_SAMPLES: u32 = 16;

/// What the lights are made ready for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Use {
    /// Whitted's recursion and what shows surfaces alone: lights stand in nobody's way, and shine as the report has it.
    Recursion,
    /// Paths: the surfaces of lights stop light, and all of it is what its unit says.
    Paths,
}

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
    /// Irradiance on a surface that faces the light, as if all of the light came through this sample: radiance over `pdf`
    /// where that is finite.
    pub(crate) arriving: Rgb,
    /// Density of the direction by solid angle; infinite for light that no ray finds by itself.
    pub(crate) pdf: f32,
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
    /// The disc of the sun, with the factor by which it lights: 1, but for Whitted the share of a surface that answers it.
    Sun(SunDisk, f32),
}

impl<'s> PreparedLight<'s> {
    fn new(samples: u32, source: Source<'s>) -> Self {
        let (is_extended, surface) = match &source {
            Source::Point(_) => (false, None),
            Source::Directional(light) => (light.is_wide(), None),
            Source::Area(light) => (true, light.hull()),
            Source::Sun(..) => (true, None),
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
            Source::Point(_) | Source::Sun(..) => None,
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
            Source::Point(_) | Source::Directional(_) | Source::Sun(..) => None,
        }
    }

    /// The light that arrives at `p` from a piece of it, by the random numbers `u`; `None` where nothing comes this way.
    #[inline]
    pub(crate) fn sample(&self, p: Vec3, piece: usize, u: Vec2, time: f32) -> Option<LightSample> {
        match &self.source {
            Source::Point(light) => light.sample(p),
            Source::Directional(light) => Some(light.sample(u)),
            Source::Area(light) => light.sample(p, piece, u, time),
            Source::Sun(disk, share) => {
                let (to_light, radiance, pdf) = disk.sample(u);
                let arriving = share / pdf * radiance;
                Some(LightSample { to_light, arriving, pdf, target: Target::Sky })
            }
        }
    }

    /// What a choice among lights has to know of each piece of it.
    fn reaches(&self) -> Vec<Reach> {
        match &self.source {
            Source::Point(light) => vec![light.reach()],
            Source::Directional(light) => vec![light.reach()],
            Source::Area(light) => light.reaches(),
            Source::Sun(disk, _) => vec![Reach::Far(disk.brightness())],
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
    /// What comes from infinitely far, from all around.
    pub(crate) sky: Sky<'s>,
    /// Indices of the lights that cover a part of the sky.
    suns: Vec<usize>,
    owners: Owners,
    sampler: LightSampler,
    points: Points,
}

/// Which light a surface belongs to.
#[derive(Debug, Default)]
struct Owners {
    /// By lights of the scene.
    declared: Vec<Option<usize>>,
    /// By objects and their parts that shine, ascending.
    shining: Vec<((u32, u64), usize)>,
}

impl<'s> LightTable<'s> {
    /// The lights of a scene whose ids are valid.
    ///
    /// `lamps` are the parts of groups that may shine.
    pub(crate) fn new(scene: &'s Scene, lamps: Vec<Lamp<'s>>, used: Use, choice: LightChoice) -> Self {
        let ambient = |light: &&Light| matches!(light.kind, LightKind::Ambient);
        let ambient = scene.lights.iter().filter(ambient).map(|light| light.intensity).sum();
        let (mut lights, mut owners) = (Vec::new(), Owners::default());
        let mut stock = Lamps::new(scene, used, shining(scene) + lamps.len());
        for light in &scene.lights {
            let prepared = prepare(&mut stock, light);
            owners.declared.push(prepared.is_some().then_some(lights.len()));
            lights.extend(prepared);
        }
        let objects = (0..).zip(&scene.objects);
        let mut add = |owner, light: Option<AreaLight<'s>>| {
            let Some(light) = light else { return };
            owners.shining.push((owner, lights.len()));
            lights.push(PreparedLight::new(SHINING_OBJECT_SAMPLES, Source::Area(light)));
        };
        objects.for_each(|(i, object)| add((i, 0), AreaLight::of_object(&mut stock, object)));
        lamps.into_iter().for_each(|lamp| add(lamp.owner, AreaLight::of_part(&mut stock, lamp)));
        owners.shining.sort_unstable_by_key(|&(owner, _)| owner);
        let (sky, disk) = Sky::new(&scene.background, ambient, used);
        // Whitted's lights say what a white surface shows of them.
        let share = if used == Use::Recursion { FRAC_1_PI } else { 1.0 };
        lights.extend(disk.map(|disk| PreparedLight::new(1, Source::Sun(disk, share))));
        let is_sun = |light: &PreparedLight<'_>| match &light.source {
            Source::Directional(sun) => sun.is_wide(),
            Source::Sun(..) => true,
            Source::Point(_) | Source::Area(_) => false,
        };
        let suns = (0..lights.len()).filter(|&i| is_sun(&lights[i])).collect();
        let sampler = whole::sampler(&lights, &sky, choice);
        let points = Points::new(&lights);
        Self { ambient, lights, sky, suns, owners, sampler, points }
    }
}

/// How many objects and lights of a scene may be meshes that shine.
fn shining(scene: &Scene) -> usize {
    let shines = |object: &&Object| {
        let emits = |id: &MaterialId| !scene.materials[id.index()].surface.emission().is_zero();
        matches!(object.geometry, Geometry::Mesh(_)) && object.materials.iter().any(emits)
    };
    let is_area = |light: &&Light| matches!(&light.kind, LightKind::Area { geometry: Geometry::Mesh(_), .. });
    scene.objects.iter().filter(shines).count() + scene.lights.iter().filter(is_area).count()
}

/// A light that shines from somewhere, made ready; `None` for an ambient or a dark one.
fn prepare<'s>(stock: &mut Lamps<'s>, light: &'s Light) -> Option<PreparedLight<'s>> {
    let used = stock.used;
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
            Source::Directional(DirectionalLight::new(light.intensity, *direction, *angle, used))
        }
        LightKind::Measured { position, axis, across, profile, falloff } => {
            let point = PointLight::new(light.intensity, *position, *falloff);
            Source::Point(point.into_measured(*axis, *across, Arc::clone(profile)))
        }
        LightKind::Area { .. } => Source::Area(AreaLight::of_light(stock, light)?),
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
