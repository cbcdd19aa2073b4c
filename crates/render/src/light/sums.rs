//! Choices by share, from running sums in `f64`: entry `i` holds the shares up to and including that of `i`.

use std::ops::Range;

/// The running sums of shares that are at least 0.
pub(super) fn running(shares: impl IntoIterator<Item = f64>) -> impl Iterator<Item = f64> {
    shares.into_iter().scan(0.0, |sum, share| {
        *sum += share;
        Some(*sum)
    })
}

/// The sum of all shares; 0 without any.
#[inline]
pub(super) fn total(sums: &[f64]) -> f64 {
    sums.last().copied().unwrap_or(0.0)
}

/// The share of entry `i`.
#[inline]
pub(super) fn share(sums: &[f64], i: usize) -> f64 {
    sums[i] - if i == 0 { 0.0 } else { sums[i - 1] }
}

/// An entry with probability by its share for `u` in `[0, 1)`, and what is left of `u`: uniform, for the next choice.
///
/// The total must be above 0.
#[inline]
pub(super) fn pick(sums: &[f64], u: f32) -> (usize, f32) {
    pick_in(sums, 0..sums.len(), u)
}

/// The sum of the shares of some entries.
#[inline]
pub(super) fn total_in(sums: &[f64], range: Range<usize>) -> f64 {
    total(&sums[..range.end]) - total(&sums[..range.start])
}

/// [`pick`] among some entries, at least one.
#[inline]
pub(super) fn pick_in(sums: &[f64], range: Range<usize>, u: f32) -> (usize, f32) {
    let position = total(&sums[..range.start]) + f64::from(u) * total_in(sums, range.clone());
    let found = range.start + sums[range.clone()].partition_point(|&sum| sum <= position);
    let i = found.min(range.end - 1);
    let before = if i == 0 { 0.0 } else { sums[i - 1] };
    let rest = ((position - before) / (sums[i] - before)) as f32;
    (i, rest.clamp(0.0, 1.0_f32.next_down()))
}
