//! Searching leaves for triangles.
//!
//! Lanes answer which triangles a ray may meet, and where, with a bound of their error. As long as that is enough to tell
//! which of two hits is the nearer one, no triangle is looked at more closely; the last one standing is intersected exactly,
//! once, at the end. Where it is not enough (at an edge, at the ends of the range, on coincident triangles), the exact test
//! decides at once.

use super::block::{Block, BlockRay, Tag};
use super::{MeshHit, MeshTree};
use crate::simd::{LANES, Lanes};
use crate::wide::walk::{Counter, Search};
use heliostat_geometry::triangle::{TriangleRay, intersect};
use heliostat_geometry::{Interval, Ray};

/// The exact test of the triangle in a lane, counted over all blocks.
///
/// It knows the ray as it came: what is prepared for lanes can then stay in registers.
#[cold]
#[inline(never)]
pub(super) fn exact(tree: &MeshTree, ray: &Ray, slot: usize) -> Option<MeshHit> {
    let corners = tree.blocks[slot / LANES].corners(slot % LANES);
    let hit = intersect(&TriangleRay::new(ray), ray.range, corners)?;
    Some(MeshHit { triangle: tree.tree.leaf_refs()[slot], hit })
}

/// Whether the exact test hits.
#[cold]
#[inline(never)]
fn hits(tree: &MeshTree, ray: &Ray, slot: usize) -> bool {
    exact(tree, ray, slot).is_some()
}

/// The distance of the triangle in a lane if it beats the nearest one so far, in another lane, by the exact test of both.
#[cold]
#[inline(never)]
fn overtakes(tree: &MeshTree, ray: &Ray, slot: usize, best: Option<usize>) -> Option<f32> {
    let candidate = exact(tree, ray, slot)?;
    let best = best.and_then(|best| exact(tree, ray, best));
    candidate.beats(best.as_ref()).then_some(candidate.hit.t)
}

/// The first block of a leaf, and how many there are.
#[inline(always)]
pub(super) fn blocks_of(leaf: u32) -> (usize, usize) {
    ((leaf & 0xFF_FFFF) as usize, (leaf >> 24) as usize)
}

impl MeshTree {
    /// The number of the first block of a leaf, and its blocks.
    #[inline(always)]
    fn leaf(&self, leaf: u32) -> (usize, impl Iterator<Item = (&Block, &Tag)>) {
        let (first, count) = blocks_of(leaf);
        (first, self.blocks[first..][..count].iter().zip(&self.tags[first..][..count]))
    }
}

/// Looks for the nearest hit.
pub(super) struct Nearest<'t> {
    tree: &'t MeshTree,
    ray: &'t Ray,
    block_ray: BlockRay,
    /// The lane of the nearest hit so far.
    best: Option<usize>,
    /// Bounds of its distance; the end of the ray's range where there is none.
    low: f32,
    high: f32,
}

impl<'t> Nearest<'t> {
    #[inline(always)]
    pub(super) fn new(lanes: impl Lanes, tree: &'t MeshTree, ray: &'t Ray) -> Self {
        let end = ray.range.max;
        Self { tree, ray, block_ray: BlockRay::new(lanes, ray), best: None, low: end, high: end }
    }

    /// The nearest hit.
    #[inline(always)]
    pub(super) fn finish(&self) -> Option<MeshHit> {
        // Whatever put it in front of the others was certain.
        let slot = self.best?;
        match self.block_ray.certain_hit(&self.tree.blocks[slot / LANES], slot % LANES) {
            Some(hit) => Some(MeshHit { triangle: self.tree.tree.leaf_refs()[slot], hit }),
            None => exact(self.tree, self.ray, slot),
        }
    }

    /// Whether the triangle in a lane is the nearest one so far, met in another leaf.
    #[inline(always)]
    fn is_best(&self, slot: usize) -> bool {
        let ids = self.tree.tree.leaf_refs();
        self.best.is_some_and(|best| ids[best] == ids[slot])
    }
}

