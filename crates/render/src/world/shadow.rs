//! What is left of light on its way: solid things stop it, cut-outs and (as an option) glass let a part through.

use super::hull::Hull;
use super::level::Candidates;
use super::shaft::Shaft;
use super::solid::{Solid, SurfaceAt};
use super::{Shadow, World};
use crate::material_eval::MaterialEval;
use crate::phong::fresnel_at;
use crate::texture_eval::TexturePoint;
use glam::Vec3;
use heliostat_geometry::{Ray, SurfacePoint};
use heliostat_scene::material::{FresnelMode, Phong, Surface};
use heliostat_scene::{Material, Object, Rgb, Scene};

impl World<'_> {
    /// Whether something that lets no light through lies in the range of the ray.
    pub fn occluded(&self, ray: &Ray, time: f32) -> bool {
        self.is_stopped(ray, time, Candidates::All)
    }

    /// The share of light that comes along a ray past everything that throws shadows.
    ///
    /// Light goes straight on: glass colours it by `transparency` at each surface and by its absorption inside, but does
    /// not bend it.
    pub fn transmittance(&self, ray: &Ray, time: f32) -> Rgb {
        self.transmittance_past(ray, time, Candidates::All)
    }

    /// What may stop rays that leave a surface point, to the side of its normal, for a light in the hull `light`.
    ///
    /// `own` is the object that the point is on.
    pub(crate) fn blockers(&self, start: &SurfacePoint, own: Option<u32>, light: Hull) -> Candidates {
        // A ray starts at most so far from the point.
        let moved = 2.0 * start.p_err.element_sum();
        let shaft = Shaft::new(start.p, moved, light);
        let own = own.filter(|&own| self.solids[own as usize].is_left_by_rays(start));
        self.level.candidates(|i| {
            self.shadows[i as usize] != Shadow::None
                && own != Some(i)
                && self.solids[i as usize].may_block(&shaft)
        })
    }

    /// [`World::transmittance`] where only the candidates can stop the light.
    #[inline]
    pub(crate) fn transmittance_past(&self, ray: &Ray, time: f32, candidates: Candidates) -> Rgb {
        if self.is_stopped(ray, time, candidates) {
            Rgb::ZERO
        } else if self.has_filters {
            self.filtered(ray, time, candidates)
        } else {
            Rgb::ONE
        }
    }

    #[inline]
    fn is_stopped(&self, ray: &Ray, time: f32, candidates: Candidates) -> bool {
        self.level.any(ray, candidates, |i, ray| {
            self.shadows[i as usize] == Shadow::Solid && self.solids[i as usize].blocks(ray, time)
        })
    }

    /// The share that passes the things that let light through.
    fn filtered(&self, ray: &Ray, time: f32, candidates: Candidates) -> Rgb {
        let mut share = Rgb::ONE;
        self.level.each(ray, candidates, |i| {
            if self.shadows[i as usize] == Shadow::Filter && share != Rgb::ZERO {
                let object = &self.scene.objects[i as usize];
                let filter = Filter { scene: self.scene, object, ray, glass: self.glass };
                share *= filter.share(&self.solids[i as usize], time);
            }
        });
        share
    }
}

/// One thing that lets light through, and the light.
struct Filter<'a> {
    scene: &'a Scene,
    object: &'a Object,
    ray: &'a Ray,
    /// Whether transparent surfaces let light through.
    glass: bool,
}

/// What is left of the light after some surfaces.
struct Passed {
    share: Rgb,
    /// Absorption times way.
    absorbed: Vec3,
    /// Absorption that goes on at the end of the ray.
    open: Vec3,
}

impl Passed {
    /// Goes through a surface at `t` that lets a share through, with an absorption behind it.
    ///
    /// The way inside is the sum of `t` where the ray leaves, minus those where it enters: it needs no order.
    fn through(&mut self, t: f32, leaves: bool, (share, absorption): (Rgb, Rgb)) {
        let sign = if leaves { 1.0 } else { -1.0 };
        self.share *= share;
        self.absorbed += sign * t * absorption;
        self.open -= sign * absorption;
    }
}

impl Filter<'_> {
    /// The share of light that passes all surfaces of the thing.
    fn share(&self, solid: &Solid<'_>, time: f32) -> Rgb {
        let mut passed = Passed { share: Rgb::ONE, absorbed: Vec3::ZERO, open: Vec3::ZERO };
        let leaves = |n: Vec3| self.ray.dir.dot(n) > 0.0;
        let is_done = self.plain().is_some_and(|(opacity, transparency, phong)| {
            solid.each_crossing(self.ray, time, |t, n| {
                passed.through(t, leaves(n), self.passing(opacity, transparency, phong, n));
            })
        });
        if !is_done {
            solid.each_surface(self.ray, time, |surface| {
                let at_surface = self.at_surface(&surface);
                passed.through(surface.hit.t, leaves(surface.hit.at.ng), at_surface);
            });
        }
        let Passed { share, mut absorbed, open } = passed;
        if self.ray.range.max.is_finite() {
            absorbed += self.ray.range.max * open;
        }
        let depth = self.ray.dir.length() * absorbed.max(Vec3::ZERO);
        if depth == Vec3::ZERO { share } else { share * (-depth).exp() }
    }

    /// Opacity and transparency where they are the same everywhere on the thing.
    fn plain(&self) -> Option<(f32, Rgb, &Phong)> {
        let material: &Material = &self.scene.materials[self.object.material(0).index()];
        let Surface::Phong(phong) = &material.surface;
        let is_plain = material.opacity.texture.is_none() && phong.transparency.texture.is_none();
        is_plain.then_some((material.opacity.factor.clamp(0.0, 1.0), phong.transparency.factor, phong))
    }

    /// The share that passes one surface, and the absorption behind it.
    fn at_surface(&self, surface: &SurfaceAt) -> (Rgb, Rgb) {
        let material: &Material = &self.scene.materials[self.object.material(surface.slot).index()];
        let at = TexturePoint { uv: surface.hit.uv, local: surface.local };
        let eval = MaterialEval { textures: &self.scene.textures, at };
        let Surface::Phong(phong) = &material.surface;
        self.passing(eval.opacity(material), eval.color(&phong.transparency), phong, surface.hit.ns)
    }

    /// The share that passes a surface with unit normal `n`, and the absorption behind it.
    fn passing(&self, opacity: f32, transparency: Rgb, phong: &Phong, n: Vec3) -> (Rgb, Rgb) {
        if !self.glass || phong.transparency.is_zero() {
            return (Rgb::splat(1.0 - opacity), Rgb::ZERO);
        }
        let glass = transparency * (1.0 - self.reflected(phong, n));
        (Rgb::splat(1.0 - opacity) + opacity * glass, phong.absorption)
    }

    /// The share that a surface with unit normal `n` reflects, seen from outside.
    fn reflected(&self, phong: &Phong, n: Vec3) -> f32 {
        if phong.fresnel == FresnelMode::Off {
            return 0.0;
        }
        let cos = self.ray.dir.dot(n).abs() / self.ray.dir.length();
        fresnel_at(cos, 1.0 / phong.ior)
    }
}
