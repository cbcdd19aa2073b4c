//! Which primitives a ray has met: a primitive may be named by many leaves.

use std::collections::HashSet;

/// Stands for no primitive; the builder gives no primitive this id.
const NONE: u32 = u32::MAX;

/// Remembers the last few primitives and forgets older ones: sifts out most repeated tests for the price of one
/// comparison.
///
/// # Source
/// Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987 ("mailbox", here per ray).
pub(crate) struct Mailbox([u32; Self::SLOTS]);

impl Mailbox {
    const SLOTS: usize = 16;

    pub(crate) fn new() -> Self {
        Self([NONE; Self::SLOTS])
    }

    /// Whether the primitive may not have been met before; it is remembered.
    #[inline]
    pub(crate) fn is_new(&mut self, primitive: u32) -> bool {
        let slot = &mut self.0[primitive as usize % Self::SLOTS];
        let new = *slot != primitive;
        *slot = primitive;
        new
    }
}

/// Remembers every primitive: the first few dozen in place, more on the heap.
pub(crate) struct Visited {
    table: [u32; Self::SLOTS],
    used: usize,
    more: HashSet<u32>,
}

impl Visited {
    const SLOTS: usize = 128;

    pub(crate) fn new() -> Self {
        Self { table: [NONE; Self::SLOTS], used: 0, more: HashSet::new() }
    }

    /// Whether the primitive is met for the first time.
    pub(crate) fn insert(&mut self, primitive: u32) -> bool {
        // Spread neighbouring ids by a multiplicative hash: 2^32 over the golden ratio.
        let mut slot = (primitive.wrapping_mul(0x9E37_79B9) >> 25) as usize % Self::SLOTS;
        loop {
            let entry = self.table[slot];
            if entry == primitive {
                return false;
            }
            if entry == NONE {
                break;
            }
            slot = (slot + 1) % Self::SLOTS;
        }
        // A quarter stays free, so that probing ends and stays short.
        if self.used < Self::SLOTS / 4 * 3 {
            self.table[slot] = primitive;
            self.used += 1;
            return true;
        }
        self.more.insert(primitive)
    }
}

#[cfg(test)]
mod tests {
    use super::{Mailbox, Visited};

    #[test]
    fn visited_says_each_id_once() {
        let mut visited = Visited::new();
        // More than the table holds, with equal hashes among them, twice over.
        let ids = || (0..500_u32).map(|i| i * 64);
        assert!(ids().all(|i| visited.insert(i)));
        assert!(!ids().any(|i| visited.insert(i)));
    }

    #[test]
    fn mailbox_never_calls_a_new_one_old() {
        let mut mailbox = Mailbox::new();
        assert!((0..100).all(|i| mailbox.is_new(i)));
        assert!(!mailbox.is_new(99));
    }
}
