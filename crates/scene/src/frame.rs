//! A finished picture: named channels with their windows and what is to be said about them.

use crate::settings::PixelRect;
use std::collections::BTreeMap;

/// How a channel is stored in a file that can choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// 16-bit float: colours.
    Half,
    /// 32-bit float: data.
    Float,
}

/// One channel over the data window, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// `layer.component`, or a bare component in the base layer (`R`, `G`, `B`, `A`, `Z`).
    pub name: String,
    /// How it is stored.
    pub depth: Depth,
    /// One value per pixel of the data window.
    pub values: Vec<f32>,
}

/// A value of the file header.
#[derive(Clone, Debug, PartialEq)]
pub enum Meta {
    /// Text.
    Text(String),
    /// An integer.
    Int(i32),
    /// A number.
    Float(f32),
    /// A ratio: numerator and denominator.
    Rational(i32, u32),
    /// Two numbers.
    Vec2([f32; 2]),
    /// Three numbers.
    Vec3([f32; 3]),
    /// A 4 by 4 matrix, row by row.
    Matrix([f32; 16]),
    /// A list of texts.
    Texts(Vec<String>),
    /// A value of another type, as the file holds it.
    Other {
        /// Name of the type in the file format.
        kind: String,
        /// The value.
        bytes: Vec<u8>,
    },
}

/// A picture of named channels. Colour is linear Rec.709, premultiplied by alpha.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Size of the whole picture.
    pub width: u32,
    /// Size of the whole picture.
    pub height: u32,
    /// The pixels that the channels hold.
    pub window: PixelRect,
    /// Channels, in any order; names are unique.
    pub channels: Vec<Channel>,
    /// Header entries, in the order of their names.
    pub meta: BTreeMap<String, Meta>,
}

impl Frame {
    /// The channel of that name.
    pub fn channel(&self, name: &str) -> Option<&Channel> {
        self.channels.iter().find(|c| c.name == name)
    }

    /// Pixels in the data window.
    pub fn pixel_count(&self) -> usize {
        self.window.width() as usize * self.window.height() as usize
    }
}
