//! Eight triangles side by side, and the test of a ray against all of them.
//!
//! The lanes answer which triangles a ray may meet, in the very arithmetic of [`heliostat_geometry::triangle::intersect`], and
//! where, with a bound of the error; that function then says exactly where, for the one triangle that counts. So a hit is what
//! it is for any other caller of that function, to the bit.

use crate::simd::{LANES, Lanes, Pick, Row};
use glam::Vec3;
use heliostat_geometry::error_bound::gamma;
use heliostat_geometry::triangle::{TriangleHit, TriangleRay, intersect_inside, is_flat};
use heliostat_geometry::{Interval, Ray};

/// Eight triangles: for each axis a row of the corners a, of b and of c.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(super) struct Block([[Row; 3]; 3]);

impl Block {
    /// Triangles side by side; in the place of one that is missing lies a point.
    pub(super) fn new(triangles: impl Iterator<Item = Option<[Vec3; 3]>>) -> Self {
        let mut block = Self([[Row([0.0; LANES]); 3]; 3]);
        for (lane, corners) in triangles.enumerate() {
            let Some(corners) = corners else { continue };
            for (axis, rows) in block.0.iter_mut().enumerate() {
                for (row, corner) in rows.iter_mut().zip(corners) {
                    row.0[lane] = corner[axis];
                }
            }
        }
        block
    }

    /// A bit for each triangle with an area. Others are never met; so what the lanes are certain of among these is a hit.
    pub(super) fn present(&self) -> u8 {
        (0..LANES).fold(0, |bits, lane| bits | u8::from(!is_flat(self.corners(lane))) << lane)
    }

    /// The corners of a triangle.
    pub(super) fn corners(&self, lane: usize) -> [Vec3; 3] {
        let corner = |i: usize| Vec3::from_array(std::array::from_fn(|axis| self.0[axis][i].0[lane]));
        [corner(0), corner(1), corner(2)]
    }
}

/// A ray as blocks see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockRay {
    /// The axes in cyclic order, the one along which the ray runs fastest last.
    x: Axis,
    y: Axis,
    z: Axis,
    turned: TriangleRay,
}

type Axis = Pick<[Row; 3], 3>;

/// The axes in cyclic order, for each that may be the last.
static AXES: [[Axis; 3]; 3] = {
    let [x, y, z] = [Axis::new(0), Axis::new(1), Axis::new(2)];
    [[y, z, x], [z, x, y], [x, y, z]]
};

/// Triangles of a block that a ray may meet.
pub(super) struct Candidates<F> {
    /// A bit for each.
    pub(super) lanes: u32,
    /// A bit for each that is surely met between the distances asked for.
    pub(super) certain: u32,
    /// Bounds of the distances.
    pub(super) low: F,
    pub(super) high: F,
}

impl BlockRay {
    #[inline(always)]
    pub(super) fn new(lanes: impl Lanes, ray: &Ray) -> Self {
        let along = TriangleRay::main_axis(ray.dir.into());
        let origin = lanes.turned(along, ray.origin.into());
        let dir = lanes.turned(along, ray.dir.into());
        let [x, y, z] = AXES[along % 3];
        Self { x, y, z, turned: TriangleRay::from_turned(along, origin, dir) }
    }

    /// The exact hit of a triangle that the lanes are certain of; `None` where that is better left to [`intersect`].
    ///
    /// [`intersect`]: heliostat_geometry::triangle::intersect
    #[inline(always)]
    pub(super) fn certain_hit(&self, block: &Block, lane: usize) -> Option<TriangleHit> {
        let [x, y, z] = [self.x.of(&block.0), self.y.of(&block.0), self.z.of(&block.0)];
        let lane = Pick::<f32, LANES>::new(lane);
        let corner = |i: usize| Vec3::new(lane.alone(&x[i].0), lane.alone(&y[i].0), lane.alone(&z[i].0));
        intersect_inside(&self.turned, [corner(0), corner(1), corner(2)])
    }

