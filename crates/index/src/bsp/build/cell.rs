//! A cell: where it is cut, and into what.

use super::blur::{Blur, grow};
use super::reference::{Around, Reference};
use super::sah::{Bins, MAX_BINS};
use crate::bsp::params::{BuildParams, SahCosts, SplitRule};
use crate::bsp::split::{Plane, Side};
use crate::parallel;
use crate::primitives::Primitives;
use heliostat_geometry::Aabb;

/// How many splits in a row may bring nothing before a cell is left as it is.
const MAX_WASTED: u32 = 3;

/// A cell above this size may be cut at a loss, hoping that its parts are cut at a gain.
const HOPE_ABOVE: usize = 16;

/// References that one thread looks at before another could take its turn.
const CHUNK: usize = 16_384;

/// All that the cuts below a cell depend on, but for its references.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) bounds: Aabb,
    /// Around the parts of primitives in it.
    pub(super) content: Around,
    pub(super) depth: u32,
    /// References that may be added below.
    pub(super) budget: usize,
    /// Splits in a row above that brought nothing.
    pub(super) wasted: u32,
}

/// A plane, and how many splits down to it were made against the odds.
pub(super) struct Decision {
    pub(super) plane: Plane,
    wasted: u32,
}

impl Cell {
    /// The cells on either side of a plane, with so many references and what is around them; `before` were in this cell.
    pub(super) fn sides(
        &self,
        decision: &Decision,
        before: usize,
        counts: [usize; 2],
        contents: [Around; 2],
    ) -> [Self; 2] {
        // What is left of the budget goes to the sides by their size.
        let after = counts[0] + counts[1];
        let budget = (self.budget + before).saturating_sub(after);
        let share = |count: usize| (budget as u128 * count as u128 / after.max(1) as u128) as usize;
        let (left, right) = decision.plane.cut(self.bounds);
        let side = |bounds, i: usize| Self {
            bounds,
            content: contents[i],
            depth: self.depth + 1,
            budget: share(counts[i]),
            wasted: decision.wasted,
        };
        [side(left, 0), side(right, 1)]
    }
}

/// Cuts cells.
pub(super) struct Cutter<'a, P: ?Sized> {
    pub(super) primitives: &'a P,
    pub(super) params: &'a BuildParams,
    pub(super) blur: Blur,
    /// References that are tested together.
    pub(super) group: usize,
}

impl<P: Primitives + ?Sized> Cutter<'_, P> {
    /// The plane that cuts the cell, or `None` for a leaf.
    pub(super) fn decide(&self, cell: &Cell, refs: &[Reference]) -> Option<Decision> {
        let splittable = refs.len() > self.params.leaf_limit as usize
            && cell.depth < self.params.max_depth
            // In a thinner one, the walk could not tell the parts from each other.
            && cell.bounds.size().max_element() > 2.0 * self.blur.slack();
        if !splittable {
            return None;
        }
        let decision = match self.params.split {
            SplitRule::Sah(costs) if cell.content.half_area() > 0.0 => self.weigh(cell, refs, &costs)?,
            // Content without area (all on one line) has nothing for the heuristic to weigh.
            SplitRule::Midpoint | SplitRule::Sah(_) => {
                let plane = Plane::midpoint(cell.bounds)?;
                let (left, right) = plane.count(refs);
                let separates = left < refs.len() || right < refs.len();
                Decision { plane, wasted: if separates { 0 } else { cell.wasted + 1 } }
            }
        };
        (decision.wasted <= MAX_WASTED && self.affordable(cell, refs, decision.plane)).then_some(decision)
    }

    /// The plane of the surface area heuristic.
    fn weigh(&self, cell: &Cell, refs: &[Reference], costs: &SahCosts) -> Option<Decision> {
        let costs = costs.of_group(self.group);
        let bins = self.bins(cell, refs);
        let choice = bins.choose(refs.len(), cell.content, cell.bounds, &costs, cell.budget)?;
        let gains = choice.cost < costs.leaf(refs.len());
        if !gains && refs.len() <= HOPE_ABOVE {
            return None;
        }
        Some(Decision { plane: choice.plane, wasted: if gains { 0 } else { cell.wasted + 1 } })
    }

    fn bins(&self, cell: &Cell, refs: &[Reference]) -> Bins {
        let used = if refs.len() < 2 * MAX_BINS { MAX_BINS / 2 } else { MAX_BINS };
        let count = |some: &[Reference]| {
            let mut bins = Bins::new(cell.content, used);
            bins.add(some);
            bins
        };
        if refs.len() < 2 * CHUNK {
            return count(refs);
        }
        parallel::map_reduce(refs, CHUNK, count, |a, b| a.merge(&b)).unwrap_or_else(|| count(&[]))
    }

    /// Whether the plane duplicates no more references than the cell may.
    fn affordable(&self, cell: &Cell, refs: &[Reference], plane: Plane) -> bool {
        let (left, right) = plane.count(refs);
        left + right <= refs.len() + cell.budget
    }

    /// The references on either side of a plane, from many.
    pub(super) fn cut_large(&self, refs: &[Reference], plane: Plane) -> (Vec<Reference>, Vec<Reference>) {
        let cut = |some: &[Reference]| {
            let (mut left, mut right) = (Vec::with_capacity(some.len()), Vec::new());
            for &reference in some {
                let (below, above) = self.parts(reference, plane);
                left.extend(below);
                right.extend(above);
            }
            (left, right)
        };
        let join = |(mut left, mut right): (Vec<Reference>, Vec<Reference>), (more_left, more_right)| {
            left.extend::<Vec<_>>(more_left);
            right.extend::<Vec<_>>(more_right);
            (left, right)
        };
        parallel::map_reduce(refs, CHUNK, cut, join).unwrap_or_default()
    }

    /// A reference on either side of a plane.
    #[inline]
    pub(super) fn parts(&self, reference: Reference, plane: Plane) -> (Option<Reference>, Option<Reference>) {
        match plane.side(&reference) {
            Side::Left => (Some(reference), None),
            Side::Right => (None, Some(reference)),
            Side::Both => {
                let (left, right) = self.clipped(reference, plane);
                (left.map(|b| reference.with_bounds(b)), right.map(|b| reference.with_bounds(b)))
            }
        }
    }

    /// The boxes of a reference that a plane cuts.
    fn clipped(&self, reference: Reference, plane: Plane) -> (Option<Aabb>, Option<Aabb>) {
        let (left, right) = plane.cut(reference.bounds());
        if !self.params.clip {
            return (Some(left), Some(right));
        }
        let primitive = reference.primitive();
        let margin = self.blur.margin(self.primitives.bounds(primitive));
        let clip = |side: Aabb| {
            let part = self.primitives.clipped_bounds(primitive, grow(side, margin));
            let part = grow(part, margin).intersect(side);
            (!part.is_empty()).then_some(part)
        };
        match (clip(left), clip(right)) {
            // Numerics lost it: a reference is never dropped.
            (None, None) => (Some(left), Some(right)),
            parts => parts,
        }
    }
}
