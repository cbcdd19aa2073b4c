//! The lanes on AVX2: sets of lanes are packed by a table.

use super::{TURNS, extremes};
use crate::simd::{LANES, Lanes, Pending, Row, Stack};
use glam::Vec3A;
use std::arch::x86_64::*;

/// Stands for [`super::has_avx2`]; made by [`super::run_avx2`] alone.
#[derive(Clone, Copy)]
pub(super) struct Avx2(pub(super) ());

/// For each set of lanes, the numbers of those in it, in order, in eight bytes.
static PACKED: [u64; 256] = {
    let mut table = [0_u64; 256];
    let mut set = 0;
    while set < 256 {
        let (mut lane, mut place) = (0, 0);
        while lane < LANES {
            if set >> lane & 1 != 0 {
                table[set] |= (lane as u64) << (8 * place);
                place += 1;
            }
            lane += 1;
        }
        set += 1;
    }
    table
};

impl Lanes for Avx2 {
    type Stack<'r> = Stack<'r, false>;

    on_256_bits!();

    #[inline(always)]
    fn lt(self, a: __m256, b: __m256) -> u32 {
        // SAFETY: see `splat`.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(a, b)) as u32 }
    }

    #[inline(always)]
    fn any_zero(self, a: __m256, b: __m256, c: __m256) -> u32 {
        // SAFETY: see `splat`.
        unsafe {
            let zero = |x| _mm256_cmp_ps::<_CMP_EQ_OQ>(x, _mm256_setzero_ps());
            _mm256_movemask_ps(_mm256_or_ps(_mm256_or_ps(zero(a), zero(b)), zero(c))) as u32
        }
    }

    #[inline(always)]
    fn mixed_signs(self, a: __m256, b: __m256, c: __m256) -> u32 {
        // SAFETY: see `splat`.
        unsafe {
            let (highest, lowest) = extremes(a, b, c);
            let positive = _mm256_cmpgt_epi32(highest, _mm256_setzero_si256());
            // Beyond -0.0: with the sign bit turned, among signed integers.
            let turned = _mm256_xor_si256(lowest, _mm256_set1_epi32(i32::MIN));
            let negative = _mm256_cmpgt_epi32(turned, _mm256_setzero_si256());
            _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_and_si256(negative, positive))) as u32
        }
    }

    #[inline(always)]
    fn larger_size(self, a: __m256, b: __m256) -> __m256 {
        // SAFETY: see `splat`.
        unsafe {
            let sign = _mm256_set1_ps(-0.0);
            _mm256_max_ps(_mm256_andnot_ps(sign, a), _mm256_andnot_ps(sign, b))
        }
    }

    #[inline(always)]
    fn enter(
        self,
        stack: &mut Self::Stack<'_>,
        near: __m256,
        far: __m256,
        children: &[u32; LANES],
        order: u32,
        forgets: bool,
    ) -> u32 {
        let row = self.row(near, far, children, order);
        if row.hits == 0 {
            return stack.pop();
        }
        // It is known sooner by its lane.
        let first = row.ordered[row.hits.ilog2() as usize % LANES];
        row.push(stack, forgets);
        stack.take();
        first
    }

    #[inline(always)]
    fn push_met(
        self,
        stack: &mut Stack<'_, false>,
        near: __m256,
        far: __m256,
        children: &[u32; LANES],
        order: u32,
        forgets: bool,
    ) {
        self.row(near, far, children, order).push(stack, forgets);
    }

    #[inline(always)]
    fn forget_of_many(self, stack: &mut Stack<'_, false>, limit: f32) {
        self.forget_beyond(stack, limit);
    }

    #[inline(always)]
    fn forget_beyond(self, stack: &mut Self::Stack<'_>, limit: f32) {
        let count = stack.len();
        if count > LANES {
            stack.forget_beyond(limit);
            return;
        }
        let (children, nears) = stack.lowest_row();
        // SAFETY: see `splat`; the lowest row is written, if only with nothing.
        unsafe {
            let (children, nears) = (_mm256_loadu_si256(children.cast()), _mm256_loadu_ps(nears));
            let near = _mm256_cmp_ps::<_CMP_LE_OQ>(nears, _mm256_set1_ps(limit));
            let kept = _mm256_movemask_ps(near) as u32 & !(u32::MAX << count);
            let lanes = self.packed(kept);
            stack.clear();
            let (to_children, to_nears) = stack.row(LANES);
            _mm256_storeu_si256(to_children.cast(), _mm256_permutevar8x32_epi32(children, lanes));
            _mm256_storeu_ps(to_nears, _mm256_permutevar8x32_ps(nears, lanes));
            stack.grow(kept.count_ones() as usize);
        }
    }
}

impl Avx2 {
    /// The numbers of the lanes in a set, in order.
    #[inline(always)]
    fn packed(self, set: u32) -> __m256i {
        // SAFETY: see `splat`.
        unsafe { _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(PACKED[set as usize & 255] as i64)) }
    }

    /// The children that are hit, from the last to the first.
    #[inline(always)]
    fn row(self, near: __m256, far: __m256, children: &[u32; LANES], order: u32) -> Hits {
        // SAFETY: see `splat`.
        unsafe {
            let shifts = _mm256_setr_epi32(21, 18, 15, 12, 9, 6, 3, 0);
            let lanes = _mm256_srlv_epi32(_mm256_set1_epi32(order as i32), shifts);
            let all = _mm256_loadu_si256(children.as_ptr().cast());
            let mut ordered = [0; LANES];
            _mm256_storeu_si256(ordered.as_mut_ptr().cast(), _mm256_permutevar8x32_epi32(all, lanes));
            let hit = _mm256_cmp_ps::<_CMP_LE_OQ>(near, far);
            let hits = _mm256_movemask_ps(_mm256_permutevar8x32_ps(hit, lanes)) as u32;
            let lanes = _mm256_permutevar8x32_epi32(lanes, self.packed(hits));
            Hits {
                hits,
                ordered,
                children: _mm256_permutevar8x32_epi32(all, lanes),
                nears: _mm256_permutevar8x32_ps(near, lanes),
            }
        }
    }
}

/// Children that are hit.
struct Hits {
    /// A bit for each, the first to be entered highest.
    hits: u32,
    /// All children in that order.
    ordered: [u32; LANES],
    /// Those that are hit, packed.
    children: __m256i,
    nears: __m256,
}

impl Hits {
    /// Pushes them.
    #[inline(always)]
    fn push(self, stack: &mut Stack<'_, false>, forgets: bool) {
        let count = self.hits.count_ones() as usize;
        let (to_children, to_nears) = stack.row(count);
        // SAFETY: AVX2 made the row, and there is room for it.
        unsafe {
            _mm256_storeu_si256(to_children.cast(), self.children);
            if forgets {
                _mm256_storeu_ps(to_nears, self.nears);
            }
        }
        stack.grow(count);
    }
}
