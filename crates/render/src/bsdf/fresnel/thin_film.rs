//! Colours of thin films.

use super::{refraction, schlick};
use heliostat_scene::Rgb;
use std::f32::consts::{PI, TAU};

/// A film between air and a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Film {
    /// Index of refraction, at least 1.
    pub(crate) ior: f32,
    /// Thickness in nanometres.
    pub(crate) thickness: f32,
}

/// From this thickness in nanometres down the film fades into air, so that none at all is its limit.
const FADE: f32 = 30.0;

/// The most that the base may reflect at normal incidence: its index of refraction stays finite.
const MOST: f32 = 0.9999;

impl Film {
    /// The reflectance of film and base, for light from outside at an angle of cosine `cos`; `base` is the reflectance of the
    /// bare base at normal incidence.
    ///
    /// The sum over the ways to and fro between the two faces, up to twice, each with its phase; the spectrum is weighted
    /// by the eye in the domain of phases.
    ///
    /// # Source
    /// Belcour, Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", 2017,
    /// equations 3 to 8 without polarisation; Khronos, `KHR_materials_iridescence`.
    pub(crate) fn reflectance(&self, cos: f32, base: Rgb) -> Rgb {
        let share = (self.thickness / FADE).clamp(0.0, 1.0);
        let ior = 1.0 + (self.ior - 1.0) * share * share * (3.0 - 2.0 * share);
        let top = refraction(cos, ior);
        if top.cos == 0.0 {
            return Rgb::ONE;
        }
        let base_ior = base.map(|f0| (1.0 + f0.clamp(0.0, MOST).sqrt()) / (1.0 - f0.clamp(0.0, MOST).sqrt()));
        let ratio = base_ior / ior;
        let below = ratio.map(|eta| {
            let f0 = ((eta - 1.0) / (eta + 1.0)).powi(2);
            f0 + (1.0 - f0) * schlick(top.cos)
        });
        // A half wave is lost where the next matter is the denser one.
        let shift = ratio.map(|eta| if eta < 1.0 { PI } else { 0.0 }) + PI;
        let way = 2.0 * ior * self.thickness * top.cos;
        let passed = 1.0 - top.reflectance;
        let both = (top.reflectance * below).clamp(Rgb::ZERO, Rgb::splat(MOST));
        let inner = passed * passed * below / (Rgb::ONE - both);
        let mut sum = inner + top.reflectance;
        let mut order = inner - passed;
        for m in 1..=2 {
            order *= both.map(f32::sqrt);
            sum += 2.0 * order * eye(m as f32 * way, m as f32 * shift);
        }
        sum.clamp(Rgb::ZERO, Rgb::ONE)
    }
}

/// What the eye makes of waves that come late by `way` nanometres and `shift` radians, as linear red, green and blue; 1 for
/// waves in step.
///
/// The matching functions of CIE 1931 as Gaussians over the wave number, whose Fourier transforms are Gaussians again.
///
/// # Source
/// Belcour, Barla, 2017, supplemental material: constants per metre, here per nanometre and divided by the sum.
fn eye(way: f32, shift: Rgb) -> Rgb {
    const HEIGHT: Rgb = Rgb::new(0.846_59, 1.000_222, 1.001_122);
    const PLACE: Rgb = Rgb::new(0.001_681_0, 0.001_795_3, 0.002_208_4);
    const VARIANCE: Rgb = Rgb::new(0.000_000_004_327_8, 0.000_000_009_304_6, 0.000_000_006_612_1);
    const RED_HEIGHT: f32 = 0.153_868;
    const RED_PLACE: f32 = 0.002_239_9;
    const RED_VARIANCE: f32 = 0.000_000_004_528_2;
    let phase = TAU * way;
    let wave = |place: f32, variance: f32, shift: f32| {
        (place * phase + shift).cos() * (-variance * phase * phase).exp()
    };
    let mut xyz = Rgb::new(
        HEIGHT.x * wave(PLACE.x, VARIANCE.x, shift.x),
        HEIGHT.y * wave(PLACE.y, VARIANCE.y, shift.y),
        HEIGHT.z * wave(PLACE.z, VARIANCE.z, shift.z),
    );
    xyz.x += RED_HEIGHT * wave(RED_PLACE, RED_VARIANCE, shift.x);
    // To Rec.709; divided by what the same matrix makes of light with the same power at all wavelengths, which is white here.
    let rows = [
        Rgb::new(3.240_454_2, -1.537_138_5, -0.498_531_4),
        Rgb::new(-0.969_266, 1.876_010_8, 0.041_556),
        Rgb::new(0.055_643_4, -0.204_025_9, 1.057_225_2),
    ];
    Rgb::from_array(rows.map(|row| row.dot(xyz) / row.element_sum()))
}
