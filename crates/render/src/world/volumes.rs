//! The media of the world: what fills which space, and where rays cross from one into another.

use super::group::Look;
use super::level::Level;
use super::thing::Met;
use super::{Eye, Inside, PassingRay, SurfaceHit, Thing, World};
use crate::interiors::Interiors;
use crate::medium::PreparedMedium;
use crate::medium::flight::Way;
use crate::ray_cone::RayCone;
use crate::world::body::Parameters;
use glam::Vec3;
use heliostat_geometry::{Aabb, Ray};
use heliostat_scene::light::LightKind;
use heliostat_scene::object::Geometry;
use heliostat_scene::{Census, Material, Object, Scene};
use std::cmp::Reverse;

/// A point looks for the bodies around it along this direction, which no wall of a scene follows.
const OUTWARD: Vec3 = Vec3::new(0.538_1, 0.760_9, 0.362_7);
/// So many surfaces of one thing are passed at most in search of those that hold a point.
const MOST_SURFACES: usize = 256;

/// All media of a scene.
#[derive(Debug)]
pub(super) struct Volumes<'s> {
    media: Vec<PreparedMedium<'s>>,
    atmosphere: Option<(usize, Ball)>,
    /// For each solid whether it, or a part of it, is the boundary of a medium or a body with a priority.
    hosts: Vec<bool>,
    has_hosts: bool,
}

/// What the atmosphere fills.
#[derive(Clone, Copy, Debug)]
struct Ball {
    centre: Vec3,
    radius: f32,
}

impl Ball {
    /// The part of a way inside of it.
    fn clip(&self, way: &Way) -> Way {
        let (to_centre, radius) = ((self.centre - way.origin).as_dvec3(), f64::from(self.radius));
        let nearest = to_centre.dot(way.dir.as_dvec3());
        let across = radius * radius - (to_centre - nearest * way.dir.as_dvec3()).length_squared();
        if across <= 0.0 {
            return Way { to: way.from, ..*way };
        }
        let half = across.sqrt();
        let (near, far) = ((nearest - half) as f32, (nearest + half) as f32);
        let from = way.from.max(near);
        Way { from, to: way.to.min(far).max(from), ..*way }
    }
}

impl<'s> Volumes<'s> {
    /// `level` knows the boxes of all solids, the surfaces of lights last.
    pub(super) fn new(scene: &'s Scene, census: &Census, solids: usize, level: &Level) -> Self {
        let mut hosts = hosts(scene, census);
        hosts.resize(solids, false);
        let atmosphere = scene.atmosphere.as_ref().map(|atmosphere| {
            let bounds = everything(scene, level.bounds());
            let least = if bounds.is_empty() { 0.0 } else { 0.5 * bounds.size().length() };
            let centre = if bounds.is_empty() { Vec3::ZERO } else { bounds.centre() };
            let radius = least.max(atmosphere.radius.unwrap_or(0.0));
            (atmosphere.medium.index(), Ball { centre, radius })
        });
        Self {
            media: scene.media.iter().map(PreparedMedium::new).collect(),
            atmosphere,
            has_hosts: hosts.contains(&true),
            hosts,
        }
    }
}

/// Around all that is finite, and all cameras.
fn everything(scene: &Scene, bounds: Aabb) -> Aabb {
    let poses = scene.cameras.iter().flat_map(|camera| camera.motion.poses());
    let lights = scene.lights.iter().filter_map(|light| match &light.kind {
        LightKind::Point { position, .. }
        | LightKind::Spot { position, .. }
        | LightKind::Measured { position, .. } => Some(*position),
        LightKind::Area { transform, .. } => Some(transform.point(Vec3::ZERO)),
        LightKind::Ambient | LightKind::Directional { .. } => None,
    });
    poses.map(|pose| pose.translation.as_vec3()).chain(lights).fold(bounds, Aabb::grow)
}

fn hosts(scene: &Scene, census: &Census) -> Vec<bool> {
    let is_host = |material: &Material| material.interior.is_some() || material.priority.is_some();
    let mut groups = vec![false; scene.groups.len()];
    let object = |groups: &[bool], object: &Object| match &object.geometry {
        Geometry::Group(id) => groups[id.index()],
        _ => object.materials.iter().any(|id| is_host(&scene.materials[id.index()])),
    };
    // Those that a group holds come before it.
    for id in census.order() {
        let group = &scene.groups[id.index()];
        groups[id.index()] = group.objects.iter().any(|member| object(&groups, member));
    }
    scene.objects.iter().map(|placed| object(&groups, placed)).collect()
}

