//! The lanes on AVX2 and AVX-512: what both share, and how code for them is entered.

use super::Task;
use super::portable::Portable;
use avx2::Avx2;
use avx512::Avx512;
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

/// [`run_avx2`], never as a part of code for AVX-512.
///
/// # Safety
/// [`has_avx2`] must hold.
#[inline(never)]
#[target_feature(enable = "avx2,fma,popcnt")]
unsafe fn run_avx2_apart<T: Task>(task: T) -> T::Output {
    task.run(Avx2(()))
}

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
        fn signed_by(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: see `splat`.
            unsafe { _mm256_xor_ps(a, _mm256_and_ps(b, _mm256_set1_ps(-0.0))) }
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

mod avx2;
mod avx512;

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
