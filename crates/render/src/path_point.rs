//! A surface point as paths see it: how it scatters light, and which way goes on from it.

use crate::bsdf::{Bsdf, BsdfSample, Event, Surroundings, View};
use crate::counters::RayCounters;
use crate::guiding::{Guide, Lead};
use crate::horizon::Horizon;
use crate::integrator::FirstHit;
use crate::interiors::{Change, Interiors};
use crate::light::{Lookout, Target};
use crate::material_eval::MaterialEval;
use crate::medium::PreparedMedium;
use crate::normals::Normals;
use crate::world::{Inside, PassingRay, SurfaceHit, World};
use glam::{Vec2, Vec3};
use heliostat_geometry::{OrthonormalFrame, Ray};
use heliostat_scene::material::Surface;
use heliostat_scene::{Material, MaterialId, Rgb};

/// A hit on an object whose material is not evaluated yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Covering<'a> {
    id: MaterialId,
    material: &'a Material,
    eval: MaterialEval<'a>,
    /// Vertex colour.
    tint: Rgb,
}

/// A surface point seen from one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathPoint<'a> {
    surface: &'a SurfaceHit,
    material: &'a Material,
    normals: Normals,
    horizon: Horizon,
    /// Around the shading normal.
    frame: OrthonormalFrame,
    /// Direction to the viewer in the frame.
    wo: Vec3,
    time: f32,
    view: View<'a>,
    /// What leads paths on from here, beside the surface.
    lead: Option<Lead<'a>>,
}

/// A way on from a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Onward {
    /// Unit direction.
    pub(crate) dir: Vec3,
    /// Whether it leads to the viewer's side, and not through the surface.
    is_back: bool,
    /// Whether it goes on as if there were nothing, so that lights are seen through the surface.
    pub(crate) is_straight: bool,
    /// How it was drawn; the weight is what the radiance from there is multiplied by.
    pub(crate) sample: BsdfSample,
}

impl Onward {
    /// Counts its ray.
    #[inline]
    pub(crate) fn count(&self, counters: &mut RayCounters) {
        *match self.sample.event {
            Event::Transmission => &mut counters.refraction,
            _ if self.sample.is_delta() => &mut counters.reflection,
            Event::Diffuse | Event::Glossy | Event::Subsurface => &mut counters.scatter,
        } += 1;
    }
}

impl<'a> Covering<'a> {
    /// The material of a hit.
    #[inline]
    pub(crate) fn new(world: &World<'a>, surface: &SurfaceHit, material: MaterialId) -> Self {
        let scene = world.scene();
        let eval = MaterialEval { textures: &scene.textures, at: surface.texture_point() };
        let tint = surface.color.unwrap_or(Rgb::ONE);
        Self { id: material, material: &scene.materials[material.index()], eval, tint }
    }

    /// Coverage in `[0, 1]`.
    #[inline]
    pub(crate) fn opacity(&self) -> f32 {
        let is_whole = !self.material.has_holes() && self.eval.at.coverage == 1.0;
        if is_whole { 1.0 } else { self.eval.opacity(self.material) }
    }

    /// Whether the surface does not exist: another body with a higher priority is there.
    #[inline]
    pub(crate) fn is_hidden(&self, surface: &SurfaceHit, around: &Interiors) -> bool {
        self.material.priority.is_some()
            && surface.thing().is_some_and(|thing| around.hides(thing, self.material.priority))
    }

    /// What a ray in direction `dir` enters or leaves that passes as if there were no surface.
    pub(crate) fn straight_change(&self, surface: &SurfaceHit, dir: Vec3) -> Change {
        let is_boundary = self.material.interior.is_some() || self.material.priority.is_some();
        match surface.thing() {
            Some(thing) if is_boundary => {
                let enters = dir.dot(surface.hit.at.ng) < 0.0;
                if enters { Change::Enter(Inside::of(thing, self.material)) } else { Change::Leave(thing) }
            }
            _ => Change::None,
        }
    }

