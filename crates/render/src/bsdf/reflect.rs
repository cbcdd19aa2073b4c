//! Light that rough boundaries reflect once.

use super::ggx::Ggx;
use glam::{Vec2, Vec3};

/// Mirrors `wo` at the normal of the surface.
pub(crate) fn mirrored(wo: Vec3) -> Vec3 {
    Vec3::new(-wo.x, -wo.y, wo.z)
}

/// The same direction on the other side of the surface.
pub(crate) fn mirrored_down(w: Vec3) -> Vec3 {
    Vec3::new(w.x, w.y, -w.z)
}

/// A facet that reflects light from `wi` towards `wo`, both on the side of the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Facet {
    h: Vec3,
    /// Cosine between the facet and either direction, in `[0, 1]`.
    pub(crate) cos: f32,
}

impl Facet {
    /// `None` where no facet does.
    pub(crate) fn between(wo: Vec3, wi: Vec3) -> Option<Self> {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return None;
        }
        let h = (wo + wi).try_normalize()?;
        Some(Self { h, cos: wo.dot(h).clamp(0.0, 1.0) })
    }

    /// Value for a boundary that reflects all light.
    ///
    /// # Source
    /// Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, equation 20.
    pub(crate) fn value(&self, ggx: &Ggx, wo: Vec3, wi: Vec3) -> f32 {
        0.5 * ggx.density(self.h) * wi.z * ggx.correlated(wo, wi)
    }

    /// Density of `wi` by [`sample_facet`].
    pub(crate) fn pdf(&self, ggx: &Ggx, wo: Vec3) -> f32 {
        ggx.reflecting_pdf(wo, self.h)
    }

    /// Density of `wi` where facets are drawn as they are seen.
    pub(crate) fn seen_pdf(&self, ggx: &Ggx, wo: Vec3) -> f32 {
        ggx.density(self.h) / (2.0 * (wo.z + ggx.stretched(wo)))
    }
}

/// Draws a direction for [`Facet`]; `None` below the surface.
pub(crate) fn sample_facet(ggx: &Ggx, wo: Vec3, u: Vec2) -> Option<Vec3> {
    let h = ggx.visible_reflecting(wo, u);
    let wi = (2.0 * wo.dot(h) * h - wo).normalize_or_zero();
    (wi.z > 0.0).then_some(wi)
}
