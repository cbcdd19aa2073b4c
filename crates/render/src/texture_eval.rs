//! Textures at a point: patterns, wrapping and bilinear filtering.
//!
//! Values are linear RGBA with straight alpha. A look that takes in many texels is a mean over them: of smaller copies of the image,
//! at several places along the longer axis of what it takes in.
//!
//! # Source
//! Williams, "Pyramidal Parametrics", SIGGRAPH 1983 (three-linear filtering); `McCormack` et al., "Feline: Fast Elliptical Lines for
//! Anisotropic Texture Mapping", SIGGRAPH 1999 (several looks along the longer axis).

mod checker;
mod image;

use glam::{Vec2, Vec3, Vec4};
use heliostat_scene::Image;
use heliostat_scene::color::luminance;
use heliostat_scene::texture::{CheckerSpace, Pattern, Texture, Tile, UvSet, UvTransform, Wrap};
use image::Look;

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
    /// What is taken in: the change of `uv` along the axes of an ellipse.
    pub(crate) footprint: [Vec2; 2],
}

impl TexturePoint {
    /// A point of a surface that covers all and has one set of parameters.
    pub(crate) fn plain(uv: Vec2, local: Vec3) -> Self {
        Self { uv, uv1: uv, local, coverage: 1.0, footprint: [Vec2::ZERO; 2] }
    }

    /// The parameters that a texture looks at, transformed as it wants them.
    fn parameters(&self, transform: &UvTransform) -> Vec2 {
        transform.apply(match transform.set {
            UvSet::First => self.uv,
            UvSet::Second => self.uv1,
        })
    }

    /// What is taken in of the transformed parameters. That of the second set is not known: it is looked at in points.
    fn axes(&self, transform: &UvTransform) -> [Vec2; 2] {
        match transform.set {
            UvSet::First => self.footprint.map(|axis| transform.apply_to_change(axis)),
            UvSet::Second => [Vec2::ZERO; 2],
        }
    }

    /// The point alone.
    pub(crate) fn sharp(&self) -> Self {
        Self { footprint: [Vec2::ZERO; 2], ..*self }
    }

    /// The point a step further in both sets.
    pub(crate) fn moved(&self, by: Vec2) -> Self {
        Self { uv: self.uv + by, uv1: self.uv1 + by, ..*self }
    }
}

/// The linear RGBA value of a texture.
pub(crate) fn eval(texture: &Texture, at: &TexturePoint) -> Vec4 {
    match &texture.pattern {
        Pattern::Image { image, wrap_u, wrap_v, filtering, minify } => {
            let look = Look { image, wraps: [*wrap_u, *wrap_v], filtering: *filtering };
            let (uv, axes) = (at.parameters(&texture.uv), at.axes(&texture.uv));
            if axes == [Vec2::ZERO; 2] { look.at(uv) } else { look.over(uv, axes, *minify) }
        }
        Pattern::Tiles { tiles, filtering, minify } => {
            let uv = at.parameters(&texture.uv);
            let Some(image) = tile_at(tiles, uv) else { return MAGENTA };
            let look = Look { image, wraps: [Wrap::Clamp; 2], filtering: *filtering };
            let (uv, axes) = (uv - uv.floor(), at.axes(&texture.uv));
            if axes == [Vec2::ZERO; 2] { look.at(uv) } else { look.over(uv, axes, *minify) }
        }
        Pattern::Checker { even, odd, space } => {
            let axes = at.axes(&texture.uv);
            if *space == CheckerSpace::Uv && axes != [Vec2::ZERO; 2] {
                return checker::mean(*even, *odd, at.parameters(&texture.uv), axes).extend(1.0);
            }
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
        Pattern::Image { .. } | Pattern::Tiles { .. } if texture.images().any(|i| i.has_alpha()) => value.w,
        Pattern::Missing => 1.0,
        Pattern::Image { .. } | Pattern::Tiles { .. } | Pattern::Checker { .. } => {
            luminance(value.truncate())
        }
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
        Pattern::Tiles { tiles, .. } => {
            let sizes = tiles.iter().map(|tile| Vec2::new(tile.image.width as f32, tile.image.height as f32));
            sizes.fold(Vec2::ONE, Vec2::max)
        }
        Pattern::Checker { space: CheckerSpace::Uv, .. } => Vec2::splat(CHECKER_TEXELS),
        Pattern::Checker { space: CheckerSpace::Local, .. } | Pattern::Missing => return None,
    };
    // A turn mixes the axes: the finer of the two serves both.
    let density = (texels * texture.uv.scale.abs()).max_element();
    (density.is_finite() && density > 0.0).then(|| Vec2::splat(1.0 / density))
}

/// The image of the unit square around a point.
fn tile_at(tiles: &[Tile], uv: Vec2) -> Option<&Image> {
    /// Squares of a row, and rows, that numbers of four digits can tell.
    const MOST: Vec2 = Vec2::new(10.0, 900.0);
    let square = uv.floor();
    let exists = square.cmpge(Vec2::ZERO).all() && square.cmplt(MOST).all();
    let number = || 1001 + square.x as u32 + 10 * square.y as u32;
    let index = tiles.binary_search_by_key(&exists.then(number)?, |tile| tile.number).ok()?;
    Some(&tiles[index].image)
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