    /// What fills the body below the surface, where light is let in to walk there.
    pub(crate) fn below(&self, surface: &SurfaceHit) -> Option<PreparedMedium<'static>> {
        match &self.material.surface {
            Surface::Standard(standard) => Some(self.eval.below(standard, surface.color)),
            Surface::Phong(_) | Surface::Unlit(_) => None,
        }
    }

    /// Radiance that the surface gives off and that lights the scene, seen by a ray in direction `dir`.
    #[inline]
    pub(crate) fn emission(&self, surface: &SurfaceHit, dir: Vec3) -> Rgb {
        let emission = self.material.surface.emission();
        let is_dark = || !self.material.shines_back() && surface.hit.at.ng.dot(dir) > 0.0;
        if emission.is_zero() || is_dark() { Rgb::ZERO } else { self.eval.color(&emission) }
    }

    /// Radiance that is seen and lights nothing.
    pub(crate) fn glow(&self) -> Rgb {
        match &self.material.surface {
            Surface::Unlit(color) => self.tint * self.eval.color(color),
            Surface::Phong(_) | Surface::Standard(_) => Rgb::ZERO,
        }
    }

    /// Absorption on the way here of a ray in direction `dir` that leaves glass.
    #[inline]
    pub(crate) fn left_absorption(&self, surface: &SurfaceHit, dir: Vec3) -> Option<Rgb> {
        let leaves = dir.dot(surface.hit.at.ng) > 0.0 && self.material.surface.refracts();
        leaves.then(|| self.material.surface.absorption())
    }
}

impl<'a> PathPoint<'a> {
    /// The point where a ray in direction `dir` met what is covered. What must be worked out for this point stays in `room`.
    #[inline]
    pub(crate) fn new(
        world: &'a World<'_>,
        covering: &Covering<'a>,
        surface: &'a SurfaceHit,
        dir: Vec3,
        time: f32,
        around: &Interiors,
        room: &'a mut Option<Bsdf>,
    ) -> Self {
        let Covering { id, material, eval, .. } = covering;
        let normals = Normals::new(eval, material.relief, &surface.hit, dir);
        let frame = frame_along(normals.ns, surface.hit.dpdu);
        let around = Surroundings { ior: around.ior_beside(surface.thing()), walks: world.walks() };
        let known = world.known_bsdfs().get(*id, normals.enters);
        let known = known.filter(|_| surface.color.is_none() && around.ior == 1.0);
        let bsdf = known.unwrap_or_else(|| {
            let coat_normal = match material.surface.coat_relief() {
                None => Vec3::Z,
                Some(relief) => frame.to_local(Normals::new(eval, Some(relief), &surface.hit, dir).ns),
            };
            let (surface, color) = (&material.surface, surface.color);
            room.insert(Bsdf::new(surface, eval, color, normals.enters, coat_normal, around))
        });
        Self::with(world, material, surface, normals, frame, time, bsdf)
    }

    /// A white matte point where light comes out from below a surface, seen from outside.
    pub(crate) fn outside(
        world: &'a World<'_>,
        covering: &Covering<'a>,
        surface: &'a SurfaceHit,
        time: f32,
        room: &'a mut Option<Bsdf>,
    ) -> Self {
        let Covering { material, eval, .. } = covering;
        let normals = Normals::new(eval, material.relief, &surface.hit, -surface.hit.at.ng);
        let frame = frame_along(normals.ns, surface.hit.dpdu);
        Self::with(world, material, surface, normals, frame, time, room.insert(Bsdf::white()))
    }

    #[inline]
    fn with(
        world: &'a World<'_>,
        material: &'a Material,
        surface: &'a SurfaceHit,
        normals: Normals,
        frame: OrthonormalFrame,
        time: f32,
        bsdf: &'a Bsdf,
    ) -> Self {
        let wo = frame.to_local(normals.view);
        let sides = [normals.ng, normals.smooth];
        Self {
            surface,
            material,
            normals,
            horizon: Horizon::new(world, surface, sides, !normals.enters, time),
            frame,
            wo,
            time,
            view: bsdf.seen_from(wo),
            lead: None,
        }
    }

