//! Roots by isolation: where a cubic or quartic turns, and the one root between two turns.
//!
//! Closed formulas for quartics lose half of the digits where roots lie close together, at every silhouette. Between
//! two turning points there is at most one root, its signs at the ends tell whether, and a bracketed iteration
//! cannot miss it.

use crate::error_bound::gamma_f64;
use std::f64::consts::TAU;

/// The real roots of `t^3 + p t + q`, rising; unused places are infinite.
///
/// # Source
/// Viète's trigonometric and Cardano's formula; the latter in the form that adds no opposite numbers before the root
/// (Press et al., "Numerical Recipes", 5.6).
pub(super) fn depressed_cubic(p: f64, q: f64) -> [f64; 3] {
    let (third, half) = (p / 3.0, q / 2.0);
    let discriminant = half * half + third * third * third;
    if discriminant >= 0.0 {
        let large = -(half.abs() + discriminant.sqrt()).cbrt().copysign(half);
        let small = if large == 0.0 { 0.0 } else { -third / large };
        return [large + small, f64::INFINITY, f64::INFINITY];
    }
    let radius = (-third).sqrt();
    let angle = (-half / (radius * radius * radius)).clamp(-1.0, 1.0).acos() / 3.0;
    let root = |turn: f64| 2.0 * radius * (angle + turn * TAU / 3.0).cos();
    [root(1.0), root(-1.0), root(0.0)]
}

/// The root of `f` between `low` and `high`, where `f` rises or falls through 0; `f` gives value and slope.
///
/// Newton's iteration, replaced by halving wherever it would leave the bracket or is slow. The signs at the two
/// ends are taken on trust, so an end that is itself the root may have either.
pub(super) fn bracketed_root(low: f64, high: f64, rises: bool, f: impl Fn(f64) -> (f64, f64)) -> f64 {
    let (mut low, mut high) = (low, high);
    let enough = gamma_f64(2) * low.abs().max(high.abs());
    let mut t = 0.5 * (low + high);
    let mut last_step = high - low;
    // Every second round at least halves the bracket, so twice the bits of the mantissa suffice.
    for _ in 0..2 * f64::MANTISSA_DIGITS {
        let (value, slope) = f(t);
        if (value < 0.0) == rises {
            low = t;
        } else {
            high = t;
        }
        let newton = t - value / slope;
        let is_fast = (newton - t).abs() <= 0.5 * last_step;
        let next = if low <= newton && newton <= high && is_fast { newton } else { 0.5 * (low + high) };
        last_step = (next - t).abs();
        t = next;
        if last_step <= enough {
            break;
        }
    }
    t
}
