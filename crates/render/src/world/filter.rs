//! Things that let light through on its way: cut-outs and, as an option, glass.

use super::blocker::Chords;
use super::body::{Body, SurfaceAt};
use crate::bsdf::{Bsdf, Surroundings};
use crate::lanes::{LANES, Mask, Vec3Lanes, holds, lanes_of, widest};
use crate::material_eval::MaterialEval;
use crate::normals::Normals;
use crate::phong::fresnel_at;
use crate::texture_eval::TexturePoint;
use glam::Vec3;
use heliostat_geometry::{Ray, Transform};
use heliostat_scene::material::{FresnelMode, Phong, Surface};
use heliostat_scene::{Material, Object, Rgb, Scene};
use pulp::NullaryFnOnce;

/// Which transparent surfaces let light through on its straight way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Clear {
    /// None.
    Nothing,
    /// All, coloured, whether or not they bend it.
    All,
    /// Those that do not bend it.
    Unbending,
}

impl Clear {
    /// Whether a surface is one of them.
    pub(super) fn holds(self, surface: &Surface) -> bool {
        match self {
            Self::Nothing => false,
            Self::All => surface.refracts(),
            Self::Unbending => surface.passes_straight(),
        }
    }
}

/// One thing that lets light through.
#[derive(Clone, Copy, Debug)]
pub(super) struct Filter<'a> {
    pub(super) scene: &'a Scene,
    pub(super) object: &'a Object,
    /// Which transparent surfaces let light through.
    pub(super) clear: Clear,
}

/// What a surface does to light that goes through.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pane {
    /// Share that passes straight through what is cut away.
    open: f32,
    /// Share that passes what is there, reflection aside.
    glass: Rgb,
    /// Index before over the index behind; `None` for a surface that does not reflect.
    eta: Option<f32>,
    /// Absorption per metre behind it.
    absorption: Rgb,
}

/// What is left of the light after some surfaces.
struct Passed {
    share: Rgb,
    /// Absorption times way.
    absorbed: Vec3,
    /// Absorption times the number of surfaces that it has entered and not left: below 0 for a ray that starts inside.
    open: Vec3,
    /// Absorption behind the last surface.
    absorption: Rgb,
}

impl Filter<'_> {
    /// The share of the light of `ray` that passes all surfaces of the thing.
    pub(super) fn share(&self, ray: &Ray, body: &Body<'_>, place: &Transform) -> Rgb {
        let (absorbed, open, absorption) = (Vec3::ZERO, Vec3::ZERO, Rgb::ZERO);
        let mut passed = Passed { share: Rgb::ONE, absorbed, open, absorption };
        let is_done = self.plain().is_some_and(|pane| {
            body.each_crossing(place, ray, |t, n| passed.through(ray, t, n, pane.seen(ray, n)))
        });
        if !is_done {
            body.each_surface(place, ray, |surface| {
                let hit = &surface.hit;
                let seen = match self.clear {
                    Clear::Unbending => self.unbent(&surface, ray),
                    Clear::Nothing | Clear::All => self.pane_at(&surface).seen(ray, hit.ns),
                };
                passed.through(ray, hit.t, hit.at.ng, seen);
            });
        }
        let depth = ray.dir.length() * passed.depth(ray.range.max);
        if depth == Vec3::ZERO { passed.share } else { passed.share * (-depth).exp() }
    }

    /// The surface where it is the same everywhere on the thing.
    pub(super) fn plain(&self) -> Option<Pane> {
        let material: &Material = &self.scene.materials[self.object.material(0).index()];
        let phong = &*material.surface.phong();
        let is_plain = material.opacity.texture.is_none()
            && phong.transparency.texture.is_none()
            && self.clear != Clear::Unbending;
        is_plain.then(|| self.pane(material.opacity.factor.clamp(0.0, 1.0), phong.transparency.factor, phong))
    }

    /// The surface in one place.
    fn pane_at(&self, surface: &SurfaceAt) -> Pane {
        let material: &Material = &self.scene.materials[self.object.material(surface.slot).index()];
        let eval = self.eval_at(surface);
        let phong = &*material.surface.phong();
        self.pane(eval.opacity(material), eval.color(&phong.transparency), phong)
    }

    fn eval_at(&self, surface: &SurfaceAt) -> MaterialEval<'_> {
        let SurfaceAt { hit, uv1, local, coverage, .. } = *surface;
        let at = TexturePoint { uv1, coverage, ..TexturePoint::plain(hit.uv, local) };
        MaterialEval { textures: &self.scene.textures, at }
    }

    /// What the surface itself lets through without a bend, and its absorption.
    fn unbent(&self, surface: &SurfaceAt, ray: &Ray) -> (Rgb, Rgb) {
        let material: &Material = &self.scene.materials[self.object.material(surface.slot).index()];
        let eval = self.eval_at(surface);
        let opacity = eval.opacity(material);
        let open = Rgb::splat(1.0 - opacity);
        if opacity == 0.0 || !material.surface.passes_straight() {
            return (open, Rgb::ZERO);
        }
        let normals = Normals::new(&eval, material.relief, &surface.hit, ray.dir);
        let around = Surroundings::OPEN;
        let bsdf = Bsdf::new(&material.surface, &eval, surface.color, normals.enters, Vec3::Z, around);
        let cos = normals.ns.dot(normals.view);
        let view = Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
        (open + opacity * bsdf.seen_from(view).straight(), material.surface.absorption())
    }

    fn pane(&self, opacity: f32, transparency: Rgb, phong: &Phong) -> Pane {
        let open = 1.0 - opacity;
        if self.clear == Clear::Nothing || phong.transparency.is_zero() {
            return Pane { open, glass: Rgb::ZERO, eta: None, absorption: Rgb::ZERO };
        }
        let eta = (phong.fresnel == FresnelMode::Dielectric).then(|| 1.0 / phong.ior);
        Pane { open, glass: opacity * transparency, eta, absorption: phong.absorption }
    }
}

