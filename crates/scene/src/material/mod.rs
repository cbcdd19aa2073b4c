//! Materials: textured descriptions of how a surface answers light.

mod input;
mod metals;
mod phong;
mod standard;

pub use input::{Channel, ColorInput, FloatInput};
pub use phong::{FresnelMode, Phong};
pub use standard::{Conductor, Standard, ThinFilm};

use crate::color::Rgb;
use crate::ids::{MediumId, TextureId};
use std::borrow::Cow;

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

impl Relief {
    /// The texture that it looks at.
    pub fn texture_mut(&mut self) -> &mut TextureId {
        match self {
            Self::Bump { texture, .. } | Self::Normal { texture, .. } => texture,
        }
    }
}

/// The closed list of surface models.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// The report's model.
    Phong(Phong),
    /// The physically based model.
    Standard(Box<Standard>),
    /// A colour that is seen as it is, without light; it lights nothing either.
    Unlit(ColorInput),
}

impl Surface {
    /// Radiance that the surface gives off by itself and that lights the scene.
    pub fn emission(&self) -> ColorInput {
        match self {
            Self::Phong(phong) => phong.emission,
            Self::Standard(standard) => standard.emission,
            Self::Unlit(_) => ColorInput::default(),
        }
    }

    /// The same or the nearest of the report's surfaces: what integrators show that know only those.
    pub fn phong(&self) -> Cow<'_, Phong> {
        match self {
            Self::Phong(phong) => Cow::Borrowed(phong),
            Self::Standard(standard) => Cow::Owned(standard.phong()),
            Self::Unlit(color) => Cow::Owned(Phong { emission: *color, ..Phong::DARK }),
        }
    }

    /// Whether light may be refracted through it.
    pub fn refracts(&self) -> bool {
        match self {
            Self::Phong(phong) => !phong.transparency.is_zero(),
            Self::Standard(standard) => standard.refracts(),
            Self::Unlit(_) => false,
        }
    }

    /// Whether light gets through it at all, refracted or scattered.
    pub fn lets_light_through(&self) -> bool {
        let scatters = matches!(self, Self::Standard(standard) if standard.diffuse_transmission.factor > 0.0);
        scatters || self.refracts()
    }

    /// Absorption inside per metre and channel.
    pub fn absorption(&self) -> Rgb {
        match self {
            Self::Phong(phong) => phong.absorption,
            Self::Standard(standard) if !standard.thin_walled => standard.absorption,
            Self::Standard(_) | Self::Unlit(_) => Rgb::ZERO,
        }
    }

    /// Whether it is the boundary of an inside, which light enters and leaves.
    pub fn encloses(&self) -> bool {
        match self {
            Self::Standard(standard) => standard.refracts() && !standard.thin_walled,
            Self::Phong(_) | Self::Unlit(_) => self.refracts(),
        }
    }

    /// Index of refraction of the inside relative to the outside.
    pub fn ior(&self) -> f32 {
        match self {
            Self::Phong(phong) => phong.ior,
            Self::Standard(standard) => standard.ior,
            Self::Unlit(_) => 1.0,
        }
    }

    /// Whether light may walk below it and come out elsewhere.
    pub fn has_subsurface(&self) -> bool {
        matches!(self, Self::Standard(standard) if standard.subsurface.factor > 0.0)
    }

    /// Whether highlights are drawn out along the tangents of the surface.
    pub fn follows_tangents(&self) -> bool {
        matches!(self, Self::Standard(standard) if standard.anisotropy.factor > 0.0)
    }

    /// What bends the normal of its coat alone.
    pub fn coat_relief(&self) -> Option<Relief> {
        match self {
            Self::Standard(standard) => standard.coat_relief,
            Self::Phong(_) | Self::Unlit(_) => None,
        }
    }

    /// Whether light may pass through it without a bend: a smooth wall without an inside, or one whose inside bends nothing.
    pub fn passes_straight(&self) -> bool {
        match self {
            Self::Phong(phong) => phong.ior == 1.0 && self.refracts(),
            Self::Standard(standard) => {
                standard.thin_walled && standard.roughness.factor == 0.0 && self.refracts()
            }
            Self::Unlit(_) => false,
        }
    }
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
    /// From this coverage on the surface is whole, and below it there is none; `None` takes coverage as a share.
    pub cutoff: Option<f32>,
    /// Bends the shading normal.
    pub relief: Option<Relief>,
    /// What fills the inside of a closed surface. Where the surface lets light through, by refraction or by its opacity, that
    /// enters the medium; with an opacity of 0 there is a medium and no surface.
    pub interior: Option<MediumId>,
    /// Which of several clear bodies there is where they overlap: the one of the highest number, and the surfaces of others do not
    /// exist there. Where it is given, indices of refraction of the bodies inside are those against vacuum.
    ///
    /// # Source
    /// Schmidt, Budge, "Simple Nested Dielectrics in Ray Traced Images", Journal of Graphics Tools, 2002.
    pub priority: Option<u32>,
    /// What the backs of its faces are, where the corners of a triangle run clockwise.
    pub back: Back,
}

/// What the back of a face is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Back {
    /// As the front.
    #[default]
    Alike,
    /// As the front, but without light of its own: a lamp shines from its front.
    Dark,
    /// Dark, and the camera looks past it, also by mirrors and clear glass. Light does not: backs throw shadows and send it on like
    /// any other.
    Hidden,
}

impl Material {
    /// A surface that covers all and is smooth.
    pub fn of(name: impl Into<String>, surface: Surface) -> Self {
        let opacity = FloatInput::constant(1.0);
        Self {
            name: name.into(),
            surface,
            opacity,
            cutoff: None,
            relief: None,
            interior: None,
            priority: None,
            back: Back::Alike,
        }
    }

    /// One of the report's surfaces.
    pub fn new(name: impl Into<String>, phong: Phong) -> Self {
        Self::of(name, Surface::Phong(phong))
    }

    /// Whether its faces are seen from the front alone.
    pub fn hides_back(&self) -> bool {
        self.back == Back::Hidden
    }

    /// Whether its own light leaves from the backs of its faces too.
    pub fn shines_back(&self) -> bool {
        self.back == Back::Alike
    }

    /// Whether rays may pass straight through it somewhere.
    pub fn has_holes(&self) -> bool {
        self.opacity.factor < 1.0 || self.opacity.texture.is_some()
    }

    /// Shows every texture that it looks at, some of them more than once, to be given other ids.
    pub fn each_texture(&mut self, mut visit: impl FnMut(&mut TextureId)) {
        match &mut self.surface {
            Surface::Phong(phong) => phong.each_texture(&mut visit),
            Surface::Standard(standard) => standard.each_texture(&mut visit),
            Surface::Unlit(color) => color.texture.iter_mut().for_each(&mut visit),
        }
        self.opacity.texture.iter_mut().for_each(&mut visit);
        self.relief.iter_mut().for_each(|relief| visit(relief.texture_mut()));
    }

    /// The textures that it looks at, some of them more than once.
    pub fn textures(&self) -> Vec<TextureId> {
        let mut textures = Vec::new();
        self.clone().each_texture(|id| textures.push(*id));
        textures
    }
}
