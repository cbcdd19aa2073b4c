//! The upper level: which of the things in the world a ray may meet.

use super::slabs::Slabs;
use super::solid::Solid;
use heliostat_geometry::{Aabb, Ray};
use heliostat_index::{BspTree, BuildError, BuildParams, Found, RayIndex, TraversalCost};

/// Up to so many things are looked at one by one: a walk through a tree would cost more.
const FEW: usize = 8;

/// Up to so many things are looked at one by one for all samples of a light: a bit for each.
const MANY: usize = u64::BITS as usize;

/// An index over solids by their boxes.
#[derive(Debug)]
pub(super) struct Level {
    /// Index into the solids for each box, ascending; empty meshes are left out.
    ids: Vec<u32>,
    boxes: Vec<Aabb>,
    /// Where there are more than a few.
    tree: Option<BspTree>,
    /// The box around all finite boxes.
    bounds: Aabb,
}

/// A set of boxes of a [`Level`] that may be met: one bit for each, or all.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Candidates {
    /// Those whose bit is set.
    Some(u64),
    /// Not known.
    All,
}

impl Candidates {
    /// Whether it is known that nothing is met.
    pub(crate) fn are_none(self) -> bool {
        matches!(self, Self::Some(0))
    }
}

impl Level {
    /// An index over all solids that are not empty.
    ///
    /// # Errors
    /// When a solid has no place in space: the error names it by its index.
    pub(super) fn new(solids: &[Solid<'_>]) -> Result<Self, BuildError> {
        let (mut ids, mut boxes) = (Vec::new(), Vec::new());
        for (id, bounds) in (0..).zip(solids.iter().map(|solid| solid.bounds)) {
            if bounds.min.is_nan() || bounds.max.is_nan() {
                return Err(BuildError::Bounds { primitive: id, bounds });
            }
            if !bounds.is_empty() {
                ids.push(id);
                boxes.push(bounds);
            }
        }
        let tree = if boxes.len() > FEW { Some(BspTree::build(&boxes, &BuildParams::SAH)?) } else { None };
        let bounds = boxes.iter().filter(|b| b.is_finite()).fold(Aabb::EMPTY, |all, &b| all.union(b));
        Ok(Self { ids, boxes, tree, bounds })
    }

    /// The box around everything finite; empty when there is nothing.
    pub(super) fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The tree, where there is one.
    pub(super) fn tree(&self) -> Option<&BspTree> {
        self.tree.as_ref()
    }

    /// See [`RayIndex::closest_hit`]; primitives are indices into the solids.
    #[inline]
    pub(super) fn closest<T>(
        &self,
        ray: &Ray,
        mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
    ) -> Option<Found<T>> {
        let Some(tree) = &self.tree else { return self.closest_of_few(ray, hit) };
        let found = tree.closest_hit(ray, |i, ray| hit(self.ids[i as usize], ray))?;
        Some(Found { primitive: self.ids[found.primitive as usize], ..found })
    }

    /// [`Level::closest`] that adds its own work to `cost`.
    pub(super) fn closest_counted<T>(
        &self,
        ray: &Ray,
        cost: &mut TraversalCost,
        mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
    ) -> Option<Found<T>> {
        let Some(tree) = &self.tree else {
            cost.tests += self.ids.len() as u64;
            return self.closest_of_few(ray, hit);
        };
        let found = tree.closest_hit_counted(ray, |i, ray| hit(self.ids[i as usize], ray), cost)?;
        Some(Found { primitive: self.ids[found.primitive as usize], ..found })
    }

    #[inline]
    fn closest_of_few<T>(
        &self,
        ray: &Ray,
        mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
    ) -> Option<Found<T>> {
        let slabs = Slabs::new(ray);
        let mut search = *ray;
        let mut nearest: Option<Found<T>> = None;
        for (&primitive, bounds) in self.ids.iter().zip(&self.boxes) {
            if slabs.may_meet(&search, bounds)
                && let Some((t, data)) = hit(primitive, &search)
                // Ids ascend: of two at the same distance the lower one is there already.
                && nearest.as_ref().is_none_or(|nearest| t < nearest.t)
            {
                search.range.max = t;
                nearest = Some(Found { primitive, t, data });
            }
        }
        nearest
    }

    /// The boxes of the solids that count.
    pub(super) fn candidates(&self, mut counts: impl FnMut(u32) -> bool) -> Candidates {
        if self.boxes.len() > MANY {
            return Candidates::All;
        }
        let set = self.ids.iter().enumerate().filter(|&(_, &id)| counts(id));
        Candidates::Some(set.fold(0, |set, (bit, _)| set | 1 << bit))
    }

    /// See [`RayIndex::any_hit`], among the candidates.
    #[inline]
    pub(super) fn any(
        &self,
        ray: &Ray,
        candidates: Candidates,
        mut hit: impl FnMut(u32, &Ray) -> bool,
    ) -> bool {
        match (candidates, &self.tree) {
            (Candidates::Some(0), _) => false,
            (Candidates::Some(set), tree) if tree.is_none() || set.count_ones() as usize <= FEW => {
                // They are near the ray by their hulls: boxes would tell little more.
                bits(set).any(|i| hit(self.ids[i], ray))
            }
            (_, Some(tree)) => tree.any_hit(ray, |i, ray| hit(self.ids[i as usize], ray)),
            (_, None) => {
                let slabs = Slabs::new(ray);
                self.ids
                    .iter()
                    .zip(&self.boxes)
                    .any(|(&id, bounds)| slabs.may_meet(ray, bounds) && hit(id, ray))
            }
        }
    }

    /// See [`RayIndex::for_each_hit`], among the candidates; in the order of the ids where they are known.
    pub(super) fn each(&self, ray: &Ray, candidates: Candidates, mut visit: impl FnMut(u32)) {
        match (candidates, &self.tree) {
            (Candidates::Some(set), _) => bits(set).for_each(|i| visit(self.ids[i])),
            (Candidates::All, Some(tree)) => tree.for_each_hit(ray, |i| visit(self.ids[i as usize])),
            (Candidates::All, None) => self.ids.iter().for_each(|&id| visit(id)),
        }
    }
}

/// The places of the bits that are set, ascending.
fn bits(mut set: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        if set == 0 {
            return None;
        }
        let lowest = set.trailing_zeros() as usize;
        set &= set - 1;
        Some(lowest)
    })
}
