//! Numbers and colours that a texture may vary.

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

/// Which number of a texture is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Channel {
    /// The luminance of its colour; for opacity the alpha of an image, where it has one.
    #[default]
    Luminance,
    /// Red.
    R,
    /// Green.
    G,
    /// Blue.
    B,
    /// Alpha.
    A,
}

/// A number that a texture may vary: `factor * channel of the texture`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatInput {
    /// The number, or the factor of the texture.
    pub factor: f32,
    /// The texture, if any.
    pub texture: Option<TextureId>,
    /// What of the texture is looked at.
    pub channel: Channel,
}

impl FloatInput {
    /// The same number everywhere.
    pub const fn constant(factor: f32) -> Self {
        Self { factor, texture: None, channel: Channel::Luminance }
    }
}
