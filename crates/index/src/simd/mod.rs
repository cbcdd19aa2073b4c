//! Eight lanes of `f32` at a time: the one module that is allowed `unsafe`.
//!
//! [`Lanes`] is what the walk and the triangle test are written in. Each back end is a type of the same eight lanes;
//! which of them a processor has is found out at run time ([`Backend::best`]), and `Backend::run` enters code that the
//! compiler made for it. [`portable::Portable`] does everything on plain arrays: it is the twin that the others are held to,
//! the form that Miri reads, and what processors without a back end of their own use.
//!
//! Back ends may differ in what [`Lanes::mul_add`] and [`Lanes::mul_sub`] round; these are for distances that carry a bound of
//! their error. All else they round alike, and what is found in the end is decided by the same exact test.

#![expect(unsafe_code, reason = "vector instructions, uninitialised stacks and rows chosen by a ray")]

pub(crate) mod portable;
pub(crate) mod stack;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use stack::{END, Pending, Stack, StackRoom, Stacks};

use glam::Vec3A;
use std::marker::PhantomData;

/// How many lanes there are.
pub(crate) const LANES: usize = 8;

/// Eight numbers, one a lane, aligned for one load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Row(pub(crate) [f32; LANES]);

/// A place in an array of `N`, chosen by a ray and then used without a check.
#[derive(Debug)]
pub(crate) struct Pick<T, const N: usize> {
    /// In bytes: the product would be made again at each use.
    offset: usize,
    of: PhantomData<T>,
}

impl<T, const N: usize> Clone for Pick<T, N> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<T, const N: usize> Copy for Pick<T, N> {}

impl<T, const N: usize> Pick<T, N> {
    /// The place `i`, taken modulo the size of the array.
    #[inline(always)]
    pub(crate) const fn new(i: usize) -> Self {
        Self { offset: i % N * size_of::<T>(), of: PhantomData }
    }

    /// What is there.
    #[inline(always)]
    pub(crate) fn of(self, items: &[T; N]) -> &T {
        // SAFETY: it is the offset of a place less than `N`.
        unsafe { &*items.as_ptr().byte_add(self.offset) }
    }

    /// What is there, read by itself: of reads that lie a row apart the compiler makes masked ones of 512 bits, which take longer
    /// and slow down what runs beside them.
    #[inline(always)]
    pub(crate) fn alone(self, items: &[T; N]) -> T
    where
        T: Copy,
    {
        // SAFETY: a reference is valid to read from.
        unsafe { std::ptr::from_ref(self.of(items)).read_volatile() }
    }
}

/// Eight lanes of `f32` on one kind of processor.
///
/// A value of the type stands for the fact that the processor has what the methods need.
pub(crate) trait Lanes: Copy {
    /// Eight `f32`.
    type F: Copy;