    /// The triangles among those present that may be hit between the distances `min` and `max`.
    #[inline(always)]
    pub(super) fn meet<L: Lanes>(
        &self,
        lanes: L,
        block: &Block,
        present: u8,
        Interval { min, max }: Interval,
    ) -> Option<Candidates<L::F>> {
        // Look down the ray. (No `map` of arrays here: the compiler does not make it part of the function, and out of line it
        // knows nothing of the lanes.)
        let [a, b, c] = self.z.of(&block.0);
        let origin = lanes.splat(self.turned.origin().z);
        let a_depth = lanes.sub(lanes.load(a), origin);
        let b_depth = lanes.sub(lanes.load(b), origin);
        let c_depth = lanes.sub(lanes.load(c), origin);
        let [a, b, c] = self.x.of(&block.0);
        let (origin, slope) = (lanes.splat(self.turned.origin().x), lanes.splat(self.turned.slope().x));
        let ax = lanes.sub(lanes.sub(lanes.load(a), origin), lanes.mul(slope, a_depth));
        let bx = lanes.sub(lanes.sub(lanes.load(b), origin), lanes.mul(slope, b_depth));
        let cx = lanes.sub(lanes.sub(lanes.load(c), origin), lanes.mul(slope, c_depth));
        let [a, b, c] = self.y.of(&block.0);
        let (origin, slope) = (lanes.splat(self.turned.origin().y), lanes.splat(self.turned.slope().y));
        let ay = lanes.sub(lanes.sub(lanes.load(a), origin), lanes.mul(slope, a_depth));
        let by = lanes.sub(lanes.sub(lanes.load(b), origin), lanes.mul(slope, b_depth));
        let cy = lanes.sub(lanes.sub(lanes.load(c), origin), lanes.mul(slope, c_depth));
        // Twice the areas that the ray's point spans with the edges opposite to a, b, c, as differences of products.
        let u = lanes.sub(lanes.mul(cx, by), lanes.mul(cy, bx));
        let v = lanes.sub(lanes.mul(ax, cy), lanes.mul(ay, cx));
        let w = lanes.sub(lanes.mul(bx, ay), lanes.mul(by, ax));
        let inside = !lanes.mixed_signs(u, v, w) & u32::from(present);
        if inside == 0 {
            return None;
        }

        // The mean of the depths, weighted by the areas.
        let weighted = lanes.mul_add(w, c_depth, lanes.mul_add(v, b_depth, lanes.mul(u, a_depth)));
        let share = lanes.div(lanes.splat(1.0), lanes.add(lanes.add(u, v), w));
        let distance = lanes.mul(lanes.mul(weighted, share), lanes.splat(self.turned.slope().z));
        let farthest = lanes.max(lanes.max(a_depth, b_depth), c_depth);
        let nearest = lanes.min(lanes.min(a_depth, b_depth), c_depth);
        let x = lanes.larger_size(lanes.larger_size(ax, bx), cx);
        let y = lanes.larger_size(lanes.larger_size(ay, by), cy);
        let size = lanes.larger_size(x, y);
        let reach = lanes.add(lanes.larger_size(nearest, farthest), size);
        let error = self.error(lanes, reach, size, lanes.mul(lanes.sub(farthest, nearest), share));

        let (low, high) = (lanes.sub(distance, error), lanes.add(distance, error));
        let (min, max) = (lanes.splat(min), lanes.splat(max));
        let candidates = inside & !lanes.lt(high, min) & !lanes.lt(max, low);
        (candidates != 0).then_some(Candidates {
            lanes: candidates,
            certain: candidates & lanes.lt(min, low) & lanes.lt(high, max) & !lanes.any_zero(u, v, w),
            low,
            high,
        })
    }

    /// Bound of how far the distance of a hit may lie from the exact one, or from that of the plane of the triangle.
    ///
    /// The corners lie up to `reach` from the origin along an axis, up to `size` beside the ray; `span` is the difference of
    /// their depths over the area. Rounding moves the corners across the ray by up to `shift`
    /// ([`heliostat_geometry::error_bound::sheared_corner`]). With the rounding of the products that moves the three areas,
    /// together, by up to `18 * shift * (size + shift)`, and the mean by as large a part of the span as this is of the whole
    /// area; twice that, where the ray misses the moved triangle by so little. And the mean itself is rounded.
    #[inline(always)]
    fn error<L: Lanes>(&self, lanes: L, reach: L::F, size: L::F, span: L::F) -> L::F {
        let shift = lanes.mul(reach, lanes.splat(gamma(6)));
        let turn = lanes.mul(lanes.add(size, shift), lanes.larger_size(span, span));
        let part = lanes.mul_add(turn, lanes.splat(36.0), lanes.splat(4.0));
        lanes.mul(lanes.mul(shift, lanes.splat(self.turned.slope().z.abs())), part)
    }
}
