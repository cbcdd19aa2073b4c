//! The upper level: which of the things in the world a ray may meet.

use super::solid::Solid;
use heliostat_geometry::{Aabb, Ray};
use heliostat_index::{BruteForce, BspTree, BuildError, BuildParams, Found, RayIndex, TraversalCost};

/// Up to so many things are looked at one by one: a walk through a tree would cost more.
const FEW: usize = 8;

/// An index over solids by their boxes.
#[derive(Debug)]
pub(super) struct Level {
    /// Index into the solids for each primitive of the index, ascending; empty meshes are left out.
    ids: Vec<u32>,
    boxes: Vec<Aabb>,
    index: Index,
}

#[derive(Debug)]
enum Index {
    Few(BruteForce),
    Tree(BspTree),
}

impl Level {
    /// An index over all solids that are not empty.
    ///
    /// # Errors
    /// When a solid has no place in space: the error names it by its index.
    pub(super) fn new(solids: &[Solid<'_>]) -> Result<Self, BuildError> {
        let (mut ids, mut boxes) = (Vec::new(), Vec::new());
        for (id, bounds) in (0..).zip(solids.iter().map(Solid::bounds)) {
            if bounds.min.is_nan() || bounds.max.is_nan() {
                return Err(BuildError::Bounds { primitive: id, bounds });
            }
            if !bounds.is_empty() {
                ids.push(id);
                boxes.push(bounds);
            }
        }
        let index = if boxes.len() > FEW {
            Index::Tree(BspTree::build(&boxes, &BuildParams::SAH)?)
        } else {
            Index::Few(BruteForce::new(boxes.len() as u32))
        };
        Ok(Self { ids, boxes, index })
    }

    /// The box around everything finite; empty when there is nothing.
    pub(super) fn bounds(&self) -> Aabb {
        self.boxes.iter().filter(|b| b.is_finite()).fold(Aabb::EMPTY, |all, &b| all.union(b))
    }

    /// The tree, where there is one.
    pub(super) fn tree(&self) -> Option<&BspTree> {
        match &self.index {
            Index::Few(_) => None,
            Index::Tree(tree) => Some(tree),
        }
    }

    /// See [`RayIndex::closest_hit`]; primitives are indices into the solids.
    #[inline]
    pub(super) fn closest<T>(
        &self,
        ray: &Ray,
        mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
    ) -> Option<Found<T>> {
        let found = match &self.index {
            Index::Few(few) => few.closest_hit(ray, |i, ray| {
                self.boxes[i as usize].clip(ray)?;
                hit(self.ids[i as usize], ray)
            }),
            Index::Tree(tree) => tree.closest_hit(ray, |i, ray| hit(self.ids[i as usize], ray)),
        };
        found.map(|found| self.named(found))
    }

    /// [`Level::closest`] that adds its own work to `cost`.
    pub(super) fn closest_counted<T>(
        &self,
        ray: &Ray,
        cost: &mut TraversalCost,
        mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
    ) -> Option<Found<T>> {
        let found = match &self.index {
            Index::Few(_) => {
                cost.tests += self.ids.len() as u64;
                return self.closest(ray, hit);
            }
            Index::Tree(tree) => tree.closest_hit_counted(ray, |i, ray| hit(self.ids[i as usize], ray), cost),
        };
        found.map(|found| self.named(found))
    }

    /// See [`RayIndex::any_hit`].
    #[inline]
    pub(super) fn any(&self, ray: &Ray, mut hit: impl FnMut(u32, &Ray) -> bool) -> bool {
        match &self.index {
            Index::Few(few) => few.any_hit(ray, |i, ray| {
                self.boxes[i as usize].clip(ray).is_some() && hit(self.ids[i as usize], ray)
            }),
            Index::Tree(tree) => tree.any_hit(ray, |i, ray| hit(self.ids[i as usize], ray)),
        }
    }

    /// See [`RayIndex::for_each_hit`].
    pub(super) fn each(&self, ray: &Ray, mut visit: impl FnMut(u32)) {
        match &self.index {
            Index::Few(few) => few.for_each_hit(ray, |i| visit(self.ids[i as usize])),
            Index::Tree(tree) => tree.for_each_hit(ray, |i| visit(self.ids[i as usize])),
        }
    }

    fn named<T>(&self, found: Found<T>) -> Found<T> {
        Found { primitive: self.ids[found.primitive as usize], ..found }
    }
}
