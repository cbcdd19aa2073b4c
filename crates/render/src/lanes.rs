//! Loops over lanes, compiled for the widest vectors of the machine that they run on.
//!
//! Work in lanes is plain arithmetic over arrays: no branches, the same for all lanes, so that the compiler does four, eight
//! or more of them with one instruction. [`widest`] holds it compiled more than once and chooses at run time. All
//! versions do the same operations in the same order (products and sums are never fused), so that bits do not depend on
//! the machine.

use crate::bits;
use glam::Vec3;
use pulp::{Arch, NullaryFnOnce};

/// Lanes at once.
pub(crate) const LANES: usize = 16;

/// A number per lane.
pub(crate) type Lanes = [f32; LANES];

/// A yes or no per lane; bit `i` for lane `i`.
pub(crate) type Mask = u16;

/// A vector per lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vec3Lanes {
    pub(crate) x: Lanes,
    pub(crate) y: Lanes,
    pub(crate) z: Lanes,
}

impl Vec3Lanes {
    /// The same in all lanes.
    #[inline(always)]
    pub(crate) fn splat(v: Vec3) -> Self {
        Self { x: [v.x; LANES], y: [v.y; LANES], z: [v.z; LANES] }
    }

    /// The vector of a lane.
    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    /// Changes the vector of a lane.
    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: Vec3) {
        (self.x[lane], self.y[lane], self.z[lane]) = (v.x, v.y, v.z);
    }
}

/// Does work in lanes with the widest vectors there are. All that it calls must be `#[inline(always)]`.
#[inline(always)]
pub(crate) fn widest<W: NullaryFnOnce>(work: W) -> W::Output {
    Arch::new().dispatch(work)
}

/// The lanes where something holds.
#[expect(clippy::needless_range_loop, reason = "a lane is a number")]
#[inline(always)]
pub(crate) fn mask(holds: impl Fn(usize) -> bool) -> Mask {
    // As wide as the numbers that are compared, so that both fit into the same vectors.
    let mut bits = [0_u32; LANES];
    for i in 0..LANES {
        bits[i] = if holds(i) { 1 << i } else { 0 };
    }
    bits.into_iter().fold(0, |all, bit| all | bit) as Mask
}

/// Whether a lane belongs to a mask.
#[inline(always)]
pub(crate) fn holds(mask: Mask, lane: usize) -> bool {
    u32::from(mask) & (1 << lane) != 0
}

/// The lanes of a mask, ascending.
pub(crate) fn lanes_of(mask: Mask) -> impl Iterator<Item = usize> {
    bits::places(u64::from(mask))
}

/// The sum of all lanes, by pairs: always in the same order.
#[inline(always)]
pub(crate) fn sum(mut lanes: Lanes) -> f32 {
    let mut width = LANES / 2;
    while width > 0 {
        for i in 0..width {
            lanes[i] += lanes[i + width];
        }
        width /= 2;
    }
    lanes[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_and_sums() {
        let numbers: Lanes = std::array::from_fn(|i| i as f32);
        assert_eq!(sum(numbers), 120.0);
        let odd = mask(|i| i % 2 == 1);
        assert_eq!(odd, 0xaaaa);
        assert_eq!(lanes_of(odd).collect::<Vec<_>>(), [1, 3, 5, 7, 9, 11, 13, 15]);
        assert_eq!(lanes_of(0).count(), 0);
    }
}