impl Passed {
    /// Goes through a surface at `t` with normal `ng` that lets through a share and absorbs behind it.
    ///
    /// The way inside is the sum of `t` where the ray leaves, minus those where it enters: it needs no order.
    fn through(&mut self, ray: &Ray, t: f32, ng: Vec3, (share, absorption): (Rgb, Rgb)) {
        let sign = if ray.dir.dot(ng) > 0.0 { 1.0 } else { -1.0 };
        self.share *= share;
        self.absorbed += sign * t * absorption;
        self.open -= sign * absorption;
        self.absorption = absorption;
    }

    /// Absorption times way of a ray that ends at `end`, in lengths of the ray.
    fn depth(&self, end: f32) -> Vec3 {
        if !end.is_finite() {
            return self.absorbed.max(Vec3::ZERO);
        }
        let depth = self.absorbed + end * self.open.max(Vec3::ZERO);
        // Less than nothing: it starts inside, leaves and comes back, and ends inside.
        let ends_inside = depth.cmplt(Vec3::ZERO);
        Vec3::select(ends_inside, depth + end * self.absorption, depth).max(Vec3::ZERO)
    }
}

impl Pane {
    /// The share that passes along a ray that meets it where its normal is `ns`, and its absorption.
    fn seen(&self, ray: &Ray, ns: Vec3) -> (Rgb, Rgb) {
        (self.share(ray.dir.dot(ns).abs() / ray.dir.length()), self.absorption)
    }

    /// The share that passes at an angle with that cosine, seen from outside.
    #[inline(always)]
    fn share(&self, cos: f32) -> Rgb {
        let reflected = self.eta.map_or(0.0, |eta| fresnel_at(cos, eta));
        self.open + (1.0 - reflected) * self.glass
    }

    /// Multiplies the shares of the rays `asked`, of those that meet a sphere, by what passes it.
    pub(super) fn filter_chords(&self, chords: &Chords, asked: Mask, shares: &mut Vec3Lanes) {
        let hit = chords.verdict.hit & asked;
        if hit != 0 {
            widest(FilterChords { pane: self, chords, hit, shares });
        }
        if self.absorption != Rgb::ZERO {
            for lane in lanes_of(hit) {
                shares.set(lane, shares.get(lane) * (-chords.way[lane] * self.absorption).exp());
            }
        }
    }
}

/// The work of [`Pane::filter_chords`], absorption aside.
struct FilterChords<'a> {
    pane: &'a Pane,
    chords: &'a Chords,
    hit: Mask,
    shares: &'a mut Vec3Lanes,
}

impl NullaryFnOnce for FilterChords<'_> {
    type Output = ();

    #[expect(clippy::needless_range_loop, reason = "a lane is a number")]
    #[inline(always)]
    fn call(self) {
        let Self { pane, chords, hit, shares } = self;
        let Pane { open, glass, eta, .. } = *pane;
        let mut kept = [1.0; LANES];
        if let Some(eta) = eta {
            (0..LANES).for_each(|i| kept[i] -= fresnel_at(chords.cos_squared[i].sqrt(), eta));
        }
        let from_inside = chords.from_inside;
        for i in 0..LANES {
            let once = open + kept[i] * glass;
            let through = if from_inside { once } else { once * once };
            shares.set(i, shares.get(i) * if holds(hit, i) { through } else { Rgb::ONE });
        }
    }
}
