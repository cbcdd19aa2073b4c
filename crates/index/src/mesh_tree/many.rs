//! Searching leaves for the triangles of many rays.
//!
//! All rays that stand at a leaf look at a block before the first looks at its next one. What they may meet is noted as pairs of a
//! ray and a triangle, and these are intersected exactly, side by side, once all have looked: for so many at once that costs less
//! than to bound distances first, as [`super::search`] does for one.

use super::eyes::Eyes;
use super::search::exact;
use super::{MeshHit, MeshTree};
use crate::simd::{LANES, Lanes, Task};
use crate::wide::batch::Question;
use crate::wide::rays::{PerRay, Rays, TOGETHER};
use crate::wide::set::Set;
use heliostat_geometry::triangle::TriangleHit;
use heliostat_geometry::triangle_columns::{PAIRS, PairHits, Pairs};

/// What is asked of each ray.
pub(super) trait Ask {
    type Answer;

    /// Whether any hit will do.
    const ANY: bool;

    fn answer(found: Option<MeshHit>) -> Self::Answer;
}

/// The nearest hit.
pub(super) struct Nearest;

impl Ask for Nearest {
    type Answer = Option<MeshHit>;
    const ANY: bool = false;

    #[inline(always)]
    fn answer(found: Option<MeshHit>) -> Option<MeshHit> {
        found
    }
}

/// Whether there is a hit.
pub(super) struct Any;

impl Ask for Any {
    type Answer = bool;
    const ANY: bool = true;

    #[inline(always)]
    fn answer(found: Option<MeshHit>) -> bool {
        found.is_some()
    }
}

/// The search for what is asked of many rays.
pub(super) struct Many<'t, A: Ask> {
    tree: &'t MeshTree,
    eyes: Eyes,
    /// The nearest hit of each ray so far.
    found: PerRay<MeshHit>,
    /// The block that each looked at last, and the lanes with triangles that it may meet.
    block: PerRay<u32>,
    met: PerRay<u8>,
    pairs: Pairs,
    hits: PairHits,
    /// The ray of each pair, and the lane of its triangle, counted over all blocks.
    ray: [u8; PAIRS],
    slot: [u32; PAIRS],
    /// How many pairs there are.
    count: usize,
    pub(super) answers: Vec<A::Answer>,
}

/// Stands for a triangle where there is none.
const NONE: u32 = u32::MAX;

const NO_HIT: MeshHit =
    MeshHit { triangle: NONE, hit: TriangleHit { t: f32::INFINITY, barycentric: [0.0; 3] } };

impl<'t, A: Ask> Many<'t, A> {
    pub(super) fn new(tree: &'t MeshTree, rays: usize) -> Self {
        Self {
            tree,
            eyes: Eyes::NONE,
            found: [NO_HIT; TOGETHER],
            block: [0; TOGETHER],
            met: [0; TOGETHER],
            pairs: Pairs::EMPTY,
            hits: PairHits::EMPTY,
            ray: [0; PAIRS],
            slot: [0; PAIRS],
            count: 0,
            answers: Vec::with_capacity(rays),
        }
    }

    /// Looks at the next block of each leaf: which of the rays may meet triangles there, and whose leaf has more blocks.
    #[inline(always)]
    fn look<L: Lanes>(
        &mut self,
        lanes: L,
        rays: &Rays,
        at_leaves: Set,
        leaves: &mut PerRay<u32>,
    ) -> (Set, Set) {
        let (mut met, mut more) = (Set::EMPTY, Set::EMPTY);
        let (eyes, blocks, tags) = (&self.eyes, &self.tree.blocks[..], &self.tree.tags[..]);
        for ray in at_leaves {
            let (number, rest) = next_block(&mut leaves[ray]);
            let (block, tag) = (&blocks[number as usize], &tags[number as usize]);
            let seen = eyes.eye(lanes, ray).see(lanes, &block.rows);
            // Mostly the triangle that the ray comes from; rays from outside have nothing behind them worth the look.
            let behind = if rays.any_inside { seen.behind(lanes, tag.extent, eyes.dir(ray)) } else { 0 };
            let candidates = seen.inside(lanes) & tag.present & !behind;
            (self.block[ray], self.met[ray]) = (number, candidates as u8);
            met.add(ray, candidates != 0);
            more.add(ray, rest != 0);
        }
        (met, more)
    }

