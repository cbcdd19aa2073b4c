//! The report's surface as one that makes no light: a matte layer, a highlight, a mirror and clear glass, in shares.
//!
//! The colours of the report are taken for albedos: `diffuse` is Lambert's, and the highlight is divided by what it would send
//! on at normal incidence. Where the shares add up to more than 1, all are scaled down together.
//!
//! # Source
//! Lafortune, Willems, "Using the Modified Phong Reflectance Model for Physically Based Rendering", Report CW 197, KU Leuven,
//! 1994.

use super::{BsdfSample, Event};
use crate::material_eval::PhongPoint;
use crate::phong::{fresnel, power};
use glam::{Vec2, Vec3};
use heliostat_geometry::OrthonormalFrame;
use heliostat_geometry::warp::square_to_cosine_hemisphere;
use heliostat_scene::Rgb;
use heliostat_scene::color::luminance;
use heliostat_scene::material::FresnelMode;
use std::f32::consts::{FRAC_1_PI, TAU};

/// The report's surface at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PhongBsdf {
    diffuse: Rgb,
    specular: Rgb,
    shininess: f32,
    mirror: Rgb,
    transparency: Rgb,
    /// Index on the viewer's side over the index behind.
    eta: f32,
    fresnel: FresnelMode,
    /// Probabilities with which matte layer, highlight and the rest are drawn; the rest is mirror and glass.
    odds: [f32; 2],
}

/// What smooth mirror and clear glass send on for one viewer.
#[derive(Clone, Copy, Debug)]
struct Split {
    mirror: Rgb,
    glass: Rgb,
    /// Where the refracted light comes from.
    through: Vec3,
}

impl PhongBsdf {
    /// The surface where a ray meets it, from outside if it `enters`.
    #[inline]
    pub(crate) fn new(point: &PhongPoint, enters: bool) -> Self {
        let sum = point.diffuse + point.specular + point.mirror + point.transparency;
        let scale = 1.0 / sum.max_element().max(1.0);
        let (diffuse, specular) = (scale * point.diffuse, scale * point.specular);
        let (mirror, transparency) = (scale * point.mirror, scale * point.transparency);
        // Draw each layer as often as it matters.
        let (matte, highlight) = (weight(diffuse), weight(specular));
        let all = matte + highlight + weight(mirror + transparency);
        let odds = if all > 0.0 { [matte / all, highlight / all] } else { [0.0; 2] };
        let eta = if enters { 1.0 / point.ior } else { point.ior };
        Self {
            diffuse,
            specular,
            shininess: point.shininess,
            mirror,
            transparency,
            eta,
            fresnel: point.fresnel,
            odds,
        }
    }

    /// A matte surface of an albedo.
    pub(crate) fn matte(albedo: Rgb) -> Self {
        Self {
            diffuse: albedo,
            specular: Rgb::ZERO,
            shininess: 0.0,
            mirror: Rgb::ZERO,
            transparency: Rgb::ZERO,
            eta: 1.0,
            fresnel: FresnelMode::Off,
            odds: [if albedo == Rgb::ZERO { 0.0 } else { 1.0 }, 0.0],
        }
    }

    #[inline]
    pub(crate) fn scatters(&self) -> bool {
        self.odds[0] + self.odds[1] > 0.0
    }

    /// See [`super::View::matte_pdf`].
    #[inline]
    pub(crate) fn matte_pdf(&self, wi: Vec3) -> f32 {
        self.odds[0] * FRAC_1_PI * wi.z.max(0.0)
    }

    #[inline]
    pub(crate) fn is_matte(&self) -> bool {
        self.odds[0] > 0.0
    }

    /// See [`super::View::breadth`].
    #[inline]
    pub(crate) fn breadth(&self) -> f32 {
        // The roughness of facets with a highlight of that width, as Walter et al. 2007 have it.
        self.odds[0] + self.odds[1] * (2.0 / (self.shininess + 2.0)).sqrt().sqrt()
    }

    pub(crate) fn albedo(&self) -> Rgb {
        self.diffuse + self.mirror + self.transparency
    }

