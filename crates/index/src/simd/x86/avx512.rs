//! The lanes on AVX-512: sets of lanes are masks, and packed by an instruction.

use super::{TURNS, extremes, run_avx2_apart};
use crate::simd::{LANES, Lanes, Pending, Row, Stack, Task};
use glam::Vec3A;
use std::arch::x86_64::*;

/// Stands for [`super::has_avx512`]; made by [`super::run_avx512`] alone.
#[derive(Clone, Copy)]
pub(super) struct Avx512(pub(super) ());

impl Lanes for Avx512 {
    type Stack<'r> = Stack<'r, true>;

    on_256_bits!();

    #[inline(always)]
    fn run_loops<T: Task>(self, loops: T) -> T::Output {
        // SAFETY: what has AVX-512 has AVX2.
        unsafe { run_avx2_apart(loops) }
    }

    #[inline(always)]
    fn lt(self, a: __m256, b: __m256) -> u32 {
        // SAFETY: see `splat`.
        unsafe { u32::from(_mm256_cmp_ps_mask::<_CMP_LT_OQ>(a, b)) }
    }

    #[inline(always)]
    fn any_zero(self, a: __m256, b: __m256, c: __m256) -> u32 {
        // SAFETY: see `splat`.
        unsafe {
            let zero = |x| _mm256_cmp_ps_mask::<_CMP_EQ_OQ>(x, _mm256_setzero_ps());
            u32::from(zero(a) | zero(b) | zero(c))
        }
    }

    #[inline(always)]
    fn mixed_signs(self, a: __m256, b: __m256, c: __m256) -> u32 {
        // SAFETY: see `splat`.
        unsafe {
            let (highest, lowest) = extremes(a, b, c);
            let positive = _mm256_cmpgt_epi32_mask(highest, _mm256_setzero_si256());
            // Beyond -0.0.
            let negative = _mm256_cmpgt_epu32_mask(lowest, _mm256_set1_epi32(i32::MIN));
            u32::from(negative & positive)
        }
    }

    #[inline(always)]
    fn larger_size(self, a: __m256, b: __m256) -> __m256 {
        // The larger (1) of the absolute values, without a sign (2).
        const LARGER_SIZE: i32 = 0b10_11;
        // SAFETY: see `splat`.
        unsafe { _mm256_range_ps::<LARGER_SIZE>(a, b) }
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
        let (hits, nears, children) = self.in_order(FROM_FIRST, near, far, children, order);
        if hits == 0 {
            return stack.pop();
        }
        // SAFETY: see `splat`.
        let children = unsafe { _mm256_maskz_compress_epi32(hits, children) };
        self.push(stack, hits, children, if forgets { Some(nears) } else { None });
        stack.take();
        // It is known sooner from its register.
        self.first(children)
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
        let (hits, nears, children) = self.in_order(FROM_LAST, near, far, children, order);
        self.push_row(stack, hits, children, if forgets { Some(nears) } else { None });
    }

    #[inline(always)]
    fn forget_of_many(self, stack: &mut Stack<'_, false>, limit: f32) {
        let count = stack.len();
        if count > LANES {
            stack.forget_beyond(limit);
            return;
        }
        let (children, nears) = stack.lowest_row();
        // SAFETY: see `splat`; the lowest row is written, if only with nothing.
        unsafe {
            let there = _bzhi_u32(0xFF, count as u32) as u8;
            let (children, nears) = (_mm256_loadu_si256(children.cast()), _mm256_loadu_ps(nears));
            let kept = there & _mm256_cmp_ps_mask::<_CMP_LE_OQ>(nears, _mm256_set1_ps(limit));
            stack.clear();
            self.push_row(stack, kept, children, Some(nears));
        }
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
            let there = (0xFF00_u32 >> count) as u8;
            let (children, nears) = (_mm256_load_si256(children.cast()), _mm256_load_ps(nears));
            let kept = there & _mm256_cmp_ps_mask::<_CMP_LE_OQ>(nears, _mm256_set1_ps(limit));
            stack.clear();
            self.push(stack, kept, _mm256_maskz_compress_epi32(kept, children), Some(nears));
        }
    }
}

impl Avx512 {
    /// The children in an order of those in which a ray may meet them: which are hit, where, and what they are.
    #[inline(always)]
    fn in_order(
        self,
        Shifts(shifts): Shifts,
        near: __m256,
        far: __m256,
        children: &[u32; LANES],
        order: u32,
    ) -> (__mmask8, __m256, __m256i) {
        // SAFETY: see `splat`.
        unsafe {
            let shifts = _mm256_loadu_si256(shifts.as_ptr().cast());
            let lanes = _mm256_srlv_epi32(_mm256_set1_epi32(order as i32), shifts);
            let near = _mm256_permutexvar_ps(lanes, near);
            let far = _mm256_permutexvar_ps(lanes, far);
            let children = _mm256_permutexvar_epi32(lanes, _mm256_loadu_si256(children.as_ptr().cast()));
            (_mm256_cmp_ps_mask::<_CMP_LE_OQ>(near, far), near, children)
        }
    }

    /// Pushes the hits among the distances, and as many packed children, the first on top.
    #[inline(always)]
    fn push(self, stack: &mut Stack<'_, true>, hits: __mmask8, children: __m256i, nears: Option<__m256>) {
        let count = hits.count_ones();
        let (to_children, to_nears) = stack.row(count as usize);
        // SAFETY: see `splat`; there is room for a row.
        unsafe {
            let used = _bzhi_u32(0xFF, count) as u8;
            _mm256_mask_storeu_epi32(to_children.cast(), used, children);
            if let Some(nears) = nears {
                _mm256_mask_storeu_ps(to_nears, used, _mm256_maskz_compress_ps(hits, nears));
            }
        }
        stack.grow(count as usize);
    }

    /// Pushes those of a row that are in a set, the last on top. The whole row is stored, what is too much on free places: a store
    /// that leaves lanes out holds up the loads of other rays behind it.
    #[inline(always)]
    fn push_row(self, stack: &mut Stack<'_, false>, set: __mmask8, children: __m256i, nears: Option<__m256>) {
        let count = set.count_ones() as usize;
        let (to_children, to_nears) = stack.row(count);
        // SAFETY: see `splat`; there is room for a row.
        unsafe {
            _mm256_storeu_si256(to_children.cast(), _mm256_maskz_compress_epi32(set, children));
            if let Some(nears) = nears {
                _mm256_storeu_ps(to_nears, _mm256_maskz_compress_ps(set, nears));
            }
        }
        stack.grow(count);
    }

    /// The first of packed children.
    #[inline(always)]
    fn first(self, children: __m256i) -> u32 {
        // SAFETY: see `splat`.
        unsafe { _mm_cvtsi128_si32(_mm256_castsi256_si128(children)) as u32 }
    }
}

/// By how much to shift the order of children for each lane.
#[derive(Clone, Copy)]
struct Shifts([i32; LANES]);

const FROM_FIRST: Shifts = Shifts([0, 3, 6, 9, 12, 15, 18, 21]);
const FROM_LAST: Shifts = Shifts([21, 18, 15, 12, 9, 6, 3, 0]);
