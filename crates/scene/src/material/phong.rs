//! The report's surface.

use super::input::{ColorInput, FloatInput};
use crate::color::Rgb;
use crate::ids::TextureId;

/// How the weights of mirror and transparency follow the angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FresnelMode {
    /// The weights are as given at every angle: the report's model.
    #[default]
    Off,
    /// The dielectric Fresnel equations share `transparency` between refraction and reflection.
    Dielectric,
}

/// The report's surface: Phong's local light, plus a mirror and a transparent part.
///
/// Radiance is
///
/// ```text
/// emission + ambient * Ia
///   + sum over lights of Li * (diffuse * max(n.l, 0) + specular * max(r.v, 0)^shininess)
///   + mirror * reflected + transparency * refracted
/// ```
///
/// where each transparent metre inside is weighted by `exp(-absorption)`.
///
/// Where paths are traced, colours are shares of the light: `diffuse` is the albedo of a Lambert surface, so that a lamp of the
/// same irradiance seems weaker by pi, and `specular` that of a highlight without its falling off at grazing angles. `ambient` is not
/// looked at. Shares that add up to more than 1 are scaled down together.
///
/// # Source
/// Phong, "Illumination for Computer Generated Pictures", CACM 1975; Whitted, "An Improved Illumination Model for
/// Shaded Display", CACM 1980.
#[derive(Clone, Debug, PartialEq)]
pub struct Phong {
    /// Ka.
    pub ambient: ColorInput,
    /// Kd.
    pub diffuse: ColorInput,
    /// Ks.
    pub specular: ColorInput,
    /// n, at least 0.
    pub shininess: FloatInput,
    /// Ke: radiance that the surface gives off by itself; lights the scene too.
    pub emission: ColorInput,
    /// Weight of the mirror direction.
    pub mirror: ColorInput,
    /// Weight of the refracted direction.
    pub transparency: ColorInput,
    /// Index of refraction of the inside relative to the outside, above 0.
    pub ior: f32,
    /// Absorption inside per metre and channel.
    pub absorption: Rgb,
    /// Angular behaviour of mirror and transparency.
    pub fresnel: FresnelMode,
}

impl Default for Phong {
    fn default() -> Self {
        Self {
            ambient: ColorInput::constant(Rgb::splat(0.1)),
            diffuse: ColorInput::constant(Rgb::splat(0.7)),
            specular: ColorInput::default(),
            shininess: FloatInput::constant(32.0),
            emission: ColorInput::default(),
            mirror: ColorInput::default(),
            transparency: ColorInput::default(),
            ior: 1.5,
            absorption: Rgb::ZERO,
            fresnel: FresnelMode::Off,
        }
    }
}

impl Phong {
    /// A surface that answers no light.
    pub const DARK: Self = Self {
        ambient: ColorInput::constant(Rgb::ZERO),
        diffuse: ColorInput::constant(Rgb::ZERO),
        specular: ColorInput::constant(Rgb::ZERO),
        shininess: FloatInput::constant(32.0),
        emission: ColorInput::constant(Rgb::ZERO),
        mirror: ColorInput::constant(Rgb::ZERO),
        transparency: ColorInput::constant(Rgb::ZERO),
        ior: 1.5,
        absorption: Rgb::ZERO,
        fresnel: FresnelMode::Off,
    };

    /// See [`super::Material::each_texture`].
    pub(super) fn each_texture(&mut self, visit: &mut impl FnMut(&mut TextureId)) {
        let Self { ambient, diffuse, specular, emission, mirror, transparency, shininess, .. } = self;
        let colors = [ambient, diffuse, specular, emission, mirror, transparency];
        let textures = colors.map(|input| &mut input.texture).into_iter().chain([&mut shininess.texture]);
        textures.flatten().for_each(visit);
    }
}
