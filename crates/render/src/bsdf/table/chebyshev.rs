//! Smooth functions on `[0, 1]` by their values at Chebyshev's nodes.
//!
//! A polynomial through a dozen of them is as good as thousands of nodes with lines between.
//!
//! # Source
//! Trefethen, "Approximation Theory and Approximation Practice", 2013, chapters 2 to 5 (nodes of the first kind, series,
//! barycentric formula); Clenshaw, "A Note on the Summation of Chebyshev Series", 1955.

use std::f64::consts::PI;
use std::ops::{Add, Mul, Sub};

/// What can be interpolated.
pub(crate) trait Value:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<f32, Output = Self>
{
}

impl<V: Copy + Default + Add<Output = V> + Sub<Output = V> + Mul<f32, Output = V>> Value for V {}

/// The nodes, in rising order.
pub(crate) const fn nodes<const N: usize>() -> [f32; N] {
    let mut nodes = [0.0; N];
    let mut k = 0;
    while k < N {
        nodes[k] = (0.5 - 0.5 * cosine(PI * (k as f64 + 0.5) / N as f64)) as f32;
        k += 1;
    }
    nodes
}

/// Weights of the values at the nodes that add up to the polynomial at `x` in `[0, 1]`.
pub(crate) fn weights<const N: usize>(x: f32) -> [f32; N] {
    let nodes = const { nodes::<N>() };
    if let Some(k) = nodes.iter().position(|node| *node == x) {
        return std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
    }
    let sines = const { sines::<N>() };
    let parts: [f32; N] = std::array::from_fn(|k| sines[k] / (x - nodes[k]));
    let scale = 1.0 / parts.iter().sum::<f32>();
    parts.map(|part| part * scale)
}

/// Coefficients of the series of Chebyshev's polynomials with these values at the nodes.
pub(crate) fn series<const N: usize, V: Value>(values: &[V; N]) -> [V; N] {
    let matrix = const { matrix::<N>() };
    std::array::from_fn(|j| {
        let mut sum = V::default();
        for (value, factor) in values.iter().zip(&matrix[j]) {
            sum = sum + *value * *factor;
        }
        sum
    })
}

/// The sum of a series at `x` in `[0, 1]`.
#[inline]
pub(crate) fn sum<V: Value>(series: &[V], x: f32) -> V {
    let twice = 4.0 * x - 2.0;
    let (mut next, mut after) = (V::default(), V::default());
    for coefficient in series[1..].iter().rev() {
        (next, after) = (*coefficient + next * twice - after, next);
    }
    series[0] + next * (0.5 * twice) - after
}

/// The sums of a series at many places at once.
pub(crate) fn sums<const N: usize>(series: &[f32], x: &[f32; N]) -> [f32; N] {
    let (mut next, mut after) = ([0.0; N], [0.0; N]);
    for coefficient in series[1..].iter().rev() {
        for ((next, after), x) in next.iter_mut().zip(&mut after).zip(x) {
            (*next, *after) = (*coefficient + *next * (4.0 * x - 2.0) - *after, *next);
        }
    }
    std::array::from_fn(|k| series[0] + next[k] * (2.0 * x[k] - 1.0) - after[k])
}

/// Weights of values at the nodes that add up to the mean over a hemisphere, weighted by the cosine, of what depends on that
/// cosine: `w_k = int_0^1 2 x l_k(x) dx`.
pub(crate) const fn cosine_weights<const N: usize>() -> [f32; N] {
    let mut weights = [0.0; N];
    let mut k = 0;
    while k < N {
        let mut sum = 0.0;
        let mut j = 0;
        while j < N {
            // `1/2 int (t + 1) T_j(t) dt` from -1 to 1.
            let around = if j == 0 { integral(1) } else { 0.5 * (integral(j + 1) + integral(j - 1)) };
            sum += factor::<N>(j, k) * 0.5 * (integral(j) + around);
            j += 1;
        }
        weights[k] = sum as f32;
        k += 1;
    }
    weights
}

/// The integral of Chebyshev's polynomial from -1 to 1.
const fn integral(degree: usize) -> f64 {
    if degree & 1 == 0 { 2.0 / (1.0 - (degree * degree) as f64) } else { 0.0 }
}

/// What the value at node `k` adds to coefficient `j`.
const fn factor<const N: usize>(j: usize, k: usize) -> f64 {
    let sign = if j & 1 == 0 { 1.0 } else { -1.0 };
    let share = if j == 0 { 1.0 } else { 2.0 };
    sign * share * cosine(PI * j as f64 * (k as f64 + 0.5) / N as f64) / N as f64
}

const fn matrix<const N: usize>() -> [[f32; N]; N] {
    let mut matrix = [[0.0; N]; N];
    let mut at = 0;
    while at < N * N {
        matrix[at / N][at % N] = factor::<N>(at / N, at % N) as f32;
        at += 1;
    }
    matrix
}

/// Sines of the angles of the nodes, with alternating signs.
const fn sines<const N: usize>() -> [f32; N] {
    let mut sines = [0.0; N];
    let mut k = 0;
    while k < N {
        let sign = if k & 1 == 0 { 1.0 } else { -1.0 };
        sines[k] = (sign * cosine(PI * (k as f64 + 0.5) / N as f64 - 0.5 * PI)) as f32;
        k += 1;
    }
    sines
}

/// The cosine of an angle that is not below `-pi / 2`, where a program is compiled.
const fn cosine(angle: f64) -> f64 {
    let mut angle = angle;
    while angle > PI {
        angle -= 2.0 * PI;
    }
    let (mut sum, mut term, mut k) = (1.0, 1.0, 1);
    while k < 16 {
        term *= -angle * angle / ((2 * k - 1) * 2 * k) as f64;
        sum += term;
        k += 1;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial of degree 7.
    fn polynomial(x: f32) -> f32 {
        let t = f64::from(x);
        (1.0 - t * (3.0 - t * (2.0 + t * (0.5 - t * t * (1.0 - 2.0 * t * t))))) as f32
    }

    #[test]
    fn bsdf_series_is_its_polynomial() {
        let values = nodes::<8>().map(polynomial);
        let series = series(&values);
        for k in 0..=40 {
            let x = k as f32 / 40.0;
            let by_weights: f32 = weights::<8>(x).iter().zip(values).map(|(w, v)| w * v).sum();
            assert!((sum(&series, x) - polynomial(x)).abs() < 4e-6, "{x}");
            assert!((by_weights - polynomial(x)).abs() < 4e-6, "{x}");
            assert!((sums(&series, &[0.5, x])[1] - polynomial(x)).abs() < 4e-6, "{x}");
        }
        assert_eq!(weights::<8>(nodes::<8>()[3])[3], 1.0);
    }

    #[test]
    fn bsdf_cosine_weights_integrate() {
        // Twice the integral of x^6 is 2 / 7.
        let mean: f32 = cosine_weights::<8>().iter().zip(nodes::<8>()).map(|(w, x)| w * x.powi(5)).sum();
        assert!((mean - 2.0 / 7.0).abs() < 1e-6, "{mean}");
    }
}
