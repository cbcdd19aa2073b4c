//! Light that goes through: refracted by a rough boundary, or let through by a thin wall.
//!
//! What is carried is basic radiance, `L / n^2`, which does not change where light crosses a boundary: the factor `n^2` by
//! which radiance itself is squeezed cancels between going in and coming out, and a light inside of glass keeps its colour.
//! So no weight here holds an index of refraction, and in a closed furnace the sum is 1. For the same reason the kernels of
//! both sides are those of each other times `eta^2`.

use super::ggx::Ggx;
use glam::Vec3;
use heliostat_scene::Rgb;

/// The direction into which light that is seen along `wo` was bent at the facet `h`.
///
/// `cos` and `cos_other` are the cosines on this and the other side, `eta` the index of the other side over that of this one.
pub(crate) fn refract(wo: Vec3, h: Vec3, cos: f32, cos_other: f32, eta: f32) -> Vec3 {
    (cos / eta - cos_other) * h - wo / eta
}

/// A facet that bends light from `wi` towards `wo`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bend {
    h: Vec3,
    /// Cosine between the facet and `wo`, above 0.
    pub(crate) cos: f32,
    /// Area that directions `h` have per area of directions `wi`.
    squeeze: f32,
}

impl Bend {
    /// `None` where no facet does.
    ///
    /// # Source
    /// Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, equations 16 and 17.
    pub(crate) fn between(wo: Vec3, wi: Vec3, eta: f32) -> Option<Self> {
        let h = (wo + eta * wi).try_normalize()?;
        let h = if h.z < 0.0 { -h } else { h };
        let (cos, other) = (wo.dot(h), wi.dot(h));
        let length = cos + eta * other;
        let squeeze = eta * eta * -other / (length * length);
        (cos > 0.0 && other < 0.0 && squeeze.is_finite()).then_some(Self { h, cos, squeeze })
    }

    /// Value for a boundary that lets all light pass.
    ///
    /// # Source
    /// Walter et al., 2007, equation 21, for basic radiance.
    pub(crate) fn value(&self, ggx: &Ggx, wo: Vec3, wi: Vec3) -> f32 {
        2.0 * ggx.density(self.h) * self.cos * wi.z.abs() * ggx.correlated(wo, wi) * self.squeeze
    }

    /// Density of `wi` where facets are drawn as they are seen.
    pub(crate) fn pdf(&self, ggx: &Ggx, wo: Vec3) -> f32 {
        ggx.visible_pdf(wo, self.h, self.cos) * self.squeeze
    }
}

/// The direction of [`Bend`] at the facet `h`, which meets `wo` at an angle of cosine `cos`; `None` where it reflects all, or
/// bends light back to its own side.
pub(crate) fn bent(wo: Vec3, h: Vec3, cos: f32, eta: f32) -> Option<Vec3> {
    let other = super::fresnel::refraction(cos, eta).cos;
    let wi = refract(wo, h, cos, other, eta).normalize_or_zero();
    (cos > 0.0 && other > 0.0 && wi.z < 0.0).then_some(wi)
}

/// What a sheet reflects and lets through, with all reflections between its faces: `face` is the reflectance of each, and
/// `tint` what is left after one passage.
///
/// # Source
/// Stokes, "On the Intensity of the Light Reflected from or Transmitted through a Pile of Plates", 1862.
pub(crate) fn sheet(face: Rgb, tint: Rgb) -> (Rgb, Rgb) {
    let (face, tint) = (face.min(Rgb::ONE), tint.min(Rgb::ONE));
    let passed = (Rgb::ONE - face) * (Rgb::ONE - face);
    let bounced = Rgb::ONE - face * face * tint * tint;
    // Where both faces reflect all and nothing is lost between them, nothing gets in.
    let through = Rgb::select(bounced.cmpgt(Rgb::ZERO), passed * tint / bounced, Rgb::ZERO);
    (face + through * face * tint, through)
}
