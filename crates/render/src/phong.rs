//! Phong's local light and the directions of mirror and glass.
//!
//! # Source
//! Phong, "Illumination for Computer Generated Pictures", CACM 1975; Whitted, "An Improved Illumination Model for Shaded
//! Display", CACM 1980.

use crate::material_eval::PhongPoint;
use glam::Vec3;
use heliostat_scene::Rgb;

/// `ln 2^40`: a highlight ends forty stops below its peak, far below what the eye, or half a float, sees beside it.
const FORTY_STOPS: f32 = 27.73;

impl PhongPoint {
    /// The radiance towards `view` for one unit of light from `to_light`; all unit vectors, `n` on the side of `view`.
    ///
    /// Zero for light from behind.
    #[inline]
    pub(crate) fn answer(&self, n: Vec3, to_light: Vec3, view: Vec3) -> Rgb {
        let cos = n.dot(to_light);
        if cos <= 0.0 {
            return Rgb::ZERO;
        }
        let diffuse = cos * self.diffuse;
        if self.specular == Rgb::ZERO {
            return diffuse;
        }
        let r_dot_v = 2.0 * cos * n.dot(view) - to_light.dot(view);
        diffuse + power(r_dot_v, self.shininess) * self.specular
    }
}

/// `max(x, 0)^n` for `x` up to 1; 0 where that is below 2^-40.
#[inline]
pub(crate) fn power(x: f32, n: f32) -> f32 {
    if is_dark(x, n) { 0.0 } else { x.min(1.0).powf(n) }
}

/// Whether [`power`] is 0 for `x` and everything below.
#[inline]
pub(crate) fn is_dark(x: f32, n: f32) -> bool {
    // ln x <= x - 1, so x^n <= exp(-n (1 - x)).
    x <= 0.0 || n * (1.0 - x) > FORTY_STOPS
}

/// The mirror direction of the unit direction `dir` at a surface with unit normal `n`.
pub(crate) fn reflect(dir: Vec3, n: Vec3) -> Vec3 {
    dir - 2.0 * dir.dot(n) * n
}

/// A refracted direction with what the Fresnel equations need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Refraction {
    /// Unit direction behind the surface.
    pub(crate) dir: Vec3,
    /// Cosine of the angle of refraction.
    pub(crate) cos: f32,
}

/// Snell's law as vectors: `dir` unit, `n` unit and against `dir`, `eta` the index before over the index behind.
///
/// `None` is total internal reflection. No angle is ever worked out, so nothing can leave the domain of an inverse sine.
pub(crate) fn refract(dir: Vec3, n: Vec3, eta: f32) -> Option<Refraction> {
    let cos_in = -dir.dot(n);
    let sin2_out = eta * eta * (1.0 - cos_in * cos_in).max(0.0);
    if sin2_out >= 1.0 {
        return None;
    }
    let cos = (1.0 - sin2_out).sqrt();
    Some(Refraction { dir: (eta * dir + (eta * cos_in - cos) * n).normalize(), cos })
}

/// The share of unpolarised light that a dielectric surface reflects, by the cosine of the angle at which it arrives.
#[inline(always)]
pub(crate) fn fresnel_at(cos_in: f32, eta: f32) -> f32 {
    let sin2_out = eta * eta * (1.0 - cos_in * cos_in).max(0.0);
    let reflected = fresnel(cos_in, (1.0 - sin2_out).max(0.0).sqrt(), eta);
    if sin2_out < 1.0 { reflected } else { 1.0 }
}

/// The share of unpolarised light that a dielectric surface reflects, by both cosines.
///
/// # Source
/// Fresnel's equations, as in Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 9.3.5; `eta` is the
/// index before over the index behind.
#[inline(always)]
pub(crate) fn fresnel(cos_in: f32, cos_out: f32, eta: f32) -> f32 {
    let parallel = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
    let perpendicular = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}
