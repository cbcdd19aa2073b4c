//! The plane that the surface area heuristic likes best.
//!
//! Large cells are sampled at the borders of bins; small ones are swept exactly, at the ends of all boxes.
//! Costs are in `f64`; areas are those of the cells, because the walk meets cells, not boxes.
//!
//! # Source
//! Wald and Havran, "On building fast kd-trees for ray tracing, and on doing that in O(N log N)", 2006 (sweep,
//! flat boxes); Shevtsov, Soupikov, Kapustin, "Highly parallel fast kd-tree construction", 2007 (bins).

use super::params::SahCosts;
use super::split::{Plane, Reference};
use heliostat_geometry::Aabb;

/// Bins per axis.
const BINS: usize = 64;

/// Up to so many references all candidate planes are swept.
const SWEEP_LIMIT: usize = 256;

/// A plane with its expected cost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choice {
    pub(crate) plane: Plane,
    pub(crate) cost: f64,
}

/// Buffers that are used again for every cell.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    lows: Vec<f32>,
    highs: Vec<f32>,
    flats: Vec<f32>,
}

/// The cheapest plane that duplicates at most `budget` references; `None` when none separates anything.
pub(crate) fn choose(
    refs: &[Reference],
    cell: Aabb,
    costs: SahCosts,
    budget: usize,
    scratch: &mut Scratch,
) -> Option<Choice> {
    let mut best = Best::new(refs.len(), cell, costs, budget);
    for axis in 0..3 {
        if refs.len() <= SWEEP_LIMIT {
            sweep(refs, axis, scratch, &mut best);
        } else {
            scan_bins(refs, axis, &mut best);
        }
    }
    best.choice
}

/// The best candidate so far, and what is needed to judge the next.
struct Best {
    count: usize,
    cell: Aabb,
    costs: SahCosts,
    budget: usize,
    choice: Option<Choice>,
}

impl Best {
    fn new(count: usize, cell: Aabb, costs: SahCosts, budget: usize) -> Self {
        Self { count, cell, costs, budget, choice: None }
    }

    /// Judges the plane that has so many references on either side.
    fn offer(&mut self, axis: usize, position: f32, left: usize, right: usize) {
        let inside = self.cell.min[axis] < position && position < self.cell.max[axis];
        let separates = left < self.count || right < self.count;
        let within_budget = left + right <= self.count + self.budget;
        if !(inside && separates && within_budget) {
            return;
        }
        let plane = Plane { axis, position };
        let cost = self.cost(plane, left, right);
        if self.choice.is_none_or(|best| cost < best.cost) {
            self.choice = Some(Choice { plane, cost });
        }
    }

    /// Expected work for a ray that meets the cell.
    fn cost(&self, plane: Plane, left: usize, right: usize) -> f64 {
        let (l, r) = plane.cut(self.cell);
        let area = self.cell.surface_area();
        let tests = (l.surface_area() * left as f64 + r.surface_area() * right as f64) / area;
        let bonus = if left == 0 || right == 0 { 1.0 - self.costs.empty_bonus } else { 1.0 };
        self.costs.traversal + bonus * self.costs.intersection * tests
    }
}

/// Judges a plane at every end of every box.
fn sweep(refs: &[Reference], axis: usize, scratch: &mut Scratch, best: &mut Best) {
    let Scratch { lows, highs, flats } = scratch;
    lows.clear();
    highs.clear();
    flats.clear();
    for r in refs {
        let (low, high) = (r.bounds.min[axis], r.bounds.max[axis]);
        lows.push(low);
        highs.push(high);
        if low == high {
            flats.push(low);
        }
    }
    lows.sort_unstable_by(f32::total_cmp);
    highs.sort_unstable_by(f32::total_cmp);
    flats.sort_unstable_by(f32::total_cmp);

    let (mut low, mut high, mut flat) = (0, 0, 0);
    while low < lows.len() || high < highs.len() {
        // The next end of any box; there are no more lows than highs ahead.
        let position = lows.get(low).map_or(highs[high], |&l| l.min(highs[high]));
        let flat_before = flat;
        while flats.get(flat).is_some_and(|&f| f <= position) {
            flat += 1;
        }
        let flat_here = flat - flat_before;
        if flat_here > 0 {
            // Boxes in the plane go left; just below it, they go right.
            best.offer(axis, position.next_down(), low, refs.len() - high);
        }
        while highs.get(high).is_some_and(|&h| h <= position) {
            high += 1;
        }
        best.offer(axis, position, low + flat_here, refs.len() - high);
        while lows.get(low).is_some_and(|&l| l <= position) {
            low += 1;
        }
    }
}

/// Judges planes at the borders of equal bins over the content of the cell.
fn scan_bins(refs: &[Reference], axis: usize, best: &mut Best) {
    let (low, high) = refs.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), r| {
        (low.min(r.bounds.min[axis]), high.max(r.bounds.max[axis]))
    });
    // Empty space on either side of the content is cut off at its very end.
    best.offer(axis, low.next_down(), 0, refs.len());
    best.offer(axis, high, refs.len(), 0);

    let scale = BINS as f64 / (f64::from(high) - f64::from(low));
    if !scale.is_finite() {
        return;
    }
    let bin = |x: f32| (((f64::from(x) - f64::from(low)) * scale) as usize).min(BINS - 1);
    let (mut starts, mut ends) = ([0_usize; BINS], [0_usize; BINS]);
    for r in refs {
        starts[bin(r.bounds.min[axis])] += 1;
        ends[bin(r.bounds.max[axis])] += 1;
    }
    let (mut left, mut right) = (0, refs.len());
    for border in 1..BINS {
        left += starts[border - 1];
        right -= ends[border - 1];
        let position = (f64::from(low) + border as f64 / scale) as f32;
        best.offer(axis, position, left, right);
    }
}
