//! Rough boundaries: the distribution of microfacets of Trowbridge and Reitz, called GGX.
//!
//! Facets shadow and hide each other as Smith has it, with heights of both directions correlated. Everything is written with
//! the length of the stretched direction `|(ax wx, ay wy, wz)|`, so that nothing is divided by the cosine of a grazing one.
//!
//! # Source
//! Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007; Heitz, "Understanding the
//! Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 2014 (anisotropy: section 5.4, correlation: equation 99).

use glam::{Vec2, Vec3};
use heliostat_geometry::error_bound;
use std::f32::consts::{FRAC_1_PI, TAU};

/// Widths of the distribution along two tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ggx {
    /// Widths, in `[error_bound::LEAST_WIDTH, 1]`.
    alpha: Vec2,
    /// Cosine and sine of the turn from x to the first tangent.
    tangent: Vec2,
}

impl Ggx {
    /// `None` for a surface so smooth that it is a mirror. `roughness` and `anisotropy` are in `[0, 1]`, and `tangent` is the
    /// unit direction along which the highlight is drawn out.
    ///
    /// # Source
    /// Khronos, `KHR_materials_anisotropy`: `alpha_t = mix(alpha, 1, strength^2)`, `alpha_b = alpha`.
    pub(crate) fn new(roughness: f32, anisotropy: f32, tangent: Vec2) -> Option<Self> {
        let alpha = roughness * roughness;
        let along = alpha + (1.0 - alpha) * anisotropy * anisotropy;
        let is_rough = along.max(alpha) >= error_bound::LEAST_WIDTH;
        is_rough.then(|| Self {
            alpha: Vec2::new(along, alpha).max(Vec2::splat(error_bound::LEAST_WIDTH)),
            tangent,
        })
    }

    /// The same width along all tangents; at least that of which rounding leaves something.
    pub(crate) fn isotropic(alpha: f32) -> Self {
        Self { alpha: Vec2::splat(alpha.max(error_bound::LEAST_WIDTH)), tangent: Vec2::X }
    }

    /// Width of an isotropic distribution that loses about as much light.
    pub(crate) fn mean_alpha(&self) -> f32 {
        (self.alpha.x * self.alpha.y).sqrt()
    }

    /// A distribution of width `alpha`, drawn out along x by `strength` in `[0, 1]`.
    #[cfg(test)]
    pub(crate) fn stretched_by(alpha: f32, strength: f32) -> Self {
        let along = alpha + (1.0 - alpha) * strength * strength;
        Self { alpha: Vec2::new(along, alpha), tangent: Vec2::X }
    }

    /// Of these widths along x and y.
    #[cfg(test)]
    pub(crate) fn of_widths(alpha: Vec2) -> Self {
        Self { alpha, tangent: Vec2::X }
    }

    /// By what strength [`Self::stretched_by`] gives the larger width.
    pub(crate) fn strength(&self) -> f32 {
        let room = 1.0 - self.alpha.y;
        if room > 0.0 { ((self.alpha.x - self.alpha.y) / room).sqrt() } else { 0.0 }
    }

    /// Widths along the tangents; the first is the larger one.
    pub(crate) fn alpha(&self) -> Vec2 {
        self.alpha
    }

    /// The first tangent, in the tangent plane.
    pub(crate) fn tangent(&self) -> Vec2 {
        self.tangent
    }

    /// Width in the plane of the normal and `w`.
    pub(crate) fn width_along(&self, w: Vec3) -> f32 {
        (self.turned(w).truncate().normalize_or(Vec2::X) * self.alpha).length()
    }

    /// How far the width in the plane of the normal and `w` is from the smaller to the larger one, where these differ.
    pub(crate) fn turn_of(&self, w: Vec3) -> f32 {
        ((self.width_along(w) - self.alpha.y) / (self.alpha.x - self.alpha.y)).clamp(0.0, 1.0)
    }

    /// The direction in the tangent plane whose [`Self::turn_of`] is `turn`.
    pub(crate) fn along(&self, turn: f32) -> Vec2 {
        let width = self.alpha.y + turn * (self.alpha.x - self.alpha.y);
        let sin2 = (1.0 - turn) * (self.alpha.x + width) / (self.alpha.x + self.alpha.y);
        Vec2::new((1.0 - sin2).max(0.0).sqrt(), sin2.sqrt()).rotate(self.tangent)
    }

    /// Whether all tangents are alike.
    pub(crate) fn is_isotropic(&self) -> bool {
        self.alpha.x == self.alpha.y
    }

    /// From the frame of the surface to that of the tangents.
    fn turned(&self, w: Vec3) -> Vec3 {
        if self.is_isotropic() {
            return w;
        }
        let back = Vec2::new(self.tangent.x, -self.tangent.y);
        back.rotate(w.truncate()).extend(w.z)
    }

