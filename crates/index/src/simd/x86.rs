//! The lanes on AVX2 and AVX-512.

use super::portable::Portable;
use super::{LANES, Lanes, Pending, Row, Stack, Task};
use glam::Vec3A;
use std::arch::x86_64::*;

pub(super) fn has_avx2() -> bool {
    is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") && is_x86_feature_detected!("popcnt")
}

pub(super) fn has_avx512() -> bool {
    has_avx2()
        && is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("bmi1")
        && is_x86_feature_detected!("bmi2")
        && is_x86_feature_detected!("lzcnt")
}

/// # Safety
/// The processor must have SSE4.1.
#[target_feature(enable = "sse4.1")]
pub(super) unsafe fn run_sse41<T: Task>(task: T) -> T::Output {
    task.run(Portable)
}

/// # Safety
/// [`has_avx2`] must hold.
#[target_feature(enable = "avx2,fma,popcnt")]
pub(super) unsafe fn run_avx2<T: Task>(task: T) -> T::Output {
    task.run(Avx2(()))
}

/// # Safety
/// [`has_avx512`] must hold.
#[target_feature(enable = "avx2,fma,popcnt,bmi1,bmi2,lzcnt,avx512f,avx512vl,avx512dq")]
pub(super) unsafe fn run_avx512<T: Task>(task: T) -> T::Output {
    task.run(Avx512(()))
}

/// Stands for [`has_avx2`]; made by [`run_avx2`] alone.
#[derive(Clone, Copy)]
pub(super) struct Avx2(());

/// Stands for [`has_avx512`]; made by [`run_avx512`] alone.
#[derive(Clone, Copy)]
pub(super) struct Avx512(());

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

/// For each axis, the lanes in cyclic order, this axis last.
static TURNS: [Turn; 3] = [Turn([1, 2, 0, 3]), Turn([2, 0, 1, 3]), Turn([0, 1, 2, 3])];

/// Numbers of lanes, aligned for one load.
#[repr(C, align(16))]
struct Turn([i32; 4]);

/// The methods that both kinds share.
macro_rules! on_256_bits {
    () => {
        type F = __m256;

        #[inline(always)]
        fn splat(self, x: f32) -> __m256 {
            // SAFETY (here and below): the value stands for a processor that has the instruction.
            unsafe { _mm256_set1_ps(x) }
        }

        #[inline(always)]
        fn load(self, row: &Row) -> __m256 {
            // SAFETY: a row is eight aligned floats.
            unsafe { _mm256_load_ps(row.0.as_ptr()) }
        }

        #[inline(always)]
        fn sub(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_sub_ps(a, b) }
        }

        #[inline(always)]
        fn mul(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_mul_ps(a, b) }
        }

        #[inline(always)]
        fn add(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_add_ps(a, b) }
        }

        #[inline(always)]
        fn div(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_div_ps(a, b) }
        }

        #[inline(always)]
        fn store(self, a: __m256) -> Row {
            let mut row = Row([0.0; LANES]);
            // SAFETY: a row is eight aligned floats.
            unsafe { _mm256_store_ps(row.0.as_mut_ptr(), a) };
            row
        }

        #[inline(always)]
        fn mul_sub(self, a: __m256, b: __m256, c: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_fmsub_ps(a, b, c) }
        }

        #[inline(always)]
        fn mul_add(self, a: __m256, b: __m256, c: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_fmadd_ps(a, b, c) }
        }

        #[inline(always)]
        fn min(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_min_ps(a, b) }
        }

        #[inline(always)]
        fn max(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_max_ps(a, b) }
        }

        #[inline(always)]
        fn turned(self, along: usize, v: Vec3A) -> Vec3A {
            // SAFETY: see `splat`.
            unsafe { _mm_permutevar_ps(v.into(), _mm_load_si128(TURNS[along % 3].0.as_ptr().cast())).into() }
        }

        #[inline(always)]
        fn sooner(self, a: __m256, b: __m256) -> __m256 {
            // The bits of floats compare as signed integers do, but for the order among negative ones; and sooner.
            // SAFETY: see `splat`.
            unsafe { _mm256_castsi256_ps(_mm256_min_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b))) }
        }

        #[inline(always)]
        fn later(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_castsi256_ps(_mm256_max_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b))) }
        }
    };
}

