//! Eight triangles side by side, and the test of a ray against all of them.
//!
//! The lanes answer only which triangles a ray *may* meet, in the very arithmetic of
//! [`heliostat_geometry::triangle::intersect`]; that function then decides, one triangle at a time. So a hit is what it is
//! for any other caller of that function, to the bit.

use crate::simd::{LANES, Lanes, Pick, Row};
use glam::Vec3;
use heliostat_geometry::Interval;
use heliostat_geometry::error_bound::{gamma, sheared_corner};
use heliostat_geometry::triangle::{
    TriangleHit, TriangleRay, intersect_certainly, intersect_turned, is_flat,
};

/// The corners a, b, c of eight triangles: for each corner a row of x, of y and of z.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(super) struct Block([[Row; 3]; 3]);

impl Block {
    /// Triangles side by side. One without area is laid out as NaN: then what the lanes are certain of is a hit.
    pub(super) fn new(triangles: impl Iterator<Item = [Vec3; 3]>) -> Self {
        let mut block = Self([[Row([0.0; LANES]); 3]; 3]);
        for (lane, corners) in triangles.enumerate() {
            let corners = if is_flat(corners) { [Vec3::NAN; 3] } else { corners };
            for (rows, corner) in block.0.iter_mut().zip(corners) {
                for (row, x) in rows.iter_mut().zip(corner.to_array()) {
                    row.0[lane] = x;
                }
            }
        }
        block
    }
}

/// A ray as blocks see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockRay {
    /// The axes in cyclic order, the one along which the ray runs fastest last.
    axes: [Pick<3>; 3],
    sheared: TriangleRay,
    /// One over the direction along the last axis.
    inverse: f32,
    /// Bound of the error of a distance by rounding of corners, and of the distance between where a triangle is seen and where
    /// it is said to be.
    slack: f32,
}

/// Triangles of a block that a ray may meet.
pub(super) struct Candidates<F> {
    /// A bit for each.
    pub(super) lanes: u32,
    /// A bit for each that lies wholly ahead, with bounds between those asked for.
    pub(super) within: u32,
    /// A bit for each whose edge the ray may meet exactly.
    pub(super) on_edge: u32,
    /// Bounds of the distances.
    pub(super) low: F,
    pub(super) high: F,
}

impl BlockRay {
    /// `reach` is the largest distance along an axis to any corner that the ray will be compared with.
    #[inline(always)]
    pub(super) fn new(ray: &TriangleRay, reach: f32) -> Self {
        let along = ray.along();
        let inverse = 1.0 / ray.dir().z;
        Self {
            axes: [Pick::new(along + 1), Pick::new(along + 2), Pick::new(along)],
            sheared: *ray,
            inverse,
            slack: (sheared_corner(reach) + gamma(16) * reach) * inverse.abs(),
        }
    }

    /// The exact test of one triangle.
    #[inline(always)]
    pub(super) fn hit(&self, block: &Block, lane: usize, range: Interval) -> Option<TriangleHit> {
        intersect_turned(&self.sheared, range, self.corners(block, lane))
    }

    /// The exact hit of a triangle that the lanes are certain of.
    #[inline(always)]
    pub(super) fn certain_hit(&self, block: &Block, lane: usize) -> Option<TriangleHit> {
        intersect_certainly(&self.sheared, self.corners(block, lane))
    }

    /// The corners of a triangle, the axis along which the ray runs fastest last.
    #[inline(always)]
    fn corners(&self, block: &Block, lane: usize) -> [Vec3; 3] {
        let [p, q, r] = self.axes;
        let corner = |i: usize| {
            let rows = &block.0[i];
            Vec3::new(p.of(rows).0[lane], q.of(rows).0[lane], r.of(rows).0[lane])
        };
        [corner(0), corner(1), corner(2)]
    }

