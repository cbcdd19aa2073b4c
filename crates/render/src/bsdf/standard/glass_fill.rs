//! Light that facets of rough glass throw at each other until it leaves on either side.

use super::base::Base;
use super::fill::Sides;
use super::spread::Spread;
use crate::bsdf::fresnel::refraction;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::table::{Curve, Losses, Place, Reflection};
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
#[derive(Clone, Debug)]
pub(super) struct GlassFill {
    /// Share of the surface.
    weight: f32,
    tint: Rgb,
    here: Side,
    there: Side,
    /// Kernel to the same side, and across.
    same: Rgb,
    across: Rgb,
}

/// One side of the boundary.
#[derive(Clone, Debug)]
struct Side {
    loss: Losses,
    /// Square of the index of refraction over that of the viewer's side.
    squeeze: Rgb,
    /// Of loss and square.
    mean: Rgb,
}

impl Side {
    fn new(ggx: &Ggx, reflection: &Reflection, rays: &[(f32, Curve)], squeeze: Rgb) -> Self {
        let loss = Losses::new(ggx, rays);
        let mean = squeeze * loss.mean(reflection);
        Self { mean: mean.max(Rgb::splat(f32::MIN_POSITIVE)), squeeze, loss }
    }

    fn loss(&self, place: &Place) -> Rgb {
        self.squeeze * self.loss.at(place)
    }
}

impl GlassFill {
    pub(super) fn new(base: &Base, ggx: &Ggx, reflection: &Reflection) -> Self {
        let count = if base.clear.is_dispersed { 3 } else { 1 };
        let rays: Vec<(f32, Curve)> = base.clear.channels[..count]
            .iter()
            .map(|boundary| {
                let eta = boundary.eta();
                // Over the cosine on the side of the smaller index.
                let near = |cos: f32| if eta < 1.0 { refraction(cos, 1.0 / eta).cos } else { cos };
                (eta, Curve::new(|cos| boundary.reflectance(near(cos))))
            })
            .collect();
        let back: Vec<(f32, Curve)> = rays.iter().map(|(eta, curve)| (1.0 / eta, *curve)).collect();
        let eta = base.clear.eta();
        let here = Side::new(ggx, reflection, &rays, Rgb::ONE);
        let there = Side::new(ggx, reflection, &back, eta * eta);
        let mean = |k: usize| rays[k.min(count - 1)].1.cosine_mean()[k];
        let smooth = Rgb::ONE - Rgb::new(mean(0), mean(1), mean(2));
        let across = smooth / here.mean.max(there.mean);
        let same = (Rgb::ONE - across * there.mean).max(Rgb::ZERO) / here.mean;
        Self { weight: base.glass_share(), tint: base.tint, here, there, same, across }
    }

    /// How directions are drawn on this side and the other, by what is lost near the horizon.
    pub(super) fn spreads(&self, low: &Place) -> (Spread, Spread) {
        let spread = |side: &Side| Spread::towards_horizon((side.loss(low) / side.mean).max_element());
        (spread(&self.here), spread(&self.there))
    }

    /// What is lost of light from this side.
    pub(super) fn lost(&self, place: &Place) -> Rgb {
        self.here.loss(place)
    }

    /// The distribution function times pi, for light of which so much is lost towards the viewer, from the same or the other
    /// side.
    pub(super) fn times_pi(&self, lost: Rgb, place: &Place, is_up: bool) -> Rgb {
        let kernel = if is_up {
            self.same * self.here.loss(place)
        } else {
            self.tint * self.across * self.there.loss(place)
        };
        self.weight * lost * kernel
    }

    /// What is sent in all to a viewer towards whom so much is lost.
    pub(super) fn albedo(&self, lost: Rgb) -> Sides {
        let lost = self.weight * lost;
        Sides {
            up: lost * self.same * self.here.mean,
            down: lost * self.tint * self.across * self.there.mean,
        }
    }
}
