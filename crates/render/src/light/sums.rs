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
    (i, rest(sums, i, position))
}

/// Entries that share a guide.
const GUIDED: usize = 4;

/// How many guides so many entries have.
pub(super) fn guides(entries: usize) -> usize {
    entries.div_ceil(GUIDED)
}

/// Guides to running sums: the entries from which on [`pick_guided`] looks, for even steps of `u`.
///
/// # Source
/// Chen, Asau, "On Generating Random Variates from an Empirical Distribution", AIIE Transactions 1974.
pub(super) fn guide(sums: &[f64]) -> impl Iterator<Item = u32> {
    let count = guides(sums.len());
    (0..count).map(move |k| {
        let position = k as f64 / count as f64 * total(sums);
        sums.partition_point(|&sum| sum <= position).min(sums.len() - 1) as u32
    })
}

/// [`pick`] by the guides of the sums: a few steps, wherever the entry is.
#[inline]
pub(super) fn pick_guided(sums: &[f64], guides: &[u32], u: f32) -> (usize, f32) {
    let position = f64::from(u) * total(sums);
    let step = (f64::from(u) * guides.len() as f64) as usize;
    let mut i = guides[step.min(guides.len() - 1)] as usize;
    // Rounding may have led too far.
    while i > 0 && sums[i - 1] > position {
        i -= 1;
    }
    while sums[i] <= position && i + 1 < sums.len() {
        i += 1;
    }
    (i, rest(sums, i, position))
}

/// Where in entry `i` a position lies, in `[0, 1)`.
#[inline]
fn rest(sums: &[f64], i: usize, position: f64) -> f32 {
    let before = if i == 0 { 0.0 } else { sums[i - 1] };
    let rest = ((position - before) / (sums[i] - before)) as f32;
    rest.clamp(0.0, 1.0_f32.next_down())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn guides_lead_to_the_same_entry(
            shares in prop::collection::vec(prop_oneof![Just(0.0), 0.0_f64..1.0, 0.0_f64..1e9], 1..40),
            u in 0.0_f32..1.0,
        ) {
            let sums: Vec<_> = running(shares).collect();
            prop_assume!(total(&sums) > 0.0);
            let guides: Vec<_> = guide(&sums).collect();
            for u in [0.0, u, 1.0_f32.next_down()] {
                prop_assert_eq!(pick_guided(&sums, &guides, u), pick(&sums, u));
            }
        }
    }
}
