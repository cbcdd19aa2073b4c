//! Textures: functions of the surface position, described.

use crate::color::Rgb;
use crate::image::Image;
use glam::Vec2;
use std::sync::Arc;

/// What happens outside `[0, 1]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The image starts again.
    #[default]
    Repeat,
    /// Every second repetition is mirrored.
    Mirror,
    /// The border pixels go on for ever.
    Clamp,
}

/// How values between pixel centres are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filtering {
    /// The nearest pixel.
    Nearest,
    /// Linear in both directions between four pixels.
    #[default]
    Bilinear,
}

/// What a look shows that takes in more than one pixel, where the picture of an image is smaller than the image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Minify {
    /// The nearest pixel.
    Nearest,
    /// Linear between the four nearest pixels.
    Bilinear,
    /// The mean of all of them, from smaller copies of the image.
    #[default]
    Mip,
}

/// Where a checker pattern lives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CheckerSpace {
    /// Squares of side 1 in `uv`.
    #[default]
    Uv,
    /// Cubes of side 1 in the local space of the object.
    Local,
}

/// One of the two sets of surface parameters that a mesh may have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UvSet {
    /// `uvs`.
    #[default]
    First,
    /// `uvs1`; the first ones where there are none.
    Second,
}

/// Scale, then turn, then shift of the surface parameters, before a texture looks at them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvTransform {
    /// Which surface parameters of a mesh.
    pub set: UvSet,
    /// Repetitions per unit of `uv`.
    pub scale: Vec2,
    /// Counter-clockwise turn in radians.
    pub rotation: f32,
    /// Shift in `uv`.
    pub offset: Vec2,
}

impl Default for UvTransform {
    fn default() -> Self {
        Self { set: UvSet::First, scale: Vec2::ONE, rotation: 0.0, offset: Vec2::ZERO }
    }
}

impl UvTransform {
    /// The transformed surface parameters.
    pub fn apply(&self, uv: Vec2) -> Vec2 {
        self.apply_to_change(uv) + self.offset
    }

    /// What becomes of a difference of surface parameters.
    pub fn apply_to_change(&self, change: Vec2) -> Vec2 {
        Vec2::from_angle(self.rotation).rotate(change * self.scale)
    }
}

/// One of the images of a surface that is painted on many.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    /// 1001 for the unit square at the origin, plus `u`, plus ten times `v`.
    pub number: u32,
    /// The pixels.
    pub image: Arc<Image>,
}

/// The pattern of a texture.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// An image; `v = 0` is its lower edge.
    Image {
        /// The pixels, shared between textures that read the same file.
        image: Arc<Image>,
        /// Wrapping in u.
        wrap_u: Wrap,
        /// Wrapping in v.
        wrap_v: Wrap,
        /// Filtering between pixels.
        filtering: Filtering,
        /// Filtering of many pixels at once.
        minify: Minify,
    },
    /// Images side by side, one for each unit square of the surface parameters (UDIM); nothing is repeated.
    Tiles {
        /// In the order of their numbers.
        tiles: Vec<Tile>,
        /// Filtering between pixels.
        filtering: Filtering,
        /// Filtering of many pixels at once.
        minify: Minify,
    },
    /// Two colours in turn.
    Checker {
        /// Colour of the square at the origin.
        even: Rgb,
        /// Colour of its neighbours.
        odd: Rgb,
        /// What the squares divide.
        space: CheckerSpace,
    },
    /// Stands for a file that could not be read: magenta.
    Missing,
}

/// A named texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Name in the scene file, or the path of the image.
    pub name: String,
    /// The pattern.
    pub pattern: Pattern,
    /// Applied to `uv` (and to `x`, `z` of local space by scale alone).
    pub uv: UvTransform,
}

impl Texture {
    /// The images that it shows.
    pub fn images(&self) -> impl Iterator<Item = &Arc<Image>> {
        let (one, many) = match &self.pattern {
            Pattern::Image { image, .. } => (Some(image), &[][..]),
            Pattern::Tiles { tiles, .. } => (None, tiles.as_slice()),
            Pattern::Checker { .. } | Pattern::Missing => (None, &[][..]),
        };
        one.into_iter().chain(many.iter().map(|tile| &tile.image))
    }

    /// Whether its value depends on the surface parameters.
    pub fn uses_parameters(&self) -> bool {
        match self.pattern {
            Pattern::Image { .. }
            | Pattern::Tiles { .. }
            | Pattern::Checker { space: CheckerSpace::Uv, .. } => true,
            Pattern::Checker { space: CheckerSpace::Local, .. } | Pattern::Missing => false,
        }
    }
}