    /// The same, led by what was learnt.
    #[inline]
    pub(crate) fn led(self, guide: Option<&'a Guide>) -> Self {
        let lead = guide.and_then(|guide| guide.lead(self.surface.hit.at.p, self.view.breadth()));
        Self { lead, ..self }
    }

    /// How much likelier what leads paths on has made a draw than the surface alone.
    #[inline]
    pub(crate) fn likelier(&self, sample: &BsdfSample) -> f32 {
        match &self.lead {
            Some(lead) if !sample.is_delta() => lead.likelier(self.frame.to_world(sample.wi), sample.pdf),
            _ => 1.0,
        }
    }

    /// What leads paths on from here, beside the surface.
    pub(crate) fn lead(&self) -> Option<&Lead<'a>> {
        self.lead.as_ref()
    }

    /// What the layers show.
    pub(crate) fn first_hit(&self, object: u32, material: MaterialId) -> FirstHit {
        let hit = &self.surface.hit;
        FirstHit {
            p: hit.at.p,
            normal: self.normals.ns,
            albedo: self.view.albedo(),
            uv: hit.uv,
            object: Some(object),
            material: Some(material),
        }
    }

    /// Whether lights are worth asking.
    #[inline]
    pub(crate) fn scatters(&self) -> bool {
        self.view.scatters()
    }

    /// From where lights are asked.
    #[inline]
    pub(crate) fn lookout(&self) -> Lookout {
        let is_open = self.view.is_open();
        Lookout { p: self.horizon.start.p, n: self.normals.ns, time: self.time, is_open }
    }

    /// What is sent to the viewer of light from the unit direction `to_light`, times the cosine there, and the density with
    /// which [`PathPoint::sample`] draws it.
    #[inline]
    pub(crate) fn eval(&self, to_light: Vec3) -> (Rgb, f32) {
        let wi = self.frame.to_local(to_light);
        let share = self.share(wi, to_light);
        if share == 0.0 {
            return (Rgb::ZERO, 0.0);
        }
        let (value, pdf) = self.view.eval(wi);
        match &self.lead {
            Some(lead) if value != Rgb::ZERO => (share * value, lead.pdf(to_light, pdf)),
            _ => (share * value, pdf),
        }
    }

    /// The share of [`PathPoint::eval`] that is drawn as an [`Event::Diffuse`].
    pub(crate) fn matte(&self, to_light: Vec3) -> Rgb {
        let wi = self.frame.to_local(to_light);
        let (value, pdf) = self.view.eval(wi);
        if pdf > 0.0 { self.share(wi, to_light) * self.view.matte_pdf(wi) / pdf * value } else { Rgb::ZERO }
    }

    /// Whether any light is.
    #[inline]
    pub(crate) fn is_matte(&self) -> bool {
        self.view.is_matte()
    }

    /// What the flux of light that comes from the viewer and leaves by a smooth way is multiplied by, beside the weight that
    /// radiance has on the same way back: the ratio of the sizes under which the surface is seen, which differs from that of the
    /// shading normal, and that of the squared indices, because paths carry basic radiance.
    ///
    /// # Source
    /// Veach, "Robust Monte Carlo Methods for Light Transport Simulation", Stanford, 1997, sections 5.2 and 5.3.
    pub(crate) fn adjoint(&self, onward: &Onward, around: &Interiors) -> f32 {
        let Normals { view, ng, ns, enters, .. } = self.normals;
        let dir = onward.dir;
        let sizes = (dir.dot(ng) / view.dot(ng)).abs();
        let is_bent = onward.sample.wi.z < 0.0 && self.material.surface.encloses();
        if !is_bent {
            return sizes;
        }
        let ior = self.material.surface.ior() / around.ior_beside(self.surface.thing());
        let eta = if enters { ior } else { ior.recip() };
        sizes * (view.dot(ns) / dir.dot(ns)).abs() / (eta * eta)
    }

    /// A way on for a path that carries so much, by random numbers for the layer and the direction; `None` where the light is lost.
    #[inline]
    pub(crate) fn sample(&self, carried: Rgb, layer: f32, u: Vec2) -> Option<Onward> {
        let mut sample = match &self.lead {
            None => self.view.sample(carried, layer, u)?,
            Some(lead) => lead.sample(&self.view, &self.frame, carried, layer, u)?,
        };
        let dir = self.frame.to_world(sample.wi);
        if sample.is_delta() {
            return Some(self.smooth_way(sample, dir));
        }
        sample.weight *= self.share(sample.wi, dir);
        let is_lost = sample.weight == Rgb::ZERO;
        (!is_lost).then_some(Onward { dir, is_back: sample.wi.z > 0.0, is_straight: false, sample })
    }

    /// Sends a ray that was met here, and what it runs through, the way on.
    #[inline]
    pub(crate) fn send(&self, onward: &Onward, passing: &mut PassingRay, around: &mut Interiors) {
        let Onward { dir, is_back, sample, .. } = onward;
        let (is_smooth, met) = (sample.is_delta(), passing.cone_at(self.surface));
        let cone = if is_smooth { met } else { met.scattered(sample.pdf) };
        match (is_back, is_smooth) {
            (true, true) => passing.turn_back(self.surface, self.surface.hit.spawn(*dir)),
            (true, false) if self.horizon.lifted => passing.start_free(self.horizon.start.spawn(*dir)),
            (true, false) => passing.turn_back(self.surface, self.horizon.start.spawn(*dir)),
            (false, _) => {
                *passing = passing.behind(self.surface, *dir);
                around.change(&self.change_behind());
            }
        }
        passing.cone = cone;
    }

    /// The shadow ray to a target in the unit direction `to_light`.
    #[inline]
    pub(crate) fn shadow_ray(&self, to_light: Vec3, target: &Target) -> Ray {
        let is_behind = to_light.dot(self.normals.ns) < 0.0;
        let start = if is_behind { self.surface.hit.at } else { self.horizon.start };
        match target {
            Target::Sky => start.spawn(to_light),
            Target::Point(p) => start.spawn_to(*p),
            Target::Surface(at) => start.spawn_to_surface(at),
        }
    }

    /// The share of light from a direction that the shape of the surface lets in.
    #[inline]
    fn share(&self, wi: Vec3, dir: Vec3) -> f32 {
        if wi.z >= 0.0 {
            self.horizon.facing(dir)
        } else {
            f32::from(u8::from(dir.dot(self.normals.ng) < 0.0))
        }
    }

    /// The way of mirror and clear glass. A direction that a bent normal sent to the wrong side is folded back at the surface.
    fn smooth_way(&self, sample: BsdfSample, dir: Vec3) -> Onward {
        if sample.wi == -self.wo {
            let is_straight = self.material.surface.passes_straight();
            return Onward { dir: -self.normals.view, is_back: false, is_straight, sample };
        }
        let (height, is_back) = (dir.dot(self.normals.ng), sample.wi.z >= 0.0);
        let is_astray = (height > 0.0) != is_back;
        let dir = if is_astray { dir - 2.0 * height * self.normals.ng } else { dir };
        Onward { dir, is_back, is_straight: false, sample }
    }

    /// What a way through the surface enters or leaves.
    fn change_behind(&self) -> Change {
        let is_boundary = self.material.surface.encloses() || self.material.interior.is_some();
        match self.surface.thing() {
            Some(thing) if self.normals.enters && is_boundary => {
                Change::Enter(Inside::of(thing, self.material))
            }
            Some(thing) if !self.normals.enters => Change::Leave(thing),
            _ => Change::None,
        }
    }
}

/// The frame around `n` with x along a tangent; any x where there is no tangent.
#[inline]
fn frame_along(n: Vec3, tangent: Vec3) -> OrthonormalFrame {
    match (tangent - tangent.dot(n) * n).try_normalize() {
        Some(x) => OrthonormalFrame { x, y: n.cross(x), z: n },
        None => OrthonormalFrame::around(n),
    }
}
