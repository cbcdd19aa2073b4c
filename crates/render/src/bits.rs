//! Sets of small numbers as bits.

/// The places of the bits that are set, ascending.
#[inline]
pub(crate) fn places(mut set: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        if set == 0 {
            return None;
        }
        let lowest = set.trailing_zeros() as usize;
        set &= set - 1;
        Some(lowest)
    })
}

/// The lowest `n` bits, up to all.
pub(crate) fn lowest(n: usize) -> u64 {
    if n < u64::BITS as usize { (1 << n) - 1 } else { u64::MAX }
}
