//! Searching leaves for triangles.
//!
//! Lanes answer which triangles a ray may meet, and where, with a bound of their error. As long as that is enough to tell
//! which of two hits is the nearer one, no triangle is looked at more closely; the last one standing is intersected exactly,
//! once, at the end. Where it is not enough (at an edge, at the ends of the range, on coincident triangles), the exact test
//! decides at once.

use super::MeshHit;
use super::block::{Block, BlockRay};
use crate::bsp::BspTree;
use crate::simd::{LANES, Lanes};
use crate::wide::walk::{Counter, Search};
use heliostat_geometry::Ray;
use heliostat_geometry::triangle::TriangleRay;

/// The triangles of a tree, as a ray sees them.
pub(super) struct Triangles<'t> {
    blocks: &'t [Block],
    /// The triangle in each lane of each block.
    ids: &'t [u32],
    block_ray: BlockRay,
    ray: &'t Ray,
}

impl<'t> Triangles<'t> {
    #[inline(always)]
    pub(super) fn new(blocks: &'t [Block], tree: &'t BspTree, ray: &'t Ray) -> Self {
        let reach = tree.wide().room.reach(ray.origin.into());
        let block_ray = BlockRay::new(&TriangleRay::new(ray), reach);
        Self { blocks, ids: tree.leaf_refs(), block_ray, ray }
    }

    /// The exact test of the triangle in a lane, counted over all blocks.
    #[inline(always)]
    pub(super) fn hit(&self, slot: usize) -> Option<MeshHit> {
        let hit = self.block_ray.hit(&self.blocks[slot / LANES], slot % LANES, self.ray.range)?;
        Some(MeshHit { triangle: self.ids[slot], hit })
    }
}

/// The first block of a leaf, and how many there are.
#[inline(always)]
fn blocks_of(leaf: u32) -> (usize, usize) {
    ((leaf & 0xFF_FFFF) as usize, (leaf >> 24) as usize)
}

/// Looks for the nearest hit.
pub(super) struct Nearest<'t> {
    triangles: Triangles<'t>,
    /// The lane of the nearest hit so far.
    best: Option<usize>,
    /// Bounds of its distance; the end of the ray's range where there is none.
    low: f32,
    high: f32,
}

impl<'t> Nearest<'t> {
    #[inline(always)]
    pub(super) fn new(triangles: Triangles<'t>) -> Self {
        let end = triangles.ray.range.max;
        Self { triangles, best: None, low: end, high: end }
    }

    /// The nearest hit.
    #[inline(always)]
    pub(super) fn finish(self) -> Option<MeshHit> {
        // Whatever put it in front of the others was certain.
        let slot = self.best?;
        let Triangles { blocks, ids, block_ray, .. } = &self.triangles;
        let hit = block_ray.certain_hit(&blocks[slot / LANES], slot % LANES)?;
        Some(MeshHit { triangle: ids[slot], hit })
    }

    /// Whether the triangle in a lane is the nearest one so far, met in another leaf.
    #[inline(always)]
    fn is_best(&self, slot: usize) -> bool {
        let ids = self.triangles.ids;
        self.best.is_some_and(|best| ids[best] == ids[slot])
    }

    /// Compares a candidate with the nearest hit by the exact test of both.
    #[cold]
    #[inline(never)]
    fn decide(&mut self, slot: usize) {
        let Some(candidate) = self.triangles.hit(slot) else { return };
        let best = self.best.and_then(|best| self.triangles.hit(best));
        if candidate.beats(best.as_ref()) {
            (self.best, self.low, self.high) = (Some(slot), candidate.hit.t, candidate.hit.t);
        }
    }
}

impl Search for Nearest<'_> {
    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, lanes: L, leaf: u32, counter: &mut impl Counter) -> f32 {
        let (first, count) = blocks_of(leaf);
        counter.leaf(LANES * count);
        let start = greater(self.triangles.ray.range.min, 0.0);
        for (number, block) in (first..).zip(&self.triangles.blocks[first..first + count]) {
            let Some(found) = self.triangles.block_ray.meet(lanes, block, start, self.high) else { continue };
            let (lows, highs) = (lanes.store(found.low), lanes.store(found.high));
            let mut candidates = found.lanes;
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize % LANES;
                candidates &= candidates - 1;
                let slot = LANES * number + lane;
                let (low, high) = (lows.0[lane], highs.0[lane]);
                let is_certain = high < self.low && (found.within & !found.on_edge) >> lane & 1 != 0;
                if is_certain {
                    (self.best, self.low, self.high) = (Some(slot), low, high);
                } else if !self.is_best(slot) {
                    self.decide(slot);
                }
            }
        }
        self.high
    }
}

/// Looks for any hit.
pub(super) struct Any<'t> {
    triangles: Triangles<'t>,
    pub(super) found: bool,
}

impl<'t> Any<'t> {
    #[inline(always)]
    pub(super) fn new(triangles: Triangles<'t>) -> Self {
        Self { triangles, found: false }
    }

    /// The exact test of a triangle.
    #[cold]
    #[inline(never)]
    fn decide(&self, slot: usize) -> bool {
        self.triangles.hit(slot).is_some()
    }
}

impl Search for Any<'_> {
    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, lanes: L, leaf: u32, counter: &mut impl Counter) -> f32 {
        let (first, count) = blocks_of(leaf);
        counter.leaf(LANES * count);
        let range = self.triangles.ray.range;
        let start = greater(range.min, 0.0);
        for (number, block) in (first..).zip(&self.triangles.blocks[first..first + count]) {
            let Some(found) = self.triangles.block_ray.meet(lanes, block, start, range.max) else { continue };
            let certain = found.lanes & found.within & !found.on_edge;
            let mut doubtful = if certain == 0 { found.lanes } else { 0 };
            self.found = certain != 0;
            while doubtful != 0 && !self.found {
                let lane = doubtful.trailing_zeros() as usize % LANES;
                doubtful &= doubtful - 1;
                self.found = self.decide(LANES * number + lane);
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
    pub(super) triangles: Triangles<'t>,
    pub(super) visit: V,
}

impl<V: FnMut(MeshHit)> Search for Each<'_, V> {
    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, lanes: L, leaf: u32, counter: &mut impl Counter) -> f32 {
        let (first, count) = blocks_of(leaf);
        counter.leaf(LANES * count);
        let range = self.triangles.ray.range;
        for (number, block) in (first..).zip(&self.triangles.blocks[first..first + count]) {
            let Some(found) = self.triangles.block_ray.meet(lanes, block, range.min, range.max) else {
                continue;
            };
            let mut candidates = found.lanes;
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize % LANES;
                candidates &= candidates - 1;
                if let Some(hit) = self.triangles.hit(LANES * number + lane) {
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
