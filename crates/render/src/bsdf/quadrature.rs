//! Sums that stand for integrals, where a table is made.

use std::f64::consts::PI;

/// Nodes in `(0, 1)` and weights, which add up to 1, that integrate polynomials up to degree `2 N - 1` exactly.
///
/// # Source
/// Press et al., "Numerical Recipes", 3rd edition, section 4.6.
pub(super) fn gauss_legendre<const N: usize>() -> [(f32, f32); N] {
    std::array::from_fn(|i| {
        let mut x = (PI * (i as f64 + 0.75) / (N as f64 + 0.5)).cos();
        let mut slope = 1.0;
        // Newton's steps double the digits, and the first guess has two of them.
        for _ in 0..6 {
            let (value, derivative) = legendre(N, x);
            slope = derivative;
            x -= value / derivative;
        }
        ((0.5 - 0.5 * x) as f32, (1.0 / ((1.0 - x * x) * slope * slope)) as f32)
    })
}

/// The Legendre polynomial of a degree, and its derivative.
fn legendre(degree: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..degree {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0));
    }
    (value, degree as f64 * (x * value - before) / (x * x - 1.0))
}
