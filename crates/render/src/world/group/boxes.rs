//! The index of a level of a group: which of its boxes a ray may meet.

use super::super::bound::BoxRay;
use glam::Vec3;
use heliostat_geometry::error_bound::mapped_ray;
use heliostat_geometry::{Aabb, Ray};
use heliostat_index::{BspTree, BuildError, BuildParams, Found, RayIndex, TraversalCost};
use std::cell::Cell;

/// Up to so many boxes are looked at one by one.
const FEW: usize = 8;

/// Of more boxes the tree is built with fewer references: it is the larger part of what they take.
const MANY: usize = 1 << 16;

/// How such a tree is built.
const COMPACT: BuildParams = BuildParams { max_duplication: 2.0, ..BuildParams::BALANCED };

/// An index over boxes in the space of a group. It keeps no boxes where there are many, so that a copy takes little more than
/// its transform.
#[derive(Debug)]
pub(super) enum BoxIndex {
    /// The boxes that are not empty, with their ids, ascending.
    Few(Vec<(u32, Aabb)>),
    /// A tree over the boxes that are not empty.
    Many {
        tree: Box<BspTree>,
        /// The id of each box of the tree, where some were empty.
        ids: Option<Vec<u32>>,
    },
}

impl BoxIndex {
    /// An index over the boxes that are not empty.
    ///
    /// # Errors
    /// When a box holds a NaN (the error has its id), or the tree grows too large.
    pub(super) fn new(boxes: &[Aabb]) -> Result<Self, BuildError> {
        let numbered = || (0_u32..).zip(boxes);
        if let Some((primitive, &bounds)) = numbered().find(|(_, b)| b.min.is_nan() || b.max.is_nan()) {
            return Err(BuildError::Bounds { primitive, bounds });
        }
        let filled = || numbered().filter(|(_, bounds)| !bounds.is_empty());
        let count = filled().count();
        if count <= FEW {
            return Ok(Self::Few(filled().map(|(id, &bounds)| (id, grown(bounds))).collect()));
        }
        let grown: Vec<_> = filled().map(|(_, &bounds)| grown(bounds)).collect();
        let params = if count > MANY { COMPACT } else { BuildParams::BALANCED };
        let tree = Box::new(BspTree::build(&grown, &params)?);
        let ids = (count < boxes.len()).then(|| filled().map(|(id, _)| id).collect());
        Ok(Self::Many { tree, ids })
    }

    /// The tree, where there is one.
    pub(super) fn tree(&self) -> Option<&BspTree> {
        match self {
            Self::Few(_) => None,
            Self::Many { tree, .. } => Some(tree),
        }
    }

    /// See [`RayIndex::closest_hit`]; adds its own work to `cost`.
    pub(super) fn closest<T>(
        &self,
        ray: &Ray,
        cost: Option<&Cell<TraversalCost>>,
        mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
    ) -> Option<Found<T>> {
        let (tree, ids) = match self {
            Self::Few(few) => return closest_of_few(few, ray, cost, hit),
            Self::Many { tree, ids } => (tree, ids.as_deref()),
        };
        let hit = |i, ray: &Ray| hit(id(ids, i), ray);
        let Some(cost) = cost else { return tree.closest_hit(ray, hit) };
        let mut own = TraversalCost::default();
        let found = tree.closest_hit_counted(ray, hit, &mut own);
        add(cost, own);
        found
    }

    /// See [`RayIndex::any_hit`].
    pub(super) fn any(&self, ray: &Ray, mut hit: impl FnMut(u32, &Ray) -> bool) -> bool {
        match self {
            Self::Few(few) => {
                let to_boxes = BoxRay::new(ray);
                few.iter().any(|(id, bounds)| to_boxes.may_meet(bounds, ray.range.max) && hit(*id, ray))
            }
            Self::Many { tree, ids } => tree.any_hit(ray, |i, ray| hit(id(ids.as_deref(), i), ray)),
        }
    }

    /// See [`RayIndex::for_each_hit`].
    pub(super) fn each(&self, ray: &Ray, mut visit: impl FnMut(u32)) {
        match self {
            Self::Few(few) => {
                let to_boxes = BoxRay::new(ray);
                let met = few.iter().filter(|(_, bounds)| to_boxes.may_meet(bounds, ray.range.max));
                met.for_each(|(id, _)| visit(*id));
            }
            Self::Many { tree, ids } => tree.for_each_hit(ray, |i| visit(id(ids.as_deref(), i))),
        }
    }
}

/// Adds to the work of a query.
pub(super) fn add(cost: &Cell<TraversalCost>, more: TraversalCost) {
    let sum = cost.get();
    cost.set(TraversalCost {
        nodes: sum.nodes + more.nodes,
        leaves: sum.leaves + more.leaves,
        tests: sum.tests + more.tests,
    });
}

#[inline]
fn id(ids: Option<&[u32]>, place: u32) -> u32 {
    ids.map_or(place, |ids| ids[place as usize])
}

/// A box for rays that were mapped into its space.
fn grown(bounds: Aabb) -> Aabb {
    if !bounds.is_finite() {
        return bounds;
    }
    let by = Vec3::splat(mapped_ray(bounds.min.abs().max(bounds.max.abs()).max_element()));
    Aabb { min: bounds.min - by, max: bounds.max + by }
}

fn closest_of_few<T>(
    few: &[(u32, Aabb)],
    ray: &Ray,
    cost: Option<&Cell<TraversalCost>>,
    mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
) -> Option<Found<T>> {
    if let Some(cost) = cost {
        add(cost, TraversalCost { tests: few.len() as u64, ..TraversalCost::default() });
    }
    let to_boxes = BoxRay::new(ray);
    let mut search = *ray;
    let mut nearest: Option<Found<T>> = None;
    for (primitive, bounds) in few {
        if to_boxes.may_meet(bounds, search.range.max)
            && let Some((t, data)) = hit(*primitive, &search)
            // Ids ascend: of two at the same distance the lower one is there already.
            && nearest.as_ref().is_none_or(|nearest| t < nearest.t)
        {
            search.range.max = t;
            nearest = Some(Found { primitive: *primitive, t, data });
        }
    }
    nearest
}
