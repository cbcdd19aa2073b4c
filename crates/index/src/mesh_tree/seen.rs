//! Eight triangles as a ray sees them, in lanes.

use super::block::{Axis, Rows};
use crate::simd::Lanes;
use heliostat_geometry::error_bound::gamma;

/// A ray in all lanes, its coordinates in cyclic order, the axis along which it runs fastest last.
pub(super) struct Eye<L: Lanes> {
    pub(super) axes: [Axis; 3],
    pub(super) origin: [L::F; 3],
    /// Slopes of the direction along the first two axes over the last one.
    pub(super) slope: [L::F; 2],
}

/// Triangles seen along a ray: where their corners a, b, c lie beside it and how deep.
pub(super) struct Seen<F> {
    ax: F,
    bx: F,
    cx: F,
    ay: F,
    by: F,
    cy: F,
    a_depth: F,
    b_depth: F,
    c_depth: F,
    /// Twice the areas that the ray's point spans with the edges opposite to a, b, c.
    u: F,
    v: F,
    w: F,
}

impl<L: Lanes> Eye<L> {
    /// Looks down the ray.
    #[inline(always)]
    pub(super) fn see(&self, lanes: L, rows: &Rows) -> Seen<L::F> {
        // (No `map` of arrays here: the compiler does not make it part of the function, and out of line it
        // knows nothing of the lanes.)
        let [x, y, z] = self.axes;
        let [a, b, c] = z.of(rows);
        let origin = self.origin[2];
        let a_depth = lanes.sub(lanes.load(a), origin);
        let b_depth = lanes.sub(lanes.load(b), origin);
        let c_depth = lanes.sub(lanes.load(c), origin);
        let [a, b, c] = x.of(rows);
        let (origin, slope) = (self.origin[0], self.slope[0]);
        let ax = lanes.sub(lanes.sub(lanes.load(a), origin), lanes.mul(slope, a_depth));
        let bx = lanes.sub(lanes.sub(lanes.load(b), origin), lanes.mul(slope, b_depth));
        let cx = lanes.sub(lanes.sub(lanes.load(c), origin), lanes.mul(slope, c_depth));
        let [a, b, c] = y.of(rows);
        let (origin, slope) = (self.origin[1], self.slope[1]);
        let ay = lanes.sub(lanes.sub(lanes.load(a), origin), lanes.mul(slope, a_depth));
        let by = lanes.sub(lanes.sub(lanes.load(b), origin), lanes.mul(slope, b_depth));
        let cy = lanes.sub(lanes.sub(lanes.load(c), origin), lanes.mul(slope, c_depth));
        // Differences of products.
        let u = lanes.sub(lanes.mul(cx, by), lanes.mul(cy, bx));
        let v = lanes.sub(lanes.mul(ax, cy), lanes.mul(ay, cx));
        let w = lanes.sub(lanes.mul(bx, ay), lanes.mul(by, ax));
        Seen { ax, bx, cx, ay, by, cy, a_depth, b_depth, c_depth, u, v, w }
    }
}

impl<F: Copy> Seen<F> {
    /// A bit for each triangle that the ray is not outside of; each without an area among them.
    #[inline(always)]
    pub(super) fn inside<L: Lanes<F = F>>(&self, lanes: L) -> u32 {
        !lanes.mixed_signs(self.u, self.v, self.w)
    }

    /// A bit for each triangle that may have an edge on the ray.
    #[inline(always)]
    pub(super) fn at_edge<L: Lanes<F = F>>(&self, lanes: L) -> u32 {
        lanes.any_zero(self.u, self.v, self.w)
    }

    /// The mean of the depths, weighted by the areas: times the whole area.
    #[inline(always)]
    fn weighted<L: Lanes<F = F>>(&self, lanes: L) -> F {
        lanes.mul_add(
            self.w,
            self.c_depth,
            lanes.mul_add(self.v, self.b_depth, lanes.mul(self.u, self.a_depth)),
        )
    }