/// The medium at the start of a way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Matter<'w, 's> {
    pub(crate) medium: &'w PreparedMedium<'s>,
    /// Where it ends by itself.
    ball: Option<Ball>,
}

impl Matter<'_, '_> {
    /// The part of a way on which it is there.
    pub(crate) fn clip(&self, way: Way) -> Way {
        self.ball.map_or(way, |ball| ball.clip(&way))
    }
}

impl<'s> World<'s> {
    /// The medium where these bodies are around.
    #[inline]
    pub(crate) fn matter(&self, around: &Interiors) -> Option<Matter<'_, 's>> {
        match around.ruling() {
            Some(inside) => {
                let medium = &self.volumes.media[inside.interior?.index()];
                Some(Matter { medium, ball: None })
            }
            None => {
                let (index, ball) = self.volumes.atmosphere?;
                Some(Matter { medium: &self.volumes.media[index], ball: Some(ball) })
            }
        }
    }

    /// Whether there is a medium anywhere.
    #[inline]
    pub(crate) fn has_media(&self) -> bool {
        !self.volumes.media.is_empty()
    }

    /// The nearest surface on the way of a ray that may be the boundary of a medium.
    pub(crate) fn boundary(&self, passing: &PassingRay, time: f32) -> Option<SurfaceHit> {
        if !self.volumes.has_hosts {
            return None;
        }
        let found = self.level.closest(&passing.ray, |solid, search, met| {
            let look = Look { passing, solid, time, eye: Eye::Any, cost: None };
            self.volumes.hosts[solid as usize].then(|| self.meet(&look, search, met))?
        })?;
        let thing = Thing { solid: found.primitive, part: found.data.part };
        let mut room = None;
        let ray = passing.seen_by(thing, &passing.ray, &mut room);
        self.surface(thing.solid, (ray, &passing.cone), time, &found.data, Parameters::Used)
    }

    /// The bodies that hold a point, those that are boundaries of media or have a priority: it lies in those that a ray leaves
    /// before it enters them.
    pub(crate) fn around(&self, p: Vec3, time: f32) -> Interiors {
        let mut around = Interiors::NONE;
        if !self.volumes.has_hosts {
            return around;
        }
        let mut found: Vec<(f32, Inside)> = Vec::new();
        for (solid, _) in (0..).zip(&self.volumes.hosts).filter(|(_, is_host)| **is_host) {
            if self.solids[solid as usize].bounds.contains(p) {
                self.holders(solid, p, time, &mut found);
            }
        }
        // The outermost was entered first.
        found.sort_by_key(|(t, _)| Reverse(t.to_bits()));
        found.into_iter().for_each(|(_, inside)| around.enter(inside));
        around
    }

    /// Adds the parts of a solid that hold a point, with the distances to their surfaces.
    fn holders(&self, solid: u32, p: Vec3, time: f32, found: &mut Vec<(f32, Inside)>) {
        let passing = PassingRay::free(Ray::new(p, OUTWARD));
        let look = Look { passing: &passing, solid, time, eye: Eye::Any, cost: None };
        let mut rest = passing.ray;
        let mut seen: Vec<Thing> = Vec::new();
        for _ in 0..MOST_SURFACES {
            let mut met = Met::default();
            let Some(t) = self.meet(&look, &rest, &mut met) else { return };
            let Some(surface) = self.surface(solid, (&rest, &RayCone::POINT), time, &met, Parameters::Used)
            else {
                return;
            };
            if let (Some(thing), Some(id)) = (surface.thing(), surface.material())
                && !seen.contains(&thing)
            {
                seen.push(thing);
                let material = &self.scene.materials[id.index()];
                let is_boundary = material.interior.is_some() || material.priority.is_some();
                if is_boundary && surface.hit.at.ng.dot(OUTWARD) > 0.0 {
                    found.push((t, Inside::of(thing, material)));
                }
            }
            rest.range.min = t.next_up();
        }
    }

    /// The nearest surface of one thing on the way of a ray.
    pub(crate) fn own_surface(&self, thing: Thing, passing: &PassingRay, time: f32) -> Option<SurfaceHit> {
        self.seen_on(thing, passing, time)
    }

    /// A box around an object over the shutter.
    pub(crate) fn bounds_of_object(&self, object: u32) -> Aabb {
        self.solids[object as usize].bounds
    }

    /// A box around a thing.
    pub(crate) fn bounds_of(&self, thing: Thing) -> Aabb {
        self.solids[thing.solid as usize].bounds
    }
}
