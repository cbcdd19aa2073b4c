//! The plane that the surface area heuristic likes best.
//!
//! Ends of boxes are counted in bins. A plane between two bins is moved to the last end before the border, so that it cuts
//! no box that merely ends near it: with as few references as lie near the leaves, that is as good as trying every end.
//! Costs are in `f64`. Areas are those of the boxes around the content on either side, because these, not the cells, are
//! what rays are compared with.
//!
//! # Source
//! Wald and Havran, "On building fast kd-trees for ray tracing, and on doing that in O(N log N)", 2006 (clipped boxes);
//! Shevtsov, Soupikov, Kapustin, "Highly parallel fast kd-tree construction", 2007 (bins); Stich, Friedrich, Dietrich,
//! "Spatial Splits in Bounding Volume Hierarchies", HPG 2009 (content on either side of a plane from the same bins).

use super::reference::{Around, Reference};
use crate::bsp::params::LeafCosts;
use crate::bsp::split::Plane;
use glam::Vec4;
use heliostat_geometry::Aabb;

/// A plane with its expected cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Choice {
    pub(super) plane: Plane,
    pub(super) cost: f64,
}

/// What begins or ends in a bin.
#[derive(Clone, Copy)]
struct Bin {
    around: Around,
    count: u32,
}

impl Bin {
    const EMPTY: Self = Self { around: Around::NOTHING, count: 0 };

    #[inline(always)]
    fn add(&mut self, low: Vec4, high: Vec4) {
        self.around.add(low, high);
        self.count += 1;
    }

    fn merge(&mut self, other: &Self) {
        self.around = self.around.union(other.around);
        self.count += other.count;
    }
}

/// `N` bins, a power of two, along each of the three axes.
pub(super) struct Bins<const N: usize> {
    /// References by their lower ends.
    starts: [[Bin; N]; 3],
    /// References by their upper ends.
    ends: [[Bin; N]; 3],
    /// The lower corner of the content.
    origin: Vec4,
    /// Bins per length.
    scale: Vec4,
}

impl<const N: usize> Bins<N> {
    /// Empty bins over `content`.
    pub(super) fn new(content: Around) -> Self {
        let scale = (N as f32 * 0.9999) / (content.high - content.low);
        // An axis without extent has one bin.
        let scale = Vec4::select(scale.is_finite_mask(), scale, Vec4::ZERO);
        Self { starts: [[Bin::EMPTY; N]; 3], ends: [[Bin::EMPTY; N]; 3], origin: content.low, scale }
    }

    /// Counts references.
    pub(super) fn add(&mut self, refs: &[Reference]) {
        // Added to numbers of bins, this leaves their integer part in the low bits.
        let shift = Vec4::splat((1 << 23) as f32 - 0.5);
        let last = Vec4::splat((1 << 23) as f32 + N as f32 - 1.0);
        let first = Vec4::splat((1 << 23) as f32);
        for r in refs {
            let (low, high) = r.corners();
            let bin = |corner: Vec4| {
                let at = ((corner - self.origin) * self.scale + shift).min(last).max(first);
                at.to_array().map(|x| x.to_bits() as usize % N)
            };
            let (from, to) = (bin(low), bin(high));
            for axis in 0..3 {
                self.starts[axis][from[axis]].add(low, high);
                self.ends[axis][to[axis]].add(low, high);
            }
        }
    }

    /// Adds what was counted elsewhere, in bins over the same content.
    pub(super) fn merge(&mut self, other: &Self) {
        for axis in 0..3 {
            for i in 0..N {
                self.starts[axis][i].merge(&other.starts[axis][i]);
                self.ends[axis][i].merge(&other.ends[axis][i]);
            }
        }
    }

    /// The cheapest plane that duplicates at most `budget` of `count` references; `None` when none separates anything.
    pub(super) fn choose(
        &self,
        count: usize,
        content: Around,
        cell: Aabb,
        costs: &LeafCosts,
        budget: usize,
    ) -> Option<Choice> {
        let scale = 1.0 / content.half_area();
        let mut best: Option<Choice> = None;
        for axis in 0..3 {
            let (starts, ends) = (&self.starts[axis], &self.ends[axis]);
            let after = Self::ends_after(ends);
            let first_starts = Self::starts_after(starts, axis);
            let mut before = Bin::EMPTY;
            let mut last_end = f32::NEG_INFINITY;
            for border in 1..N {
                let (start, end) = (&starts[border - 1], &ends[border - 1]);
                before.merge(start);
                last_end = last_end.max(end.around.high.as_ref()[axis]);
                // As good as the border before.
                if border > 1 && start.count == 0 && end.count == 0 {
                    continue;
                }
                let (left, right) = (before.count, after[border].count);
                let (on_left, on_right) = (left as usize, right as usize);
                let separates = on_left < count || on_right < count;
                // The plane will cut no more than that: what it cuts begins below the border and ends above.
                if !(separates && on_left + on_right <= count + budget) {
                    continue;
                }
                // Between the last end below the border and the first start above it, all planes cut the same boxes.
                let is_inside = |position: f32| cell.min[axis] < position && position < cell.max[axis];
                let Some(position) = [last_end, first_starts[border]].into_iter().find(|p| is_inside(*p))
                else {
                    continue;
                };
                let (mut below, mut above) = (before.around, after[border].around);
                below.high[axis] = below.high[axis].min(position);
                above.low[axis] = above.low[axis].max(position);
                let tests = below.half_area() * costs.leaf(left) + above.half_area() * costs.leaf(right);
                let cost = costs.traversal + scale * tests;
                if best.is_none_or(|best| cost < best.cost) {
                    best = Some(Choice { plane: Plane { axis, position }, cost });
                }
            }
        }
        best
    }

    /// For each bin the first start in it or later.
    fn starts_after(starts: &[Bin; N], axis: usize) -> [f32; N] {
        let mut firsts = [f32::INFINITY; N];
        let mut first = f32::INFINITY;
        for (i, start) in starts.iter().enumerate().rev() {
            first = first.min(start.around.low.as_ref()[axis]);
            firsts[i] = first;
        }
        firsts
    }

    /// For each bin what ends in it or later.
    fn ends_after(ends: &[Bin; N]) -> [Bin; N] {
        let mut sums = *ends;
        let mut sum = Bin::EMPTY;
        for bin in sums.iter_mut().rev() {
            bin.merge(&sum);
            sum = *bin;
        }
        sums
    }
}
