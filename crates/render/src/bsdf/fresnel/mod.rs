//! How much of the light a smooth boundary reflects.

mod conductor;
mod dielectric;
mod metal;
mod thin_film;

pub(crate) use dielectric::{Boundary, refraction};
pub(crate) use metal::Metal;
pub(crate) use thin_film::Film;

/// Schlick's factor from the reflectance at normal incidence (0) to that at grazing angles (1).
///
/// # Source
/// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994, equation 15.
pub(crate) fn schlick(cos: f32) -> f32 {
    let x = (1.0 - cos).clamp(0.0, 1.0);
    let x2 = x * x;
    x2 * x2 * x
}