    fn splat(self, x: f32) -> Self::F;
    fn load(self, row: &Row) -> Self::F;
    fn sub(self, a: Self::F, b: Self::F) -> Self::F;
    fn mul(self, a: Self::F, b: Self::F) -> Self::F;
    fn add(self, a: Self::F, b: Self::F) -> Self::F;
    fn div(self, a: Self::F, b: Self::F) -> Self::F;
    fn store(self, a: Self::F) -> Row;
    /// `a * b - c`, rounded once or twice.
    fn mul_sub(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    /// `a * b + c`, rounded once or twice.
    fn mul_add(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    /// The smaller; `b` where one is NaN.
    fn min(self, a: Self::F, b: Self::F) -> Self::F;
    /// The larger; `b` where one is NaN.
    fn max(self, a: Self::F, b: Self::F) -> Self::F;
    /// The smaller; where one is negative, a negative one.
    fn sooner(self, a: Self::F, b: Self::F) -> Self::F;
    /// The larger; where both are negative, either.
    fn later(self, a: Self::F, b: Self::F) -> Self::F;
    /// The larger of the absolute values; any of them where one is NaN.
    fn larger_size(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a`, with the other sign where `b` is negative or -0.
    fn signed_by(self, a: Self::F, b: Self::F) -> Self::F;
    /// A bit for each lane in which `a < b`.
    fn lt(self, a: Self::F, b: Self::F) -> u32;
    /// A bit for each lane that has a zero.
    fn any_zero(self, a: Self::F, b: Self::F, c: Self::F) -> u32;
    /// A bit for each lane that has one number below 0 and another above; either where one is NaN.
    fn mixed_signs(self, a: Self::F, b: Self::F, c: Self::F) -> u32;

    /// Runs plain loops over columns, in code that knows of no wider registers than the lanes: the processor has fewer units for
    /// everything else while wider ones are in use.
    #[inline(always)]
    fn run_loops<T: Task>(self, loops: T) -> T::Output {
        loops.run(self)
    }

    /// The coordinates in cyclic order, axis `along` of 0, 1, 2 last.
    fn turned(self, along: usize, v: Vec3A) -> Vec3A;

    /// The stack of a walk.
    type Stack<'r>: Pending<'r>;

    /// The first child with `near <= far`, in the order in which `order` names their lanes (three bits each, the first in the
    /// lowest); the others are pushed, so that the next one in order is on top. Where there is none, the child on top of the
    /// stack. The distances are kept with the children only where some may have to be forgotten.
    fn enter(
        self,
        stack: &mut Self::Stack<'_>,
        near: Self::F,
        far: Self::F,
        children: &[u32; LANES],
        order: u32,
        forgets: bool,
    ) -> u32;

    /// Pushes all children with `near <= far`, so that the first in `order` is on top: without a branch, for many rays in turn, for
    /// which what comes next is hard to foresee.
    fn push_met(
        self,
        stack: &mut Stack<'_, false>,
        near: Self::F,
        far: Self::F,
        children: &[u32; LANES],
        order: u32,
        forgets: bool,
    );

    /// Forgets all children on the stack of one of many rays that are entered beyond `limit`.
    #[inline(always)]
    fn forget_of_many(self, stack: &mut Stack<'_, false>, limit: f32) {
        stack.forget_beyond(limit);
    }

    /// Forgets all children on the stack that are entered beyond `limit`.
    #[inline(always)]
    fn forget_beyond(self, stack: &mut Self::Stack<'_>, limit: f32) {
        stack.forget_beyond(limit);
    }
}

/// What a [`Backend`] is to run: a function that is generic over the lanes.
pub(crate) trait Task {
    type Output;

    /// Must be `#[inline(always)]`, to be compiled for each back end.
    fn run<L: Lanes>(self, lanes: L) -> Self::Output;
}

/// Code for one kind of processor; there is a value only where this processor can run it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Backend(Kind);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Sse41,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Backend {
    /// Plain arrays, on every processor; the compiler makes SSE2 or NEON of them.
    pub const PORTABLE: Self = Self(Kind::Portable);

    /// All that this processor can run, slowest first: `portable`, `sse4.1`, `avx2`, `avx512`.
    pub fn available() -> Vec<Self> {
        #[cfg_attr(not(target_arch = "x86_64"), expect(unused_mut, reason = "one back end"))]
        let mut all = vec![Self::PORTABLE];
        #[cfg(all(target_arch = "x86_64", not(miri)))]
        {
            let detected = [
                (is_x86_feature_detected!("sse4.1"), Kind::Sse41),
                (x86::has_avx2(), Kind::Avx2),
                (x86::has_avx512(), Kind::Avx512),
            ];
            all.extend(detected.into_iter().filter(|(is_there, _)| *is_there).map(|(_, kind)| Self(kind)));
        }
        all
    }

    /// The fastest that this processor can run.
    pub fn best() -> Self {
        Self::available().last().copied().unwrap_or(Self::PORTABLE)
    }

    /// How it is called.
    pub fn name(self) -> &'static str {
        match self.0 {
            Kind::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Kind::Sse41 => "sse4.1",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512 => "avx512",
        }
    }

    /// Runs a task.
    #[inline(always)]
    pub(crate) fn run<T: Task>(self, task: T) -> T::Output {
        match self.0 {
            Kind::Portable => task.run(portable::Portable),
            // SAFETY (all three): the value was made because the processor has what it takes.
            #[cfg(target_arch = "x86_64")]
            Kind::Sse41 => unsafe { x86::run_sse41(task) },
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2 => unsafe { x86::run_avx2(task) },
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512 => unsafe { x86::run_avx512(task) },
        }
    }
}
