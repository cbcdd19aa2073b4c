//! Light that facets of rough glass throw at each other until it leaves on either side.

use super::base::Base;
use super::fill::Sides;
use crate::bsdf::fresnel::Affine;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::table::{Interface, Loss, Reflection};
use glam::Vec3;
use heliostat_scene::Rgb;

/// What is lost at one scattering, shared between both sides.
///
/// With the loss `l` of this side and that of the other times `eta^2`, the kernel between two sides is `c l l / pi`. Light is
/// kept on both sides when `c_same m_this + c_across m_other = 1`, with the means `m` of the losses, and the same with both
/// sides swapped; how much goes across is free, and taken to be what smooth glass lets through, as far as there is room for
/// it on both sides.
///
/// # Source
/// Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", 2017, pages 21 to 24, for the demand; the share is ours.
#[derive(Clone, Copy, Debug)]
pub(super) struct GlassFill {
    /// Share of the surface.
    weight: f32,
    tint: Rgb,
    sides: [Side; 2],
    /// Kernel to the same side, and across.
    same: Rgb,
    across: Rgb,
    is_dispersed: bool,
    stretch: Stretch,
}

/// One side of the boundary.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// Per channel; the first one for all where nothing is dispersed.
    interfaces: [Interface; 3],
    affine: [Affine; 3],
    /// Square of the index of refraction over that of the viewer's side.
    squeeze: Rgb,
}

impl Side {
    /// `scale` is that of [`Loss::with`].
    fn gather(&self, is_dispersed: bool, scale: f32, loss: impl Fn(&Interface) -> Loss) -> Rgb {
        let channel = |k: usize| loss(&self.interfaces[k]).with(&self.affine[k], scale);
        if !is_dispersed {
            return self.squeeze * channel(0);
        }
        self.squeeze * Rgb::new(channel(0).x, channel(1).y, channel(2).z)
    }
}

impl GlassFill {
    pub(super) fn new(base: &Base, reflection: &Reflection) -> Self {
        let eta = base.clear.eta();
        let affine = base.clear.channels.map(|boundary| boundary.affine());
        let alpha = base.ggx.map_or(0.0, |ggx| ggx.mean_alpha());
        let stretch = Stretch::new(base, reflection);
        let side = |eta: Rgb, squeeze: Rgb| Side {
            interfaces: eta.to_array().map(|eta| Interface::of(alpha, eta)),
            affine,
            squeeze,
        };
        let sides = [side(eta, Rgb::ONE), side(Rgb::ONE / eta, eta * eta)];
        let is_dispersed = base.clear.is_dispersed;
        let floor = Rgb::splat(f32::MIN_POSITIVE);
        let mean = |side: &Side| {
            side.gather(is_dispersed, stretch.mean(), |interface| interface.loss_mean()).max(floor)
        };
        let (here, there) = (mean(&sides[0]), mean(&sides[1]));
        let smooth = Rgb::ONE - mean_reflectance(&affine[1], eta.y);
        let across = smooth / here.max(there);
        let same = (Rgb::ONE - across * there).max(Rgb::ZERO) / here;
        Self { weight: base.glass_share(), tint: base.tint, sides, same, across, is_dispersed, stretch }
    }

    /// The distribution function times pi.
    pub(super) fn times_pi(&self, wo: Vec3, wi: Vec3) -> Rgb {
        let [here, there] = &self.sides;
        let loss = |side: &Side, w: Vec3| {
            side.gather(self.is_dispersed, self.stretch.at(w), |interface| interface.loss(w.z.abs()))
        };
        let kernel =
            if wi.z > 0.0 { self.same * loss(here, wi) } else { self.tint * self.across * loss(there, wi) };
        self.weight * loss(here, wo) * kernel
    }

    /// What is sent to a viewer in all.
    pub(super) fn albedo(&self, wo: Vec3) -> Sides {
        let [here, there] = &self.sides;
        let lost = self.weight
            * here.gather(self.is_dispersed, self.stretch.at(wo), |interface| interface.loss(wo.z));
        let mean = |side: &Side| {
            side.gather(self.is_dispersed, self.stretch.mean(), |interface| interface.loss_mean())
        };
        Sides { up: lost * self.same * mean(here), down: lost * self.tint * self.across * mean(there) }
    }
}

/// How much more is lost where highlights are drawn out: taken to be the same for glass as for a mirror.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    /// The distribution, and one of the same mean width along all tangents; `None` where they are the same.
    both: Option<[Reflection; 2]>,
}

impl Stretch {
    fn new(base: &Base, reflection: &Reflection) -> Self {
        let drawn_out = base.ggx.filter(|ggx| !ggx.is_isotropic());
        let even = |ggx: Ggx| Reflection::of(Some(Ggx::isotropic(ggx.mean_alpha())));
        Self { both: drawn_out.map(|ggx| [*reflection, even(ggx)]) }
    }

    fn at(&self, w: Vec3) -> f32 {
        self.both.map_or(1.0, |[drawn_out, even]| ratio(drawn_out.lost(w), even.lost(w)))
    }

    fn mean(&self) -> f32 {
        self.both.map_or(1.0, |[drawn_out, even]| ratio(drawn_out.lost_mean(), even.lost_mean()))
    }
}

fn ratio(a: f32, b: f32) -> f32 {
    if b > 0.0 { a / b } else { 1.0 }
}

/// The mean reflectance over the hemisphere from the side of the smaller index, weighted by the cosine.
///
/// # Source
/// d'Eon, "A Hitchhiker's Guide to Multiple Scattering", 2016, as used by Kulla and Conty.
fn mean_reflectance(affine: &Affine, eta: f32) -> Rgb {
    let ior = eta.max(1.0 / eta);
    let exact = (ior - 1.0) / (4.085_67 + 1.000_71 * ior);
    let (constant, factor) = affine.line();
    (constant + factor * exact).clamp(Rgb::ZERO, Rgb::ONE)
}