    #[inline]
    pub(crate) fn eval(&self, wo: Vec3, wi: Vec3) -> (Rgb, f32) {
        if wi.z <= 0.0 {
            return (Rgb::ZERO, 0.0);
        }
        let cosine = FRAC_1_PI * wi.z;
        let (mut value, mut pdf) = (cosine * self.diffuse, cosine * self.odds[0]);
        if self.odds[1] > 0.0 {
            let lobe = power(mirrored(wo).dot(wi), self.shininess) / TAU;
            value += (self.shininess + 2.0) * lobe * wi.z * self.specular;
            pdf += (self.shininess + 1.0) * lobe * self.odds[1];
        }
        (value, pdf)
    }

    #[inline]
    pub(crate) fn sample(&self, wo: Vec3, layer: f32, u: Vec2) -> Option<BsdfSample> {
        let [matte, highlight] = self.odds;
        let (wi, event) = if layer < matte {
            (square_to_cosine_hemisphere(u), Event::Diffuse)
        } else if layer < matte + highlight {
            (self.in_lobe(wo, u), Event::Glossy)
        } else {
            return self.sample_smooth(wo, (layer - matte - highlight) / (1.0 - matte - highlight));
        };
        let (value, pdf) = self.eval(wo, wi);
        (pdf > 0.0).then(|| BsdfSample { wi, weight: value / pdf, pdf, event })
    }

    /// A direction around the mirror direction with density by the power of the cosine; it may lie below the surface.
    fn in_lobe(&self, wo: Vec3, u: Vec2) -> Vec3 {
        let cos = u.x.powf(1.0 / (self.shininess + 1.0));
        let ring = (1.0 - cos * cos).max(0.0).sqrt();
        let around = ring * Vec2::from_angle(TAU * u.y);
        OrthonormalFrame::around(mirrored(wo)).to_world(around.extend(cos))
    }

    /// The mirror direction or the refracted one, by `choice` in `[0, 1)`.
    fn sample_smooth(&self, wo: Vec3, choice: f32) -> Option<BsdfSample> {
        let split = self.split(wo);
        let odds = weight(split.mirror) / (weight(split.mirror) + weight(split.glass));
        // Share of all draws that come here.
        let here = 1.0 - self.odds[0] - self.odds[1];
        let (wi, value, share, event) = if choice < odds {
            (mirrored(wo), split.mirror, here * odds, Event::Glossy)
        } else {
            (split.through, split.glass, here * (1.0 - odds), Event::Transmission)
        };
        let is_drawn = share > 0.0 && value != Rgb::ZERO;
        is_drawn.then(|| BsdfSample { wi, weight: value / share, pdf: f32::INFINITY, event })
    }

    /// The weights of mirror and glass as Whitted has them.
    fn split(&self, wo: Vec3) -> Split {
        let sin2 = self.eta * self.eta * (1.0 - wo.z * wo.z).max(0.0);
        if sin2 >= 1.0 || self.transparency == Rgb::ZERO {
            // Total internal reflection: the mirror gets all.
            return Split { mirror: self.mirror + self.transparency, glass: Rgb::ZERO, through: -wo };
        }
        let cos = (1.0 - sin2).sqrt();
        let reflected = match self.fresnel {
            FresnelMode::Off => 0.0,
            FresnelMode::Dielectric => fresnel(wo.z, cos, self.eta),
        };
        let through = if self.eta == 1.0 { -wo } else { Vec3::new(-self.eta * wo.x, -self.eta * wo.y, -cos) };
        Split {
            mirror: self.mirror + reflected * self.transparency,
            glass: (1.0 - reflected) * self.transparency,
            through,
        }
    }

    #[inline]
    pub(crate) fn straight(&self, wo: Vec3) -> Rgb {
        if self.eta == 1.0 { self.split(wo).glass } else { Rgb::ZERO }
    }
}

/// The mirror direction.
#[inline]
fn mirrored(wo: Vec3) -> Vec3 {
    Vec3::new(-wo.x, -wo.y, wo.z)
}

/// How much a share matters: green for the eye, but no channel for nothing.
#[inline]
fn weight(share: Rgb) -> f32 {
    0.5 * (luminance(share) + share.max_element())
}
