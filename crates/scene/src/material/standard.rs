//! The physically based surface: one description for metals, plastics, glass, cloth and skin-thin things.

use super::Relief;
use super::input::{ColorInput, FloatInput};
use super::phong::{FresnelMode, Phong};
use crate::color::Rgb;
use crate::ids::TextureId;

/// The sharpest highlight of one of the report's surfaces that stands for another; a mirror beyond it.
const MOST_SHINE: f32 = 20_000.0;

/// A measured metal: its complex index of refraction `n + ik` at the wavelengths of red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Index of refraction per channel, above 0.
    pub n: Rgb,
    /// Extinction per channel, at least 0.
    pub k: Rgb,
}

/// A film over the surface, thin enough that both of its faces interfere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinFilm {
    /// Share of the surface that it covers, in `[0, 1]`.
    pub weight: FloatInput,
    /// Index of refraction of the film, at least 1.
    pub ior: f32,
    /// Thickness in nanometres beyond `least`: a texture spreads it over `least..=least + factor`.
    pub thickness: FloatInput,
    /// Thickness in nanometres where the texture is black.
    pub least: f32,
}

impl Default for ThinFilm {
    fn default() -> Self {
        Self {
            weight: FloatInput::constant(0.0),
            ior: 1.3,
            thickness: FloatInput::constant(400.0),
            least: 0.0,
        }
    }
}

/// A physically based surface of layers, from the top: coat, sheen, and a base that is metal, glass or matte in shares.
///
/// The base is `mix(dielectric, metal, metalness)`; under the reflection of the dielectric lies
/// `mix(mix(diffuse, diffuse transmission), refraction, transmission)`. Every layer takes from those below it what it sends
/// back itself, so no light is made. The roughness of a highlight is perceptual: the width of the distribution of microfacets
/// is its square.
///
/// # Source
/// Khronos, "glTF 2.0", appendix B, and its material extensions; Academy Software Foundation, "`OpenPBR` Surface 1.1".
#[derive(Clone, Debug, PartialEq)]
pub struct Standard {
    /// Albedo of the matte part, reflection of metal at normal incidence, tint of refracted light; in `[0, 1]`.
    pub base_color: ColorInput,
    /// Roughness of the matte part in `[0, 1]`: 0 is Lambert's.
    pub diffuse_roughness: FloatInput,
    /// Share of metal, in `[0, 1]`.
    pub metalness: FloatInput,
    /// Tint of metal at an angle of about 82 degrees, in `[0, 1]`: 1 is Schlick's curve.
    pub edge_color: ColorInput,
    /// What the metal is, in place of `base_color` and `edge_color`.
    pub conductor: Option<Conductor>,
    /// Roughness of reflection and refraction, in `[0, 1]`: 0 is a mirror.
    pub roughness: FloatInput,
    /// Weight of the reflection of the dielectric, in `[0, 1]`.
    pub specular: FloatInput,
    /// Tint of that reflection at normal incidence, at least 0.
    pub specular_color: ColorInput,
    /// Index of refraction of the inside relative to the outside, above 0.
    pub ior: f32,
    /// How far highlights are drawn out along the tangent, in `[0, 1]`.
    pub anisotropy: FloatInput,
    /// Turn of the tangent in radians, counter-clockwise.
    pub anisotropy_rotation: f32,
    /// Direction in the tangent plane: red and green from 0..1 to -1..1, turned by `anisotropy_rotation`.
    pub anisotropy_direction: Option<TextureId>,
    /// Share of the light under the reflection that is refracted, in `[0, 1]`.
    pub transmission: FloatInput,
    /// Whether the surface is a sheet without an inside: light that is refracted leaves in the direction in which it came.
    pub thin_walled: bool,
    /// Absorption inside per metre and channel, at least 0.
    pub absorption: Rgb,
    /// `20 / V_d`, where `V_d` is the Abbe number; 0 for glass without colours.
    pub dispersion: f32,
    /// Share of the matte part whose light leaves on the other side, in `[0, 1]`.
    pub diffuse_transmission: FloatInput,
    /// Tint of that light, in `[0, 1]`.
    pub diffuse_transmission_color: ColorInput,
    /// Share of the matte part whose light walks below the surface and comes out elsewhere, in `[0, 1]`. The surface must close;
    /// integrators that do not follow light below surfaces show it as matte in `subsurface_color`.
    pub subsurface: FloatInput,
    /// The colour that a thick body of that matter has, in `[0, 1]`.
    pub subsurface_color: ColorInput,
    /// How far light flies from one scattering to the next, in metres and per channel, above 0: the mean free path.
    pub subsurface_radius: Rgb,
    /// Mean cosine of the angle by which light is scattered there, above -1 and below 1.
    pub subsurface_anisotropy: f32,
    /// Share of the surface under a clear coat, in `[0, 1]`.
    pub coat: FloatInput,
    /// Roughness of the coat, in `[0, 1]`.
    pub coat_roughness: FloatInput,
    /// Index of refraction of the coat, at least 1.
    pub coat_ior: f32,
    /// Bends the normal of the coat.
    pub coat_relief: Option<Relief>,
    /// Reflection of fibres that stand up, per channel in `[0, 1]`.
    pub sheen_color: ColorInput,
    /// How far the fibres lean, in `[0, 1]`.
    pub sheen_roughness: FloatInput,
    /// A film over the base.
    pub thin_film: ThinFilm,
    /// Radiance that the surface gives off by itself, on both sides; lights the scene too.
    pub emission: ColorInput,
}

