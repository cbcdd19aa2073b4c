//! Eight triangles side by side, and the test of a ray against all of them.
//!
//! The lanes answer which triangles a ray may meet, in the very arithmetic of [`heliostat_geometry::triangle::intersect`], and
//! where, with a bound of the error; that function then says exactly where, for the one triangle that counts. So a hit is what
//! it is for any other caller of that function, to the bit.

use super::seen::Eye;
use crate::simd::{LANES, Lanes, Pick, Row};
use glam::Vec3;
use heliostat_geometry::triangle::{TriangleHit, TriangleRay, intersect_inside, is_flat};
use heliostat_geometry::{Interval, Ray};

/// Eight triangles.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(super) struct Block {
    pub(super) rows: Rows,
}

/// What is known of a block; apart from it, because rows are whole cache lines and this would fill up another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tag {
    /// The largest extent of a triangle along an axis.
    pub(super) extent: f32,
    /// A bit for each triangle with an area. Others are never met; so what the lanes are certain of among these is a hit.
    pub(super) present: u32,
}

impl Tag {
    pub(super) fn of(block: &Block) -> Self {
        let mut tag = Self { extent: 0.0, present: 0 };
        for (lane, corners @ [a, b, c]) in (0..LANES).map(|lane| (lane, block.corners(lane))) {
            tag.extent = tag.extent.max((a.max(b).max(c) - a.min(b).min(c)).max_element());
            tag.present |= u32::from(!is_flat(corners)) << lane;
        }
        tag
    }
}

/// For each axis a row of the corners a, of b and of c.
pub(super) type Rows = [[Row; 3]; 3];

impl Block {
    /// Triangles side by side; in the place of one that is missing lies a point.
    pub(super) fn new(triangles: impl Iterator<Item = Option<[Vec3; 3]>>) -> Self {
        let mut block = Self { rows: [[Row([0.0; LANES]); 3]; 3] };
        for (lane, corners) in triangles.enumerate() {
            let Some(corners) = corners else { continue };
            for (axis, rows) in block.rows.iter_mut().enumerate() {
                for (row, corner) in rows.iter_mut().zip(corners) {
                    row.0[lane] = corner[axis];
                }
            }
        }
        block
    }

    /// The corners of a triangle.
    pub(super) fn corners(&self, lane: usize) -> [Vec3; 3] {
        let corner = |i: usize| Vec3::from_array(std::array::from_fn(|axis| self.rows[axis][i].0[lane]));
        [corner(0), corner(1), corner(2)]
    }
}

/// A ray as blocks see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockRay {
    /// The axes in cyclic order, the one along which the ray runs fastest last.
    axes: [Axis; 3],
    turned: TriangleRay,
}

/// The rows of an axis.
pub(super) type Axis = Pick<[Row; 3], 3>;

/// The axes in cyclic order, for each that may be the last.
pub(super) static AXES: [[Axis; 3]; 3] = {
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
        Self { axes: AXES[along % 3], turned: TriangleRay::from_turned(along, origin, dir) }
    }

    /// The exact hit of a triangle that the lanes are certain of; `None` where that is better left to [`intersect`].
    ///
    /// [`intersect`]: heliostat_geometry::triangle::intersect
    #[inline(always)]
    pub(super) fn certain_hit(&self, block: &Block, lane: usize) -> Option<TriangleHit> {
        let [x, y, z] = self.axes;
        let [x, y, z] = [x.of(&block.rows), y.of(&block.rows), z.of(&block.rows)];
        let lane = Pick::<f32, LANES>::new(lane);
        let corner = |i: usize| Vec3::new(lane.alone(&x[i].0), lane.alone(&y[i].0), lane.alone(&z[i].0));
        intersect_inside(&self.turned, [corner(0), corner(1), corner(2)])
    }

    /// The triangles that may be hit between the distances `min` and `max`.
    #[inline(always)]
    pub(super) fn meet<L: Lanes>(
        &self,
        lanes: L,
        (block, tag): (&Block, &Tag),
        Interval { min, max }: Interval,
    ) -> Option<Candidates<L::F>> {
        let (origin, slope) = (self.turned.origin(), self.turned.slope());
        let eye = Eye::<L> {
            axes: self.axes,
            origin: [lanes.splat(origin.x), lanes.splat(origin.y), lanes.splat(origin.z)],
            slope: [lanes.splat(slope.x), lanes.splat(slope.y)],
        };
        let seen = eye.see(lanes, &block.rows);
        let inside = seen.inside(lanes) & tag.present;
        if inside == 0 {
            return None;
        }
        let (low, high) = seen.bounds(lanes, slope.z);
        let (min, max) = (lanes.splat(min), lanes.splat(max));
        let candidates = inside & !lanes.lt(high, min) & !lanes.lt(max, low);
        (candidates != 0).then_some(Candidates {
            lanes: candidates,
            certain: candidates & lanes.lt(min, low) & lanes.lt(high, max) & !seen.at_edge(lanes),
            low,
            high,
        })
    }
}
