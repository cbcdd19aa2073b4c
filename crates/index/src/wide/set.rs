//! Some of many rays: a bit for each.
//!
//! Not a list in memory: the place of each store would depend on what came of the rays before, and every load that may read
//! what was stored lately would wait until all those places are known. That cost more than a third of the time of a walk.

use super::rays::TOGETHER;

/// Some of the rays of a batch. As an iterator it gives their numbers in order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Set(u64);

const _: () = assert!(TOGETHER == u64::BITS as usize);

impl Set {
    pub(crate) const EMPTY: Self = Self(0);

    /// Adds a ray, or does not: without a branch.
    #[inline(always)]
    pub(crate) fn add(&mut self, ray: usize, counts: bool) {
        self.0 |= u64::from(counts) << ray;
    }

    #[inline(always)]
    pub(crate) fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// All that were in it, which leaves it empty.
    #[inline(always)]
    pub(crate) fn take_all(&mut self) -> Self {
        std::mem::replace(self, Self::EMPTY)
    }
}

impl Iterator for Set {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        let ray = self.0.trailing_zeros() as usize % TOGETHER;
        self.0 &= self.0 - 1;
        Some(ray)
    }
}
