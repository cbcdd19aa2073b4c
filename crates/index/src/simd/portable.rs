//! The lanes on plain arrays.

use super::{LANES, Lanes, Pending, Row, Stack};
use glam::Vec3A;
use heliostat_geometry::triangle;

/// Eight lanes on any processor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Portable {
    #[inline(always)]
    fn zip(a: [f32; LANES], b: [f32; LANES], f: impl Fn(f32, f32) -> f32) -> [f32; LANES] {
        std::array::from_fn(|i| f(a[i], b[i]))
    }

    #[inline(always)]
    fn bits(test: impl Fn(usize) -> bool) -> u32 {
        (0..LANES).fold(0, |bits, i| bits | u32::from(test(i)) << i)
    }
}

impl Lanes for Portable {
    type F = [f32; LANES];
    type Stack<'r> = Stack<'r, false>;

    #[inline(always)]
    fn splat(self, x: f32) -> Self::F {
        [x; LANES]
    }

    #[inline(always)]
    fn load(self, row: &Row) -> Self::F {
        row.0
    }

    #[inline(always)]
    fn sub(self, a: Self::F, b: Self::F) -> Self::F {
        Self::zip(a, b, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, a: Self::F, b: Self::F) -> Self::F {
        Self::zip(a, b, |a, b| a * b)
    }

    #[inline(always)]
    fn add(self, a: Self::F, b: Self::F) -> Self::F {
        Self::zip(a, b, |a, b| a + b)
    }

    #[inline(always)]
    fn div(self, a: Self::F, b: Self::F) -> Self::F {
        Self::zip(a, b, |a, b| a / b)
    }

    #[inline(always)]
    fn store(self, a: Self::F) -> Row {
        Row(a)
    }

    #[inline(always)]
    fn mul_sub(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F {
        std::array::from_fn(|i| a[i] * b[i] - c[i])
    }

    #[inline(always)]
    fn mul_add(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F {
        std::array::from_fn(|i| a[i] * b[i] + c[i])
    }

    #[inline(always)]
    fn min(self, a: Self::F, b: Self::F) -> Self::F {
        Self::zip(a, b, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn max(self, a: Self::F, b: Self::F) -> Self::F {
        Self::zip(a, b, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn sooner(self, a: Self::F, b: Self::F) -> Self::F {
        self.min(a, b)
    }

    #[inline(always)]
    fn later(self, a: Self::F, b: Self::F) -> Self::F {
        self.max(a, b)
    }

    #[inline(always)]
    fn larger_size(self, a: Self::F, b: Self::F) -> Self::F {
        Self::zip(a, b, |a, b| if a.abs() > b.abs() { a.abs() } else { b.abs() })
    }

    #[inline(always)]
    fn signed_by(self, a: Self::F, b: Self::F) -> Self::F {
        Self::zip(a, b, |a, b| if b.is_sign_negative() { -a } else { a })
    }

    #[inline(always)]
    fn lt(self, a: Self::F, b: Self::F) -> u32 {
        Self::bits(|i| a[i] < b[i])
    }

    #[inline(always)]
    fn any_zero(self, a: Self::F, b: Self::F, c: Self::F) -> u32 {
        Self::bits(|i| (a[i] == 0.0) | (b[i] == 0.0) | (c[i] == 0.0))
    }

    #[inline(always)]
    fn mixed_signs(self, a: Self::F, b: Self::F, c: Self::F) -> u32 {
        Self::bits(|i| {
            let negative = (a[i] < 0.0) | (b[i] < 0.0) | (c[i] < 0.0);
            let positive = (a[i] > 0.0) | (b[i] > 0.0) | (c[i] > 0.0);
            negative & positive
        })
    }

    #[inline(always)]
    fn turned(self, along: usize, v: Vec3A) -> Vec3A {
        triangle::turned(along, v)
    }

    #[inline(always)]
    fn enter(
        self,
        stack: &mut Self::Stack<'_>,
        near: Self::F,
        far: Self::F,
        children: &[u32; LANES],
        order: u32,
        forgets: bool,
    ) -> u32 {
        self.push_met(stack, near, far, children, order, forgets);
        stack.pop()
    }

    #[inline(always)]
    fn push_met(
        self,
        stack: &mut Stack<'_, false>,
        near: Self::F,
        far: Self::F,
        children: &[u32; LANES],
        order: u32,
        _forgets: bool,
    ) {
        for place in (0..LANES).rev() {
            let lane = (order >> (3 * place)) as usize % LANES;
            if near[lane] <= far[lane] {
                stack.push(children[lane], near[lane]);
            }
        }
    }
}
