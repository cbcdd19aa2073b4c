//! A hit with all that shading asks of it: its normals turned to the viewer, and its material evaluated.

use crate::horizon::Horizon;
use crate::integrator::FirstHit;
use crate::light::direct::LitPoint;
use crate::material_eval::{MaterialEval, PhongPoint};
use crate::phong::{fresnel, reflect, refract};
use crate::world::{SurfaceHit, World};
use glam::Vec3;
use heliostat_scene::material::{FresnelMode, Surface};
use heliostat_scene::{Material, MaterialId, Rgb};

/// A surface point seen from one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadingPoint<'a> {
    surface: &'a SurfaceHit,
    /// Whether the ray comes from outside, by the side of the geometric normal that it comes from.
    pub(crate) enters: bool,
    /// Unit direction to the viewer.
    view: Vec3,
    /// Geometric normal on the viewer's side.
    ng: Vec3,
    /// Interpolated normal on the side of `ng`.
    smooth: Vec3,
    /// `smooth` bent by the relief, on the viewer's side.
    ns: Vec3,
    time: f32,
    /// Coverage.
    pub(crate) opacity: f32,
    pub(crate) material: &'a Material,
    /// The material here.
    pub(crate) phong: PhongPoint,
}

/// How a surface hands on what a ray shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Split {
    /// Weight of the mirror direction.
    pub(crate) mirror: Rgb,
    /// Mirror direction.
    pub(crate) mirror_dir: Vec3,
    /// Weight and direction behind the surface; `None` with total reflection or without glass.
    pub(crate) glass: Option<(Rgb, Vec3)>,
}

impl<'a> ShadingPoint<'a> {
    /// The point where a ray in direction `dir` met an object with that material.
    pub(crate) fn new(
        world: &World<'a>,
        surface: &'a SurfaceHit,
        material: MaterialId,
        dir: Vec3,
        time: f32,
    ) -> Self {
        let scene = world.scene();
        let material = &scene.materials[material.index()];
        let at = surface.texture_point();
        let eval = MaterialEval { textures: &scene.textures, at };

        // Turn both normals to the viewer by the one that knows the sides.
        let view = -dir.normalize();
        let enters = view.dot(surface.hit.at.ng) >= 0.0;
        let side = if enters { 1.0 } else { -1.0 };
        let (ng, smooth) = (side * surface.hit.at.ng, side * surface.hit.ns);
        let bent = side * eval.bent_normal(material.relief, &surface.hit, surface.hit.ns);
        let mut phong = eval.phong(&material.surface.phong(), surface.color);
        match (&material.surface, surface.color) {
            (Surface::Unlit(_), color) => phong.emission *= color.unwrap_or(Rgb::ONE),
            _ if !enters && !material.shines_back() => phong.emission = Rgb::ZERO,
            _ => {}
        }
        Self {
            surface,
            enters,
            view,
            ng,
            smooth,
            ns: towards(bent, view),
            time,
            opacity: eval.opacity(material),
            material,
            phong,
        }
    }

    /// Absorption on the way here when the ray leaves glass.
    pub(crate) fn left_absorption(&self) -> Option<Rgb> {
        (!self.enters && self.phong.transparency != Rgb::ZERO).then_some(self.phong.absorption)
    }

    /// What the layers show.
    pub(crate) fn first_hit(&self, object: u32, material: MaterialId) -> FirstHit {
        FirstHit {
            p: self.surface.hit.at.p,
            normal: self.ns,
            albedo: self.phong.albedo(),
            uv: self.surface.hit.uv,
            object: Some(object),
            material: Some(material),
        }
    }

    /// The point for the light that falls on the viewer's side.
    pub(crate) fn lit(&self, world: &World<'_>) -> LitPoint<'_> {
        let horizon = Horizon::new(world, self.surface, [self.ng, self.smooth], !self.enters, self.time);
        LitPoint {
            horizon,
            departure: horizon.start.departure(),
            ns: self.ns,
            view: self.view,
            phong: &self.phong,
            casters: world.casters(&horizon.start, self.surface.object()),
            time: self.time,
        }
    }

    /// The weights and directions of mirror and glass.
    pub(crate) fn split(&self) -> Split {
        let dir = -self.view;
        let mirror_dir = self.kept_above(reflect(dir, self.ns));
        let phong = &self.phong;
        if phong.transparency == Rgb::ZERO {
            return Split { mirror: phong.mirror, mirror_dir, glass: None };
        }
        let eta = if self.enters { 1.0 / phong.ior } else { phong.ior };
        let Some(refraction) = refract(dir, self.ns, eta) else {
            // Total internal reflection: the mirror gets all.
            return Split { mirror: phong.mirror + phong.transparency, mirror_dir, glass: None };
        };
        let reflected = match phong.fresnel {
            FresnelMode::Off => 0.0,
            FresnelMode::Dielectric => fresnel(self.ns.dot(self.view), refraction.cos, eta),
        };
        Split {
            mirror: phong.mirror + reflected * phong.transparency,
            mirror_dir,
            glass: Some(((1.0 - reflected) * phong.transparency, -self.kept_above(-refraction.dir))),
        }
    }

    /// A direction on the viewer's side of the surface: one that a bent normal sent below is folded back at the surface.
    fn kept_above(&self, dir: Vec3) -> Vec3 {
        let height = dir.dot(self.ng);
        if height < 0.0 { dir - 2.0 * height * self.ng } else { dir }
    }
}

/// The normal nearest to `n` that does not turn its back on the viewer.
pub(crate) fn towards(n: Vec3, view: Vec3) -> Vec3 {
    let cos = n.dot(view);
    if cos >= 0.0 { n } else { (n - cos * view).try_normalize().unwrap_or(view) }
}
