//! Fibres that stand up from the surface.

use glam::Vec3;
use std::f32::consts::TAU;

/// White fibres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sheen {
    /// Width of the distribution of fibres.
    alpha: f32,
    /// The fit of the masking function for that width.
    fit: [f32; 5],
}

/// The least roughness that is told from smaller ones: below, the lobe would be too narrow at grazing angles to be drawn.
const LEAST_ROUGHNESS: f32 = 0.1;

/// From a roughness in `[0, 1]` to the axis on which different ones lie.
pub(crate) fn roughness_axis(roughness: f32) -> f32 {
    ((roughness - LEAST_ROUGHNESS) / (1.0 - LEAST_ROUGHNESS)).clamp(0.0, 1.0)
}

/// The inverse of [`roughness_axis`].
#[cfg(test)]
pub(crate) fn axis_roughness(x: f32) -> f32 {
    LEAST_ROUGHNESS + (1.0 - LEAST_ROUGHNESS) * x
}

impl Sheen {
    /// `roughness` in `[0, 1]`; the width is its square.
    pub(crate) fn new(roughness: f32) -> Self {
        let alpha = roughness.max(LEAST_ROUGHNESS).powi(2);
        let share = (1.0 - alpha) * (1.0 - alpha);
        let mix = |rough: f32, smooth: f32| rough + (smooth - rough) * share;
        let fit = [
            mix(21.5473, 25.3245),
            mix(3.82987, 3.32435),
            mix(0.19823, 0.16801),
            mix(-1.97760, -1.27393),
            mix(-4.32054, -4.85967),
        ];
        Self { alpha, fit }
    }

    /// The value, both directions on the side of the normal.
    ///
    /// # Source
    /// Estevez, Kulla, "Production Friendly Microfacet Sheen BRDF", 2017, equations 2 to 4; Khronos,
    /// `KHR_materials_sheen`.
    pub(crate) fn single(&self, wo: Vec3, wi: Vec3) -> f32 {
        let h = (wo + wi).normalize_or(Vec3::Z);
        let power = 1.0 / self.alpha;
        let sin2 = (1.0 - h.z * h.z).max(0.0);
        let density = (2.0 + power) * sin2.powf(0.5 * power) / TAU;
        density / ((1.0 + self.hidden(wo.z) + self.hidden(wi.z)) * 4.0 * wo.z.max(f32::MIN_POSITIVE))
    }

    /// Area of the fibres that is hidden, over the area that is seen, at an angle of cosine `cos`.
    fn hidden(&self, cos: f32) -> f32 {
        if cos < 0.5 {
            self.log_hidden(cos).exp()
        } else {
            (2.0 * self.log_hidden(0.5) - self.log_hidden(1.0 - cos)).exp()
        }
    }

    fn log_hidden(&self, x: f32) -> f32 {
        let [a, b, c, d, e] = self.fit;
        a / (1.0 + b * x.max(0.0).powf(c)) + d * x + e
    }
}