impl Search for Nearest<'_> {
    const SHORTENS: bool = true;

    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, lanes: L, leaf: u32, counter: &mut impl Counter) -> f32 {
        counter.leaf(LANES * blocks_of(leaf).1);
        let start = greater(self.ray.range.min, 0.0);
        let (first, blocks) = self.tree.leaf(leaf);
        for (i, block) in blocks.enumerate() {
            let range = Interval { min: start, max: self.high };
            let Some(found) = self.block_ray.meet(lanes, block, range) else { continue };
            let (lows, highs) = (lanes.store(found.low), lanes.store(found.high));
            let mut candidates = found.lanes;
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize % LANES;
                candidates &= candidates - 1;
                let slot = LANES * (first + i) + lane;
                let (low, high) = (lows.0[lane], highs.0[lane]);
                if high < self.low && found.certain >> lane & 1 != 0 {
                    (self.best, self.low, self.high) = (Some(slot), low, high);
                } else if !self.is_best(slot)
                    && let Some(t) = overtakes(self.tree, self.ray, slot, self.best)
                {
                    (self.best, self.low, self.high) = (Some(slot), t, t);
                }
            }
        }
        self.high
    }
}

/// Looks for any hit.
pub(super) struct Any<'t> {
    tree: &'t MeshTree,
    ray: &'t Ray,
    block_ray: BlockRay,
    pub(super) found: bool,
}

impl<'t> Any<'t> {
    #[inline(always)]
    pub(super) fn new(lanes: impl Lanes, tree: &'t MeshTree, ray: &'t Ray) -> Self {
        Self { tree, ray, block_ray: BlockRay::new(lanes, ray), found: false }
    }
}

impl Search for Any<'_> {
    const SHORTENS: bool = false;

    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, lanes: L, leaf: u32, counter: &mut impl Counter) -> f32 {
        counter.leaf(LANES * blocks_of(leaf).1);
        let range = Interval { min: greater(self.ray.range.min, 0.0), ..self.ray.range };
        let (first, blocks) = self.tree.leaf(leaf);
        for (i, block) in blocks.enumerate() {
            let Some(found) = self.block_ray.meet(lanes, block, range) else { continue };
            let mut doubtful = if found.certain == 0 { found.lanes } else { 0 };
            self.found = found.certain != 0;
            while doubtful != 0 && !self.found {
                let lane = doubtful.trailing_zeros() as usize % LANES;
                doubtful &= doubtful - 1;
                self.found = hits(self.tree, self.ray, LANES * (first + i) + lane);
            }
            if self.found {
                return f32::NEG_INFINITY;
            }
        }
        range.max
    }
}

/// Shows all hits to a closure.
pub(super) struct Each<'t, V> {
    tree: &'t MeshTree,
    ray: &'t Ray,
    block_ray: BlockRay,
    visit: V,
}

impl<'t, V: FnMut(MeshHit)> Each<'t, V> {
    #[inline(always)]
    pub(super) fn new(lanes: impl Lanes, tree: &'t MeshTree, ray: &'t Ray, visit: V) -> Self {
        Self { tree, ray, block_ray: BlockRay::new(lanes, ray), visit }
    }
}

impl<V: FnMut(MeshHit)> Search for Each<'_, V> {
    const SHORTENS: bool = false;

    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, lanes: L, leaf: u32, counter: &mut impl Counter) -> f32 {
        counter.leaf(LANES * blocks_of(leaf).1);
        let range = self.ray.range;
        let (first, blocks) = self.tree.leaf(leaf);
        for (i, block) in blocks.enumerate() {
            let Some(found) = self.block_ray.meet(lanes, block, range) else { continue };
            let mut candidates = found.lanes;
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize % LANES;
                candidates &= candidates - 1;
                if let Some(hit) = exact(self.tree, self.ray, LANES * (first + i) + lane) {
                    (self.visit)(hit);
                }
            }
        }
        range.max
    }
}

/// The larger of two numbers, `b` where one is NaN.
#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
