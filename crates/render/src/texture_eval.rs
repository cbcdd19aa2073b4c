//! Textures at a point: patterns, wrapping and bilinear filtering.
//!
//! Values are linear RGBA with straight alpha. There is no minification filter: a pixel that covers many texels is
//! averaged by its camera samples.

use glam::{Vec2, Vec3, Vec4};
use heliostat_scene::Image;
use heliostat_scene::color::luminance;
use heliostat_scene::texture::{CheckerSpace, Filtering, Pattern, Texture, UvSet, UvTransform, Wrap};

/// What a missing image looks like.
const MAGENTA: Vec4 = Vec4::new(1.0, 0.0, 1.0, 1.0);

/// Where a texture is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TexturePoint {
    /// Surface parameters.
    pub(crate) uv: Vec2,
    /// The second set of them; the first one where there is only that.
    pub(crate) uv1: Vec2,
    /// Position in the local space of the object.
    pub(crate) local: Vec3,
    /// Coverage of the surface itself, in `[0, 1]`.
    pub(crate) coverage: f32,
}

impl TexturePoint {
    /// A point of a surface that covers all and has one set of parameters.
    pub(crate) fn plain(uv: Vec2, local: Vec3) -> Self {
        Self { uv, uv1: uv, local, coverage: 1.0 }
    }

    /// The parameters that a texture looks at, transformed as it wants them.
    fn parameters(&self, transform: &UvTransform) -> Vec2 {
        transform.apply(match transform.set {
            UvSet::First => self.uv,
            UvSet::Second => self.uv1,
        })
    }

    /// The point a step further in both sets.
    pub(crate) fn moved(&self, by: Vec2) -> Self {
        Self { uv: self.uv + by, uv1: self.uv1 + by, ..*self }
    }
}

/// The linear RGBA value of a texture.
pub(crate) fn eval(texture: &Texture, at: &TexturePoint) -> Vec4 {
    match &texture.pattern {
        Pattern::Image { image, wrap_u, wrap_v, filtering } => {
            image_at(image, [*wrap_u, *wrap_v], *filtering, at.parameters(&texture.uv))
        }
        Pattern::Checker { even, odd, space } => {
            let color = if is_even(*space, &texture.uv, at) { even } else { odd };
            color.extend(1.0)
        }
        Pattern::Missing => MAGENTA,
    }
}

/// What a texture says of coverage: its alpha where it has one, else its luminance; a missing image covers.
pub(crate) fn coverage(texture: &Texture, at: &TexturePoint) -> f32 {
    let value = eval(texture, at);
    match &texture.pattern {
        Pattern::Image { image, .. } if image.has_alpha() => value.w,
        Pattern::Missing => 1.0,
        Pattern::Image { .. } | Pattern::Checker { .. } => luminance(value.truncate()),
    }
}

/// Steps of `u` and `v` over which a height changes noticeably: one texel of an image, a small part of a checker.
///
/// `None` where the texture does not change with `uv`.
pub(crate) fn uv_step(texture: &Texture) -> Option<Vec2> {
    /// A checker is as coarse as an image of so many texels per square.
    const CHECKER_TEXELS: f32 = 64.0;
    let texels = match &texture.pattern {
        Pattern::Image { image, .. } => Vec2::new(image.width as f32, image.height as f32),
        Pattern::Checker { space: CheckerSpace::Uv, .. } => Vec2::splat(CHECKER_TEXELS),
        Pattern::Checker { space: CheckerSpace::Local, .. } | Pattern::Missing => return None,
    };
    // A turn mixes the axes: the finer of the two serves both.
    let density = (texels * texture.uv.scale.abs()).max_element();
    (density.is_finite() && density > 0.0).then(|| Vec2::splat(1.0 / density))
}

/// Whether the square or cube around the point has the colour of the one at the origin.
fn is_even(space: CheckerSpace, transform: &UvTransform, at: &TexturePoint) -> bool {
    let cell = match space {
        CheckerSpace::Uv => at.parameters(transform).floor().extend(0.0),
        CheckerSpace::Local => {
            let scale = Vec3::new(transform.scale.x, transform.scale.x, transform.scale.y);
            (at.local * scale).map(snapped_floor)
        }
    };
    // Twice the half of an even number is that number; cells far out are even, as floats of that size are.
    let (sum, half) = (cell.element_sum(), 0.5 * cell.element_sum());
    2.0 * half.floor() == sum
}

/// The floor of a coordinate whose rounding must not decide: a face that lies on a border between cells belongs to the
/// upper one as a whole.
fn snapped_floor(v: f32) -> f32 {
    let nearest = v.round();
    if (v - nearest).abs() <= heliostat_geometry::error_bound::on_face(nearest) { nearest } else { v.floor() }
}

/// The value of an image at transformed surface parameters; `v = 0` is its lower edge.
fn image_at(image: &Image, wraps: [Wrap; 2], filtering: Filtering, uv: Vec2) -> Vec4 {
    let x = texel_position(uv.x, image.width, wraps[0]);
    let y = texel_position(1.0 - uv.y, image.height, wraps[1]);
    let pixel =
        |x: i64, y: i64| image.pixel(wrapped(x, image.width, wraps[0]), wrapped(y, image.height, wraps[1]));
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
