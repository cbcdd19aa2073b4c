//! Boxes of a few things, all asked at once.

use super::BoxRay;
use crate::lanes::widest;
use heliostat_geometry::error_bound::cell_padding;
use heliostat_geometry::{Aabb, Ray};
use pulp::NullaryFnOnce;

/// So many boxes at once.
pub(in crate::world) const FEW: usize = 8;

/// A number per box.
type Row = [f32; FEW];

/// Up to [`FEW`] boxes, by axes.
#[derive(Clone, Debug)]
pub(in crate::world) struct FewBoxes {
    min: [Row; 3],
    max: [Row; 3],
    /// Largest coordinate of each.
    reach: Row,
    /// A bit for each place with a box.
    filled: u8,
}

/// Where a ray may enter the boxes, up to its end.
#[derive(Clone, Copy, Debug)]
pub(in crate::world) struct Entries {
    /// A bit for each box that it may meet.
    pub(in crate::world) may_meet: u8,
    near: Row,
}

impl Entries {
    /// Whether the ray may meet what lies in a box up to `end`, where that has come nearer since it was asked.
    #[inline(always)]
    pub(in crate::world) fn before(&self, i: usize, end: f32) -> bool {
        let is_behind = self.near[i] > end;
        !is_behind
    }
}

impl FewBoxes {
    /// Of at most [`FEW`] boxes.
    pub(in crate::world) fn new(boxes: &[Aabb]) -> Self {
        let nothing = [[0.0; FEW]; 3];
        let mut few = Self { min: nothing, max: nothing, reach: [0.0; FEW], filled: 0 };
        for (i, bounds) in boxes.iter().take(FEW).enumerate() {
            for axis in 0..3 {
                (few.min[axis][i], few.max[axis][i]) = (bounds.min[axis], bounds.max[axis]);
            }
            few.reach[i] = bounds.min.abs().max(bounds.max.abs()).max_element();
            few.filled |= 1 << i;
        }
        few
    }

    /// [`BoxRay::may_meet`] for all boxes.
    #[inline]
    pub(in crate::world) fn entries(&self, ray: &Ray) -> Entries {
        widest(Enter { boxes: self, ray: BoxRay::new(ray), end: ray.range.max })
    }
}

/// The work of [`FewBoxes::entries`].
struct Enter<'a> {
    boxes: &'a FewBoxes,
    ray: BoxRay,
    end: f32,
}

impl NullaryFnOnce for Enter<'_> {
    type Output = Entries;

    #[inline(always)]
    fn call(self) -> Entries {
        let Self { boxes, ray, end } = self;
        let (mut near, mut far) = ([ray.start; FEW], [end; FEW]);
        for axis in 0..3 {
            let (origin, inverse) = (ray.origin[axis], ray.inverse[axis]);
            for i in 0..FEW {
                let reach = ray.reach + boxes.reach[i];
                let padding = cell_padding(reach, reach) * inverse.abs();
                let a = (boxes.min[axis][i] - origin) * inverse;
                let b = (boxes.max[axis][i] - origin) * inverse;
                let (first, last) = if a < b { (a, b) } else { (b, a) };
                let (first, last) = (first - padding, last + padding);
                near[i] = if near[i] < first { first } else { near[i] };
                far[i] = if last < far[i] { last } else { far[i] };
            }
        }
        let mut bits = [0_u32; FEW];
        for i in 0..FEW {
            // A NaN, from numbers that overflow, does not say that it misses.
            bits[i] = if near[i] > far[i] { 0 } else { 1 << i };
        }
        let may_meet = bits.into_iter().fold(0, |all, bit| all | bit) as u8 & boxes.filled;
        Entries { may_meet, near }
    }
}