/// The largest of the numbers, or one below 0 where none is larger than 0; and the one farthest below 0, or one above: as integers,
/// which compare sooner.
#[inline(always)]
unsafe fn extremes(a: __m256, b: __m256, c: __m256) -> (__m256i, __m256i) {
    // SAFETY: the caller has AVX2.
    unsafe {
        let (a, b, c) = (_mm256_castps_si256(a), _mm256_castps_si256(b), _mm256_castps_si256(c));
        // The sign bit of a float makes it small among signed integers, and large among unsigned ones.
        (_mm256_max_epi32(_mm256_max_epi32(a, b), c), _mm256_max_epu32(_mm256_max_epu32(a, b), c))
    }
}

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
        row.put(stack, forgets);
        first
    }

    #[inline(always)]
    fn enter_evenly(
        self,
        stack: &mut Self::Stack<'_>,
        near: __m256,
        far: __m256,
        children: &[u32; LANES],
        order: u32,
        forgets: bool,
    ) -> u32 {
        self.row(near, far, children, order).put(stack, forgets)
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
    /// Pushes all but the one to be entered first, which comes back; where there is none, what was on top.
    #[inline(always)]
    fn put(self, stack: &mut Stack<'_, false>, forgets: bool) -> u32 {
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
        stack.take()
    }
}

impl Lanes for Avx512 {
    type Stack<'r> = Stack<'r, true>;

    on_256_bits!();

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
        let (hits, nears, children) = self.in_order(near, far, children, order);
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
    fn enter_evenly(
        self,
        stack: &mut Self::Stack<'_>,
        near: __m256,
        far: __m256,
        children: &[u32; LANES],
        order: u32,
        forgets: bool,
    ) -> u32 {
        let (hits, nears, children) = self.in_order(near, far, children, order);
        // What is on top comes first where there are no hits.
        // SAFETY: see `splat`.
        let children =
            unsafe { _mm256_mask_compress_epi32(_mm256_set1_epi32(stack.top() as i32), hits, children) };
        self.push_row(stack, hits, children, if forgets { Some(nears) } else { None });
        stack.take();
        self.first(children)
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
            let children = _mm256_maskz_compress_epi32(kept, children);
            self.push_row(stack, kept, children, Some(nears));
        }
    }
}

impl Avx512 {
    /// The children in the order in which the ray meets them: those that are hit, where, and what they are.
    #[inline(always)]
    fn in_order(
        self,
        near: __m256,
        far: __m256,
        children: &[u32; LANES],
        order: u32,
    ) -> (__mmask8, __m256, __m256i) {
        // SAFETY: see `splat`.
        unsafe {
            let shifts = _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
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

    /// [`Avx512::push`] for many rays in turn: stores that leave lanes out hold up the loads of other rays behind them.
    #[inline(always)]
    fn push_row(self, stack: &mut Stack<'_, true>, hits: __mmask8, children: __m256i, nears: Option<__m256>) {
        let count = hits.count_ones() as usize;
        // The whole row is stored, its end turned to the old top; what lies before its start is free.
        let (to_children, to_nears) = stack.row(LANES);
        // SAFETY: see `splat`; there is room for a row.
        unsafe {
            let turn = _mm256_loadu_si256(COUNT.as_ptr().add(count).cast());
            _mm256_storeu_si256(to_children.cast(), _mm256_permutevar8x32_epi32(children, turn));
            if let Some(nears) = nears {
                let nears = _mm256_maskz_compress_ps(hits, nears);
                _mm256_storeu_ps(to_nears, _mm256_permutevar8x32_ps(nears, turn));
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

/// The numbers of lanes, once more behind the last.
static COUNT: [i32; 2 * LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7];
