//! A cell: where it is cut, and into what.

use super::blur::{Blur, grow};
use super::reference::{Around, Reference};
use super::sah::{Bins, Choice};
use crate::bsp::params::{BuildParams, LeafCosts, SahCosts, SplitRule};
use crate::bsp::split::{Plane, Side};
use crate::parallel;
use crate::primitives::Primitives;
use heliostat_geometry::Aabb;

/// How many splits in a row may bring nothing before a cell is left as it is.
const MAX_WASTED: u32 = 3;

/// A cell above this size may be cut at a loss, hoping that its parts are cut at a gain.
const HOPE_ABOVE: usize = 16;

/// From so many references on, more bins are worth their work.
const MANY: usize = 64;

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
    /// The plane that cuts the cell, or `None` for a leaf. The references, so many, come in any pieces.
    pub(super) fn decide<S>(&self, cell: &Cell, count: usize, refs: &[S]) -> Option<Decision>
    where
        S: AsRef<[Reference]> + Sync,
    {
        let splittable = count > self.params.leaf_limit as usize
            && cell.depth < self.params.max_depth
            // In a thinner one, the walk could not tell the parts from each other.
            && cell.bounds.size().max_element() > 2.0 * self.blur.slack();
        if !splittable {
            return None;
        }
        let decision = match self.params.split {
            SplitRule::Sah(costs) if cell.content.half_area() > 0.0 => {
                self.weigh(cell, count, refs, &costs)?
            }
            // Content without area (all on one line) has nothing for the heuristic to weigh.
            SplitRule::Midpoint | SplitRule::Sah(_) => Self::halve(cell, count, refs)?,
        };
        (decision.wasted <= MAX_WASTED).then_some(decision)
    }

    /// The plane in the middle, when the cell may duplicate as many references as it does.
    fn halve<S: AsRef<[Reference]> + Sync>(cell: &Cell, count: usize, refs: &[S]) -> Option<Decision> {
        let plane = Plane::midpoint(cell.bounds)?;
        let counts =
            parallel::map_reduce(refs, |some| plane.count(some.as_ref()), |a, b| (a.0 + b.0, a.1 + b.1));
        let (left, right) = counts.unwrap_or_default();
        let separates = left < count || right < count;
        let is_affordable = left + right <= count + cell.budget;
        is_affordable.then_some(Decision { plane, wasted: if separates { 0 } else { cell.wasted + 1 } })
    }

    /// The plane of the surface area heuristic.
    fn weigh<S>(&self, cell: &Cell, count: usize, refs: &[S], costs: &SahCosts) -> Option<Decision>
    where
        S: AsRef<[Reference]> + Sync,
    {
        let costs = costs.of_group(self.group);
        let choice = if count < MANY {
            Self::choose::<16, S>(cell, count, refs, &costs)
        } else {
            Self::choose::<32, S>(cell, count, refs, &costs)
        }?;
        let gains = choice.cost < costs.leaf(count as u32);
        if !gains && count <= HOPE_ABOVE {
            return None;
        }
        Some(Decision { plane: choice.plane, wasted: if gains { 0 } else { cell.wasted + 1 } })
    }

    /// The cheapest plane that `N` bins know of.
    fn choose<const N: usize, S>(cell: &Cell, count: usize, refs: &[S], costs: &LeafCosts) -> Option<Choice>
    where
        S: AsRef<[Reference]> + Sync,
    {
        let mut bins = Bins::<N>::new(cell.content);
        match refs {
            // Bins are large: they stay where they are.
            [only] => bins.add(only.as_ref()),
            _ => {
                let add = |some: &S| {
                    let mut bins = Box::new(Bins::<N>::new(cell.content));
                    bins.add(some.as_ref());
                    bins
                };
                let merge = |mut a: Box<Bins<N>>, b: Box<Bins<N>>| {
                    a.merge(&b);
                    a
                };
                bins.merge(&*parallel::map_reduce(refs, add, merge)?);
            }
        }
        bins.choose(count, cell.content, cell.bounds, costs, cell.budget)
    }

    /// Keeps what lies below a plane at the beginning of `refs` and puts what lies above it into `spill`, which is as long;
    /// answers how many there are of either.
    pub(super) fn cut(&self, refs: &mut [Reference], spill: &mut [Reference], plane: Plane) -> [usize; 2] {
        let (mut kept, mut spilled) = (0, 0);
        for i in 0..refs.len() {
            let reference = refs[i];
            let side = plane.side(&reference);
            if side == Side::Both {
                let (left, right) = self.clipped(reference, plane);
                if let Some(part) = left {
                    refs[kept] = reference.with_bounds(part);
                    kept += 1;
                }
                if let Some(part) = right {
                    spill[spilled] = reference.with_bounds(part);
                    spilled += 1;
                }
            } else {
                // Into both, and one stays: no processor can foresee which.
                refs[kept] = reference;
                spill[spilled] = reference;
                kept += usize::from(side == Side::Left);
                spilled += usize::from(side == Side::Right);
            }
        }
        [kept, spilled]
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
