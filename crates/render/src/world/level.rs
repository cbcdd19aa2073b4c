//! The upper level: which of the things in the world a ray may meet.

use super::bound::{Bound, FEW, FewBoxes};
use super::solid::Solid;
use crate::bits;
use heliostat_geometry::{Aabb, Ray};
use heliostat_index::{BspTree, BuildError, BuildParams, Found, RayIndex, TraversalCost};

/// Up to so many things are looked at one by one for all samples of a light: a bit for each.
const MANY: usize = u64::BITS as usize;

/// An index over solids by their boxes.
#[derive(Debug)]
pub(super) struct Level {
    /// Index into the solids for each box, ascending; empty meshes are left out.
    ids: Vec<u32>,
    bounds: Vec<Bound>,
    search: Search,
    /// The box around all finite boxes.
    whole: Aabb,
}

/// How boxes are searched.
#[derive(Debug)]
enum Search {
    /// All at once, where there are only a few: a walk through a tree would cost more.
    Few(FewBoxes),
    /// By a tree, where there are more.
    Tree(BspTree),
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
    /// Those in both sets.
    #[inline]
    pub(super) fn among(self, others: Self) -> Self {
        match (self, others) {
            (Self::Some(a), Self::Some(b)) => Self::Some(a & b),
            (Self::All, set) | (set, Self::All) => set,
        }
    }

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
        let (mut ids, mut boxes, mut bounds) = (Vec::new(), Vec::new(), Vec::new());
        for (id, solid) in (0..).zip(solids) {
            let around = solid.bounds;
            if around.min.is_nan() || around.max.is_nan() {
                return Err(BuildError::Bounds { primitive: id, bounds: around });
            }
            if !around.is_empty() {
                ids.push(id);
                boxes.push(around);
                bounds.push(Bound::new(solid));
            }
        }
        let search = if boxes.len() > FEW {
            Search::Tree(BspTree::build(&boxes, &BuildParams::BALANCED)?)
        } else {
            Search::Few(FewBoxes::new(&boxes))
        };
        let whole = boxes.iter().filter(|b| b.is_finite()).fold(Aabb::EMPTY, |all, &b| all.union(b));
        Ok(Self { ids, bounds, search, whole })
    }

    /// The box around everything finite; empty when there is nothing.
    pub(super) fn bounds(&self) -> Aabb {
        self.whole
    }

    /// The tree, where there is one.
    pub(super) fn tree(&self) -> Option<&BspTree> {
        match &self.search {
            Search::Few(_) => None,
            Search::Tree(tree) => Some(tree),
        }
    }

    /// See [`RayIndex::closest_hit`]; primitives are indices into the solids. `hit` says where on the ray it met something, and
    /// leaves the rest in its last argument.
    #[inline]
    pub(super) fn closest<T: Default>(
        &self,
        ray: &Ray,
        mut hit: impl FnMut(u32, &Ray, &mut T) -> Option<f32>,
    ) -> Option<Found<T>> {
        let tree = match &self.search {
            Search::Few(boxes) => return self.closest_of_few(boxes, ray, hit),
            Search::Tree(tree) => tree,
        };
        let hit = kept(|i: u32, ray: &Ray, data: &mut T| hit(self.ids[i as usize], ray, data));
        let found = tree.closest_hit(ray, hit)?;
        Some(Found { primitive: self.ids[found.primitive as usize], ..found })
    }

    /// [`Level::closest`] that adds its own work to `cost`.
    pub(super) fn closest_counted<T: Default>(
        &self,
        ray: &Ray,
        cost: &mut TraversalCost,
        mut hit: impl FnMut(u32, &Ray, &mut T) -> Option<f32>,
    ) -> Option<Found<T>> {
        let tree = match &self.search {
            Search::Few(boxes) => {
                cost.tests += self.ids.len() as u64;
                return self.closest_of_few(boxes, ray, hit);
            }
            Search::Tree(tree) => tree,
        };
        let hit = kept(|i: u32, ray: &Ray, data: &mut T| hit(self.ids[i as usize], ray, data));
        let found = tree.closest_hit_counted(ray, hit, cost)?;
        Some(Found { primitive: self.ids[found.primitive as usize], ..found })
    }

    #[inline]
    fn closest_of_few<T: Default>(
        &self,
        boxes: &FewBoxes,
        ray: &Ray,
        mut hit: impl FnMut(u32, &Ray, &mut T) -> Option<f32>,
    ) -> Option<Found<T>> {
        let (mut search, mut nearest, mut data) = (*ray, None, T::default());
        let entries = boxes.entries(ray);
        for i in bits::places(entries.may_meet.into()) {
            let primitive = self.ids[i];
            if entries.before(i, search.range.max)
                && let Some(t) = hit(primitive, &search, &mut data)
            {
                // Ids ascend: of two at the same distance the lower one stays, so the search ends before it.
                search.range.max = t.next_down();
                nearest = Some((primitive, t));
            }
        }
        nearest.map(|(primitive, t)| Found { primitive, t, data })
    }

    /// The solids that count.
    pub(super) fn candidates(&self, counts: impl FnMut(u32) -> bool) -> Candidates {
        let all = if self.bounds.len() > MANY {
            Candidates::All
        } else {
            Candidates::Some(bits::lowest(self.ids.len()))
        };
        self.narrow(all, counts)
    }

    /// Those of the candidates that count.
    #[inline]
    pub(super) fn narrow(&self, candidates: Candidates, mut counts: impl FnMut(u32) -> bool) -> Candidates {
        let Candidates::Some(set) = candidates else { return candidates };
        let counting = bits::places(set).filter(|&i| counts(self.ids[i]));
        Candidates::Some(counting.fold(0, |counting, i| counting | 1 << i))
    }

    /// The candidates, ascending, where they are so few that each is asked by itself.
    #[inline]
    pub(super) fn few(&self, candidates: Candidates) -> Option<impl Iterator<Item = u32>> {
        Some(bits::places(self.few_bits(candidates)?).map(|i| self.ids[i]))
    }

    #[inline]
    fn few_bits(&self, candidates: Candidates) -> Option<u64> {
        let Candidates::Some(set) = candidates else { return None };
        (self.tree().is_none() || set.count_ones() as usize <= FEW).then_some(set)
    }

    /// See [`RayIndex::any_hit`], among the candidates.
    #[inline]
    pub(super) fn any(
        &self,
        ray: &Ray,
        candidates: Candidates,
        mut hit: impl FnMut(u32, &Ray) -> bool,
    ) -> bool {
        match (&self.search, self.few_bits(candidates)) {
            (Search::Few(boxes), few) => met_of_few(boxes, ray, few).any(|i| hit(self.ids[i], ray)),
            (Search::Tree(_), Some(few)) => {
                bits::places(few).any(|i| self.bounds[i].may_meet(ray) && hit(self.ids[i], ray))
            }
            (Search::Tree(tree), None) => tree.any_hit(ray, |i, ray| hit(self.ids[i as usize], ray)),
        }
    }

    /// See [`RayIndex::for_each_hit`], among the candidates; in the order of the ids where there are few.
    #[inline]
    pub(super) fn each(&self, ray: &Ray, candidates: Candidates, mut visit: impl FnMut(u32)) {
        match (&self.search, self.few_bits(candidates)) {
            (Search::Few(boxes), few) => met_of_few(boxes, ray, few).for_each(|i| visit(self.ids[i])),
            (Search::Tree(_), Some(few)) => {
                bits::places(few).filter(|&i| self.bounds[i].may_meet(ray)).for_each(|i| visit(self.ids[i]));
            }
            (Search::Tree(tree), None) => tree.for_each_hit(ray, |i| visit(self.ids[i as usize])),
        }
    }
}

/// Those of a few boxes that a ray may meet, among the candidates if there are any.
#[inline]
fn met_of_few(boxes: &FewBoxes, ray: &Ray, candidates: Option<u64>) -> impl Iterator<Item = usize> {
    bits::places(candidates.unwrap_or(u64::MAX) & u64::from(boxes.entries(ray).may_meet))
}

/// A question whose answer is kept beside the distance, for indices that choose among answers.
#[inline]
fn kept<T: Default>(
    mut hit: impl FnMut(u32, &Ray, &mut T) -> Option<f32>,
) -> impl FnMut(u32, &Ray) -> Option<(f32, T)> {
    move |i, ray| {
        let mut data = T::default();
        hit(i, ray, &mut data).map(|t| (t, data))
    }
}