    /// The triangles that may be hit between the distances `min` and `max`.
    #[inline(always)]
    pub(super) fn meet<L: Lanes>(
        &self,
        lanes: L,
        block: &Block,
        min: f32,
        max: f32,
    ) -> Option<Candidates<L::F>> {
        // Look down the ray. (No `map` of arrays here: the compiler does not make it part of the function, and out of line it
        // knows nothing of the lanes.)
        let [p, q, r] = self.axes;
        let [a, b, c] = &block.0;
        let origin = lanes.splat(self.sheared.origin().z);
        let a_depth = lanes.sub(lanes.load(r.of(a)), origin);
        let b_depth = lanes.sub(lanes.load(r.of(b)), origin);
        let c_depth = lanes.sub(lanes.load(r.of(c)), origin);
        let (origin, slope) = (lanes.splat(self.sheared.origin().x), lanes.splat(self.sheared.slope()[0]));
        let ax = lanes.sub(lanes.sub(lanes.load(p.of(a)), origin), lanes.mul(slope, a_depth));
        let bx = lanes.sub(lanes.sub(lanes.load(p.of(b)), origin), lanes.mul(slope, b_depth));
        let cx = lanes.sub(lanes.sub(lanes.load(p.of(c)), origin), lanes.mul(slope, c_depth));
        let (origin, slope) = (lanes.splat(self.sheared.origin().y), lanes.splat(self.sheared.slope()[1]));
        let ay = lanes.sub(lanes.sub(lanes.load(q.of(a)), origin), lanes.mul(slope, a_depth));
        let by = lanes.sub(lanes.sub(lanes.load(q.of(b)), origin), lanes.mul(slope, b_depth));
        let cy = lanes.sub(lanes.sub(lanes.load(q.of(c)), origin), lanes.mul(slope, c_depth));
        // Twice the areas that the ray's point spans with the edges opposite to a, b, c, as differences of products.
        let (cb, bc) = (lanes.mul(cx, by), lanes.mul(cy, bx));
        let (ac, ca) = (lanes.mul(ax, cy), lanes.mul(ay, cx));
        let (ba, ab) = (lanes.mul(bx, ay), lanes.mul(by, ax));
        let (u, v, w) = (lanes.sub(cb, bc), lanes.sub(ac, ca), lanes.sub(ba, ab));
        let inside = !lanes.mixed_signs(u, v, w) & 0xFF;
        if inside == 0 {
            return None;
        }

        // The mean of the depths, weighted by the areas.
        let weighted = lanes.add(lanes.mul(u, a_depth), lanes.mul(v, b_depth));
        let weighted = lanes.add(weighted, lanes.mul(w, c_depth));
        let area = lanes.add(lanes.add(u, v), w);
        let share = lanes.div(lanes.splat(1.0), area);
        let inverse = lanes.splat(self.inverse);
        let distance = lanes.mul(lanes.mul(weighted, share), inverse);
        // Rounding moves the areas by a few roundings of their products, and so the mean by as large a part of the span of the
        // depths as these are of the whole area.
        let products =
            lanes.add(lanes.add(lanes.abs(cb), lanes.abs(bc)), lanes.add(lanes.abs(ac), lanes.abs(ca)));
        let products = lanes.add(products, lanes.add(lanes.abs(ba), lanes.abs(ab)));
        let farthest = lanes.max(lanes.max(a_depth, b_depth), c_depth);
        let nearest = lanes.min(lanes.min(a_depth, b_depth), c_depth);
        let span = lanes.mul(lanes.sub(farthest, nearest), lanes.splat(gamma(8) * self.inverse));
        let moved = lanes.abs(lanes.mul(lanes.mul(products, share), span));
        let error = lanes.add(moved, lanes.splat(self.slack));

        let (low, high) = (lanes.sub(distance, error), lanes.add(distance, error));
        let (min, max) = (lanes.splat(min), lanes.splat(max));
        let candidates = inside & !lanes.lt(high, min) & !lanes.lt(max, low);
        // Where a triangle reaches back behind the origin, only its plane can tell.
        let zero = lanes.splat(0.0);
        let ahead =
            lanes.lt(zero, lanes.mul(nearest, inverse)) & lanes.lt(zero, lanes.mul(farthest, inverse));
        (candidates != 0).then_some(Candidates {
            lanes: candidates,
            within: lanes.lt(min, low) & lanes.lt(high, max) & ahead,
            on_edge: lanes.any_zero(u, v, w),
            low,
            high,
        })
    }
}
