//! Materials: textured descriptions of how a surface answers light.

use crate::color::Rgb;
use crate::ids::TextureId;

/// A colour that a texture may vary: `factor * texture`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorInput {
    /// The colour, or the factor of the texture.
    pub factor: Rgb,
    /// The texture, if any.
    pub texture: Option<TextureId>,
}

impl ColorInput {
    /// The same colour everywhere.
    pub const fn constant(factor: Rgb) -> Self {
        Self { factor, texture: None }
    }

    /// Whether the value is zero everywhere.
    pub fn is_zero(&self) -> bool {
        self.factor == Rgb::ZERO
    }
}

impl Default for ColorInput {
    fn default() -> Self {
        Self::constant(Rgb::ZERO)
    }
}

/// A number that a texture may vary: `factor * luminance(texture)`. For opacity the alpha of an image takes the place of
/// its luminance, where it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatInput {
    /// The number, or the factor of the texture.
    pub factor: f32,
    /// The texture, if any.
    pub texture: Option<TextureId>,
}

impl FloatInput {
    /// The same number everywhere.
    pub const fn constant(factor: f32) -> Self {
        Self { factor, texture: None }
    }
}

/// A relief that bends the shading normal without moving the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relief {
    /// A height map: displacement along the normal is `strength * luminance`, in units of `uv` length on the surface.
    Bump {
        /// The height.
        texture: TextureId,
        /// Height of white, in metres.
        strength: f32,
    },
    /// A tangent-space normal map, linear, +y up.
    Normal {
        /// The map.
        texture: TextureId,
        /// Scale of its x and y.
        strength: f32,
    },
}

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

/// The closed list of surface models.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// The report's model.
    Phong(Phong),
}

/// A named material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name, unique in a scene; becomes the Cryptomatte name.
    pub name: String,
    /// How it answers light.
    pub surface: Surface,
    /// Coverage in `[0, 1]`: 0 lets rays pass straight through (MTL's `d`, cut-outs).
    pub opacity: FloatInput,
    /// Bends the shading normal.
    pub relief: Option<Relief>,
}

impl Material {
    /// A grey matte surface.
    pub fn new(name: impl Into<String>, phong: Phong) -> Self {
        Self {
            name: name.into(),
            surface: Surface::Phong(phong),
            opacity: FloatInput::constant(1.0),
            relief: None,
        }
    }

    /// The textures that it looks at, some of them more than once.
    pub fn textures(&self) -> impl Iterator<Item = TextureId> {
        let Surface::Phong(phong) = &self.surface;
        let Phong { ambient, diffuse, specular, emission, mirror, transparency, shininess, .. } = phong;
        let colors = [ambient, diffuse, specular, emission, mirror, transparency].map(|input| input.texture);
        let numbers = [shininess, &self.opacity].map(|input| input.texture);
        let relief = self.relief.map(|relief| match relief {
            Relief::Bump { texture, .. } | Relief::Normal { texture, .. } => texture,
        });
        colors.into_iter().chain(numbers).chain([relief]).flatten()
    }
}