    /// Notes the pairs of rays and triangles that may meet.
    #[inline(always)]
    fn note<L: Lanes>(
        &mut self,
        lanes: L,
        rays: &Rays,
        met: Set,
        limits: &mut PerRay<f32>,
        shortened: &mut Set,
    ) {
        for ray in met {
            let (block, mut candidates) = (self.block[ray] as usize, self.met[ray]);
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize;
                candidates &= candidates - 1;
                let place = self.count % PAIRS;
                self.eyes.pair(&mut self.pairs, place, ray, &self.tree.blocks[block].rows, lane);
                (self.ray[place], self.slot[place]) = (ray as u8, (LANES * block + lane) as u32);
                self.count += 1;
                if self.count == PAIRS {
                    self.decide(lanes, rays, limits, shortened);
                }
            }
        }
    }

    /// Intersects all pairs, and keeps the nearest hits.
    #[inline(always)]
    fn decide<L: Lanes>(&mut self, lanes: L, rays: &Rays, limits: &mut PerRay<f32>, shortened: &mut Set) {
        let count = std::mem::replace(&mut self.count, 0).min(PAIRS);
        lanes.run_loops(Intersect { hits: &mut self.hits, pairs: &self.pairs, count });
        for i in 0..count {
            let (ray, slot) = (usize::from(self.ray[i]) % TOGETHER, self.slot[i] as usize);
            let Some(hit) = self.hit(rays, i, ray, slot) else { continue };
            let triangle = self.tree.tree.leaf_refs()[slot];
            let is_nearer = hit.t < limits[ray];
            let is_first = (hit.t == limits[ray]) & (triangle < self.found[ray].triangle);
            if (is_nearer | is_first) & (hit.t >= rays.min[ray]) {
                limits[ray] = if A::ANY { f32::NEG_INFINITY } else { hit.t };
                self.found[ray] = MeshHit { triangle, hit };
                shortened.add(ray, true);
            }
        }
    }

    /// The hit of a pair.
    #[inline(always)]
    fn hit(&self, rays: &Rays, pair: usize, ray: usize, slot: usize) -> Option<TriangleHit> {
        if self.hits.is_sure[pair] == 0 {
            return exact(self.tree, &rays.ray(ray), slot).map(|found| found.hit);
        }
        let [a, b, c] = &self.hits.barycentric;
        let t = self.hits.t[pair];
        (t > 0.0).then_some(TriangleHit { t, barycentric: [a[pair], b[pair], c[pair]] })
    }
}

/// Begins with other rays.
struct Begin<'a> {
    eyes: &'a mut Eyes,
    found: &'a mut PerRay<MeshHit>,
    rays: &'a Rays,
}

impl Task for Begin<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) {
        self.eyes.set_up(self.rays);
        *self.found = [NO_HIT; TOGETHER];
    }
}

/// Intersects the first pairs.
struct Intersect<'a> {
    hits: &'a mut PairHits,
    pairs: &'a Pairs,
    count: usize,
}

impl Task for Intersect<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) {
        self.hits.intersect(self.pairs, self.count);
    }
}

/// Takes the next block of a leaf; gives also how many are left.
#[inline(always)]
fn next_block(leaf: &mut u32) -> (u32, u32) {
    const COUNT: u32 = 1 << 24;
    let block = *leaf % COUNT;
    // The block behind it, and one block less.
    *leaf = leaf.wrapping_sub(COUNT - 1);
    (block, *leaf & (0x7F * COUNT))
}

impl<A: Ask> Question for Many<'_, A> {
    const SHORTENS: bool = !A::ANY;

    #[inline(always)]
    fn begin<L: Lanes>(&mut self, lanes: L, rays: &Rays) {
        lanes.run_loops(Begin { eyes: &mut self.eyes, found: &mut self.found, rays });
    }

    #[cold]
    fn ask_alone(&mut self, rays: &Rays, ray: usize) {
        let found = self.tree.closest_hit(&rays.ray(ray));
        self.found[ray] = found.unwrap_or(NO_HIT);
    }

    #[inline(always)]
    fn search<L: Lanes>(
        &mut self,
        lanes: L,
        rays: &Rays,
        mut at_leaves: Set,
        leaves: &mut PerRay<u32>,
        limits: &mut PerRay<f32>,
    ) -> Set {
        let mut shortened = Set::EMPTY;
        while !at_leaves.is_empty() {
            let (met, more) = self.look(lanes, rays, at_leaves, leaves);
            self.note(lanes, rays, met, limits, &mut shortened);
            at_leaves = more;
        }
        self.decide(lanes, rays, limits, &mut shortened);
        shortened
    }

    #[inline(always)]
    fn finish(&mut self, rays: &Rays) {
        let found = &self.found[..rays.len.min(TOGETHER)];
        self.answers.extend(found.iter().map(|hit| A::answer((hit.triangle != NONE).then_some(*hit))));
    }
}