impl Default for Standard {
    fn default() -> Self {
        let (none, all) = (FloatInput::constant(0.0), FloatInput::constant(1.0));
        let white = ColorInput::constant(Rgb::ONE);
        Self {
            base_color: ColorInput::constant(Rgb::splat(0.8)),
            diffuse_roughness: none,
            metalness: none,
            edge_color: white,
            conductor: None,
            roughness: FloatInput::constant(0.3),
            specular: all,
            specular_color: white,
            ior: 1.5,
            anisotropy: none,
            anisotropy_rotation: 0.0,
            anisotropy_direction: None,
            transmission: none,
            thin_walled: false,
            absorption: Rgb::ZERO,
            dispersion: 0.0,
            diffuse_transmission: none,
            diffuse_transmission_color: white,
            subsurface: none,
            subsurface_color: ColorInput::constant(Rgb::splat(0.8)),
            subsurface_radius: Rgb::new(0.01, 0.005, 0.0025),
            subsurface_anisotropy: 0.0,
            coat: none,
            coat_roughness: none,
            coat_ior: 1.5,
            coat_relief: None,
            sheen_color: ColorInput::default(),
            sheen_roughness: none,
            thin_film: ThinFilm::default(),
            emission: ColorInput::default(),
        }
    }
}

impl Standard {
    /// The colours that textures may vary, by the names that scene files give them.
    pub fn colors(&self) -> [(&'static str, &ColorInput); 7] {
        [
            ("base_color", &self.base_color),
            ("edge_color", &self.edge_color),
            ("specular_color", &self.specular_color),
            ("diffuse_transmission_color", &self.diffuse_transmission_color),
            ("subsurface_color", &self.subsurface_color),
            ("sheen_color", &self.sheen_color),
            ("emission", &self.emission),
        ]
    }

    /// The numbers from 0 to 1 that textures may vary, by the names that scene files give them.
    pub fn shares(&self) -> [(&'static str, &FloatInput); 12] {
        [
            ("diffuse_roughness", &self.diffuse_roughness),
            ("metalness", &self.metalness),
            ("roughness", &self.roughness),
            ("specular", &self.specular),
            ("anisotropy", &self.anisotropy),
            ("transmission", &self.transmission),
            ("diffuse_transmission", &self.diffuse_transmission),
            ("subsurface", &self.subsurface),
            ("coat", &self.coat),
            ("coat_roughness", &self.coat_roughness),
            ("sheen_roughness", &self.sheen_roughness),
            ("thin_film", &self.thin_film.weight),
        ]
    }

    /// See [`super::Material::each_texture`].
    pub(super) fn each_texture(&mut self, visit: &mut impl FnMut(&mut TextureId)) {
        let colors = [
            &mut self.base_color,
            &mut self.edge_color,
            &mut self.specular_color,
            &mut self.diffuse_transmission_color,
            &mut self.subsurface_color,
            &mut self.sheen_color,
            &mut self.emission,
        ];
        let numbers = [
            &mut self.diffuse_roughness,
            &mut self.metalness,
            &mut self.roughness,
            &mut self.specular,
            &mut self.anisotropy,
            &mut self.transmission,
            &mut self.diffuse_transmission,
            &mut self.subsurface,
            &mut self.coat,
            &mut self.coat_roughness,
            &mut self.sheen_roughness,
            &mut self.thin_film.weight,
            &mut self.thin_film.thickness,
        ];
        let colors = colors.into_iter().map(|input| &mut input.texture);
        let numbers = numbers.into_iter().map(|input| &mut input.texture);
        let direction = [&mut self.anisotropy_direction];
        colors.chain(numbers).chain(direction).flatten().for_each(&mut *visit);
        self.coat_relief.iter_mut().for_each(|relief| visit(relief.texture_mut()));
    }

    /// The nearest of the report's surfaces: shares and roughness as their factors say, textures of colours alone.
    pub(super) fn phong(&self) -> Phong {
        let (metal, glass) =
            (self.metalness.factor, (1.0 - self.metalness.factor) * self.transmission.factor);
        let scaled = |share: f32| ColorInput { factor: share * self.base_color.factor, ..self.base_color };
        // The sharper the highlight, the more of it is a mirror.
        let alpha = self.roughness.factor * self.roughness.factor;
        let mirror = (1.0 - self.roughness.factor).powi(4);
        let dielectric = ((self.ior - 1.0) / (self.ior + 1.0)).powi(2) * (1.0 - metal);
        let highlight = metal * self.base_color.factor + dielectric * self.specular_color.factor;
        Phong {
            ambient: scaled((1.0 - glass) * (1.0 - metal * mirror)),
            diffuse: scaled((1.0 - metal) * (1.0 - glass)),
            specular: ColorInput::constant((1.0 - mirror) * highlight),
            // Blinn's exponent of the same width: Walter et al., "Microfacet Models for Refraction", 2007.
            shininess: FloatInput::constant((2.0 / (alpha * alpha) - 2.0).min(MOST_SHINE)),
            emission: self.emission,
            mirror: scaled(metal * mirror),
            transparency: scaled(glass),
            ior: if self.thin_walled { 1.0 } else { self.ior },
            absorption: if self.thin_walled { Rgb::ZERO } else { self.absorption },
            fresnel: FresnelMode::Dielectric,
        }
    }

    /// Whether light may be refracted through it.
    pub fn refracts(&self) -> bool {
        self.transmission.factor > 0.0
    }
}