    /// Density of facets whose normal is `h`, per steradian and area of the surface.
    pub(crate) fn density(&self, h: Vec3) -> f32 {
        let slope = self.turned(h).truncate() / self.alpha;
        let d = slope.length_squared() + h.z * h.z;
        // One half after the other, so that neither product leaves the range of numbers.
        (FRAC_1_PI / (self.alpha.x * d)) / (self.alpha.y * d)
    }

    /// Length of a direction stretched as the facets are flattened.
    pub(crate) fn stretched(&self, w: Vec3) -> f32 {
        (self.turned(w).truncate() * self.alpha).extend(w.z).length()
    }

    /// By how much [`Self::stretched`] exceeds the height, to its last digits.
    #[cfg(test)]
    fn excess(&self, w: Vec3) -> f32 {
        let flat = (self.turned(w).truncate() * self.alpha).length_squared();
        let sum = self.stretched(w) + w.z.abs();
        if sum > 0.0 { flat / sum } else { 0.0 }
    }

    /// Share of the facets seen from `wo` that do not see `wi`: `1 - G2 / G1`, to its last digits where that is small.
    ///
    /// `wi` may be on the other side, where heights count as if it were on this one.
    #[cfg(test)]
    pub(crate) fn hidden(&self, wo: Vec3, wi: Vec3) -> f32 {
        wo.z * self.excess(wi) * self.correlated(wo, wi)
    }

    /// `G2 |wi.z| / |wo.z|`, up to the factor 2 `|wi.z|`: `1 / (|wi.z| |So| + |wo.z| |Si|)`.
    pub(crate) fn correlated(&self, wo: Vec3, wi: Vec3) -> f32 {
        let sum = wi.z.abs() * self.stretched(wo) + wo.z.abs() * self.stretched(wi);
        if sum > 0.0 { 1.0 / sum } else { 0.0 }
    }

    /// A facet that `wo` sees, in proportion to the area that is seen of it.
    ///
    /// # Source
    /// Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 2018; in the form of Dupuy, Benyoub, "Sampling Visible
    /// GGX Normals with Spherical Caps", HPG 2023.
    pub(crate) fn visible(&self, wo: Vec3, u: Vec2) -> Vec3 {
        self.capped(wo, u, 1.0)
    }

    /// The same without most of those that would reflect below the surface.
    ///
    /// # Source
    /// Eto, Tokuyoshi, "Bounded VNDF Sampling for Smith-GGX Reflections", SIGGRAPH Asia 2023, listing 1.
    pub(crate) fn visible_reflecting(&self, wo: Vec3, u: Vec2) -> Vec3 {
        self.capped(wo, u, self.bound(wo))
    }

    /// Density of `wi` by [`Self::visible_reflecting`], for the facet `h` between `wo` and `wi`.
    pub(crate) fn reflecting_pdf(&self, wo: Vec3, h: Vec3) -> f32 {
        self.density(h) / (2.0 * (self.bound(wo) * wo.z + self.stretched(wo)))
    }

    /// One less value over density of `wi` by [`Self::visible_reflecting`], for facets that reflect all light: to its last
    /// digits where that is small.
    #[cfg(test)]
    pub(crate) fn hidden_reflecting(&self, wo: Vec3, wi: Vec3) -> f32 {
        // How much the cap shrinks: 1 - k of the paper.
        let a2 = self.alpha.min_element().powi(2);
        let s2 = (1.0 + wo.truncate().length()).powi(2);
        let shrunk = a2 * (wo.z * wo.z + s2) / (s2 + a2 * wo.z * wo.z);
        wo.z * (self.excess(wi) + shrunk * wi.z) * self.correlated(wo, wi)
    }

    /// Density of `h` by [`Self::visible`], where `cos` is its scalar product with `wo`.
    pub(crate) fn visible_pdf(&self, wo: Vec3, h: Vec3, cos: f32) -> f32 {
        2.0 * cos * self.density(h) / (wo.z + self.stretched(wo))
    }

    /// By how much the spherical cap of visible normals shrinks: `k` of the paper.
    fn bound(&self, wo: Vec3) -> f32 {
        let a2 = self.alpha.min_element().powi(2);
        let s2 = (1.0 + wo.truncate().length()).powi(2);
        (1.0 - a2) * s2 / (s2 + a2 * wo.z * wo.z)
    }

    fn capped(&self, wo: Vec3, u: Vec2, bound: f32) -> Vec3 {
        let wo = self.turned(wo);
        let flat = (wo.truncate() * self.alpha).extend(wo.z).normalize_or(Vec3::Z);
        let floor = bound * flat.z;
        let z = (1.0 - u.y) * (1.0 + floor) - floor;
        let ring = (1.0 - z * z).max(0.0).sqrt();
        let h = (ring * Vec2::from_angle(TAU * u.x)).extend(z) + flat;
        let h = (h.truncate() * self.alpha).extend(h.z.max(0.0)).normalize_or(Vec3::Z);
        if self.is_isotropic() { h } else { self.tangent.rotate(h.truncate()).extend(h.z) }
    }
}
