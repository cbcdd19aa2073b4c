//! The Khronos PBR Neutral tone mapper.
//!
//! # Source
//! Khronos Group, "PBR Neutral Tone Mapping Specification", 2024, the formula of section "Specification".

use glam::Vec3;

/// Fresnel reflection of a dielectric at normal incidence, taken off so that base colours come out as authored.
const F90_START: f32 = 0.04;
/// Where compression starts.
const START: f32 = 0.8 - F90_START;
/// Speed of the way to white.
const DESATURATION: f32 = 0.15;

/// Linear light (not negative) to linear display light.
pub(super) fn form(light: Vec3) -> Vec3 {
    let darkest = light.min_element();
    let offset = if darkest < 2.0 * F90_START { darkest - 6.25 * darkest * darkest } else { F90_START };
    let color = light - offset;
    let peak = color.max_element();
    if peak < START {
        return color;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let compressed = color * (new_peak / peak);
    let whiteness = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    compressed.lerp(Vec3::splat(new_peak), whiteness)
}