    /// Bounds of the distances of triangles that the ray is inside of; `per_depth` is one over its direction along the main axis.
    #[inline(always)]
    pub(super) fn bounds<L: Lanes<F = F>>(&self, lanes: L, per_depth: f32) -> (F, F) {
        let &Self { ax, bx, cx, ay, by, cy, a_depth, b_depth, c_depth, u, v, w } = self;
        let share = lanes.div(lanes.splat(1.0), lanes.add(lanes.add(u, v), w));
        let distance = lanes.mul(lanes.mul(self.weighted(lanes), share), lanes.splat(per_depth));
        let farthest = lanes.max(lanes.max(a_depth, b_depth), c_depth);
        let nearest = lanes.min(lanes.min(a_depth, b_depth), c_depth);
        let x = lanes.larger_size(lanes.larger_size(ax, bx), cx);
        let y = lanes.larger_size(lanes.larger_size(ay, by), cy);
        let size = lanes.larger_size(x, y);
        let reach = lanes.add(lanes.larger_size(nearest, farthest), size);
        let span = lanes.mul(lanes.sub(farthest, nearest), share);
        let error = lanes.mul(error(lanes, reach, size, span), lanes.splat(per_depth.abs()));
        (lanes.sub(distance, error), lanes.add(distance, error))
    }

    /// A bit for each triangle that the ray is inside of and that surely lies behind its origin: where that is all that is asked,
    /// for less than [`Seen::bounds`]. No triangle may be larger than `extent` along an axis; `dir` is the direction along the
    /// main axis.
    ///
    /// With `e` for the extent: a ray inside of a triangle sees its corners no farther than `2 e + shift` beside it, their depths
    /// differ by `e`, and their area is at most `4 (e + shift)^2`. So the [error](error) of the depth, times the area, is
    /// `shift (36 (2 e + 2 shift) e + 4 * 4 (e + shift)^2)`, less than `88 shift (e + shift)^2`, and the reach less than
    /// the depth and `2 e`, but for its rounding. What is left to a hundred is for the rounding of all this.
    #[inline(always)]
    pub(super) fn behind<L: Lanes<F = F>>(&self, lanes: L, extent: f32, dir: f32) -> u32 {
        let &Self { a_depth, b_depth, c_depth, u, v, w, .. } = self;
        let area = lanes.add(lanes.add(u, v), w);
        let ahead = lanes.signed_by(lanes.signed_by(self.weighted(lanes), area), lanes.splat(dir));
        let depth = lanes.larger_size(lanes.larger_size(a_depth, b_depth), c_depth);
        let reach = lanes.add(depth, lanes.splat(2.0 * extent));
        let size = lanes.mul_add(reach, lanes.splat(gamma(6)), lanes.splat(extent));
        let doubt = lanes.mul(lanes.mul(reach, lanes.splat(100.0 * gamma(6))), lanes.mul(size, size));
        lanes.lt(lanes.add(ahead, doubt), lanes.splat(0.0))
    }
}

/// Bound of how far the depth of a hit may lie from the exact one, or from that of the plane of the triangle.
///
/// The corners lie up to `reach` from the origin along an axis, up to `size` beside the ray; `span` is the difference of
/// their depths over the area. Rounding moves the corners across the ray by up to `shift`
/// ([`heliostat_geometry::error_bound::sheared_corner`]). With the rounding of the products that moves the three areas,
/// together, by up to `18 * shift * (size + shift)`, and the mean by as large a part of the span as this is of the whole
/// area; twice that, where the ray misses the moved triangle by so little. And the mean itself is rounded.
#[inline(always)]
fn error<L: Lanes>(lanes: L, reach: L::F, size: L::F, span: L::F) -> L::F {
    let shift = lanes.mul(reach, lanes.splat(gamma(6)));
    let turn = lanes.mul(lanes.add(size, shift), lanes.larger_size(span, span));
    lanes.mul(shift, lanes.mul_add(turn, lanes.splat(36.0), lanes.splat(4.0)))
}
