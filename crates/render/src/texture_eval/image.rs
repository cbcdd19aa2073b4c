//! Images at a point and over an ellipse.

use glam::{Vec2, Vec4};
use heliostat_scene::Image;
use heliostat_scene::texture::{Filtering, Minify, Wrap};

/// Looks along the longer axis of an ellipse, at most; a longer one is looked at more coarsely.
const MOST_LOOKS: f32 = 8.0;

/// How an image is looked at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look<'a> {
    pub(super) image: &'a Image,
    /// In u and v.
    pub(super) wraps: [Wrap; 2],
    pub(super) filtering: Filtering,
}

impl Look<'_> {
    /// The value at transformed surface parameters; `v = 0` is the lower edge.
    pub(super) fn at(&self, uv: Vec2) -> Vec4 {
        self.one(self.image, self.filtering, uv)
    }

    /// The mean over an ellipse around transformed surface parameters.
    pub(super) fn over(&self, uv: Vec2, axes: [Vec2; 2], minify: Minify) -> Vec4 {
        // In texels, the longer axis first.
        let size = Vec2::new(self.image.width as f32, self.image.height as f32);
        let [a, b] = axes.map(|axis| (axis * size).length());
        let (longer, shorter, axis) = if a >= b { (a, b, axes[0]) } else { (b, a, axes[1]) };
        if longer <= 1.0 {
            return self.at(uv);
        }
        match minify {
            Minify::Nearest => return self.one(self.image, Filtering::Nearest, uv),
            Minify::Bilinear => return self.one(self.image, Filtering::Bilinear, uv),
            Minify::Mip => {}
        }
        // As fine as the shorter axis, in several places along the longer one.
        let width = shorter.max(longer / MOST_LOOKS).max(1.0);
        let looks = (longer / width).round().max(1.0);
        let level = width.log2();
        let sum: Vec4 = (0..looks as u32)
            .map(|i| self.between_levels(level, uv + ((i as f32 + 0.5) / looks - 0.5) * axis))
            .sum();
        sum / looks
    }

    /// Linear between the two levels nearest to a number of halvings.
    fn between_levels(&self, level: f32, uv: Vec2) -> Vec4 {
        // The fraction of a level beyond the last one does not matter: all of them are the last one.
        let below = level.floor();
        let finer = self.one(self.image.level(below as usize), Filtering::Bilinear, uv);
        if level == below {
            return finer;
        }
        let coarser = self.one(self.image.level(below as usize + 1), Filtering::Bilinear, uv);
        finer.lerp(coarser, level - below)
    }

    /// The value of one level.
    fn one(&self, image: &Image, filtering: Filtering, uv: Vec2) -> Vec4 {
        let wraps = self.wraps;
        let x = texel_position(uv.x, image.width, wraps[0]);
        let y = texel_position(1.0 - uv.y, image.height, wraps[1]);
        let pixel = |x: i64, y: i64| {
            image.pixel(wrapped(x, image.width, wraps[0]), wrapped(y, image.height, wraps[1]))
        };
        match filtering {
            Filtering::Nearest => pixel(x.floor() as i64, y.floor() as i64),
            Filtering::Bilinear => {
                // Texel centres lie at halves.
                let (x, y) = (x - 0.5, y - 0.5);
                let (x0, y0) = (x.floor(), y.floor());
                let (fx, fy) = (x - x0, y - y0);
                let (x0, y0) = (x0 as i64, y0 as i64);
                let upper = pixel(x0, y0).lerp(pixel(x0 + 1, y0), fx);
                let lower = pixel(x0, y0 + 1).lerp(pixel(x0 + 1, y0 + 1), fx);
                upper.lerp(lower, fy)
            }
        }
    }
}

/// A coordinate in texels, brought near the image first, so that its fraction keeps its digits. 0 for NaN.
fn texel_position(u: f32, size: u32, wrap: Wrap) -> f32 {
    let u = if u.is_finite() { u } else { 0.0 };
    let near = match wrap {
        Wrap::Repeat => u - u.floor(),
        Wrap::Mirror => u - 2.0 * (0.5 * u).floor(),
        Wrap::Clamp => u.clamp(0.0, 1.0),
    };
    near * size as f32
}

/// The index inside the image that stands for texel `i`.
fn wrapped(i: i64, size: u32, wrap: Wrap) -> u32 {
    let size = i64::from(size);
    let inside = match wrap {
        Wrap::Repeat => i.rem_euclid(size),
        Wrap::Mirror => {
            let i = i.rem_euclid(2 * size);
            if i < size { i } else { 2 * size - 1 - i }
        }
        Wrap::Clamp => i.clamp(0, size - 1),
    };
    inside as u32
}
