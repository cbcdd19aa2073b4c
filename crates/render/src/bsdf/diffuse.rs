//! Matte surfaces.

use glam::Vec3;
use heliostat_scene::Rgb;
use std::f32::consts::{FRAC_1_PI, PI};

/// A matte surface, smooth or rough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Matte {
    /// Share of the light that is sent back, in `[0, 1]`.
    pub(crate) color: Rgb,
    /// Roughness in `[0, 1]`; 0 is Lambert's surface.
    pub(crate) roughness: f32,
}

impl Matte {
    /// The distribution function `f`, times pi: the albedo for Lambert's surface.
    ///
    /// # Source
    /// Portsmouth, Kutz, Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 2025, listing 1: the model of
    /// Oren and Nayar as Fujii has it, and what it loses between the facets given back.
    pub(crate) fn times_pi(&self, wo: Vec3, wi: Vec3) -> Rgb {
        if self.roughness == 0.0 {
            return self.color;
        }
        let r = self.roughness;
        let once = self.color * scale(r) * (1.0 + r * lean(wo, wi));
        let room = self.missing_mean();
        let between = self.color * self.color * (1.0 - room) / (Rgb::ONE - self.color * room);
        once + between * self.missing(wo.z) * self.missing(wi.z) / room
    }
}

impl Matte {
    /// What facets of white matter send on at once, from light of which so much comes in and so much of it leaning.
    pub(crate) fn once(&self, all: Rgb, leaning: Rgb) -> Rgb {
        scale(self.roughness) * (all + self.roughness * leaning)
    }

    /// What they do not send on at once to a viewer at an angle of cosine `cos`.
    pub(crate) fn missing(&self, cos: f32) -> f32 {
        (1.0 - once_albedo(cos, self.roughness)).max(0.0)
    }

    /// The mean of that over the hemisphere.
    pub(crate) fn missing_mean(&self) -> f32 {
        1.0 - scale(self.roughness) * (1.0 + MEAN_SLOPE * self.roughness)
    }
}

/// How much more light of one direction is sent to another because facets face it: `s / t` of the model of Fujii.
pub(crate) fn lean(wo: Vec3, wi: Vec3) -> f32 {
    let s = wo.dot(wi) - wo.z * wi.z;
    if s > 0.0 { s / wo.z.max(wi.z) } else { s }
}

/// `1/2 - 2 / (3 pi)`.
const SLOPE: f32 = 0.5 - 2.0 / 3.0 * FRAC_1_PI;
/// `2/3 - 28 / (15 pi)`.
const MEAN_SLOPE: f32 = 2.0 / 3.0 - 28.0 / 15.0 * FRAC_1_PI;

/// `A` of the model of Fujii.
fn scale(r: f32) -> f32 {
    1.0 / (1.0 + SLOPE * r)
}

/// Share of the light that facets of white matter send on at once, for a viewer at an angle of cosine `cos`.
///
/// # Source
/// Portsmouth, Kutz, Hill, 2025, equation 19.
fn once_albedo(cos: f32, r: f32) -> f32 {
    let cos = cos.clamp(0.0, 1.0);
    let sin = (1.0 - cos * cos).sqrt();
    // `(1 - sin^3) / cos` without a quotient of small numbers: `1 - sin = cos^2 / (1 + sin)`.
    let flank = cos / (1.0 + sin) * (1.0 + sin + sin * sin);
    let g = sin * (cos.acos() - sin * cos) + 2.0 / 3.0 * (sin * flank - sin);
    scale(r) * (1.0 + r / PI * g)
}
