//! Values between keys.

/// Keys of one number: times that grow, a value each, and the slopes there.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Curve {
    /// Straight lines.
    Linear,
    /// Cubic Hermite pieces with these slopes at the keys.
    Smooth(Vec<f64>),
}

/// Slopes of a monotone cubic: within each piece the curve stays between its two keys; at local extremes, at the
/// first and at the last key it is at rest, so that it joins the constant values outside without a kink.
///
/// # Source
/// Fritsch and Butland, "A Method for Constructing Local Monotone Piecewise Cubic Interpolants", SIAM J. Sci. Stat.
/// Comput. 1984, equation 5 (weighted harmonic mean of the two secants).
pub(super) fn monotone_slopes(times: &[f64], values: &[f64]) -> Vec<f64> {
    let secant = |i: usize| (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
    let mut slopes = vec![0.0; times.len()];
    for i in 1..times.len().saturating_sub(1) {
        let (before, after) = (secant(i - 1), secant(i));
        // A change of direction is an extreme: rest there.
        if before * after <= 0.0 {
            continue;
        }
        let (h0, h1) = (times[i] - times[i - 1], times[i + 1] - times[i]);
        let (w0, w1) = (h0 + 2.0 * h1, 2.0 * h0 + h1);
        slopes[i] = (w0 + w1) / (w0 / before + w1 / after);
    }
    slopes
}

impl Curve {
    /// The value at `time`, which lies between keys `i` and `i + 1`.
    pub(super) fn between(&self, times: &[f64], values: &[f64], i: usize, time: f64) -> f64 {
        let (t0, t1, v0, v1) = (times[i], times[i + 1], values[i], values[i + 1]);
        let s = (time - t0) / (t1 - t0);
        match self {
            // Exact at both ends, and monotone.
            Self::Linear => v0 * (1.0 - s) + v1 * s,
            Self::Smooth(slopes) => {
                let h = t1 - t0;
                let (m0, m1) = (slopes[i] * h, slopes[i + 1] * h);
                let rest = 1.0 - s;
                // Cubic Hermite basis, written so that equal keys give their value exactly.
                v0 + (v1 - v0) * s * s * (3.0 - 2.0 * s) + m0 * s * rest * rest - m1 * s * s * rest
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn smooth(times: &[f64], values: &[f64]) -> impl Fn(f64) -> f64 {
        let curve = Curve::Smooth(monotone_slopes(times, values));
        let (times, values) = (times.to_vec(), values.to_vec());
        move |time| {
            let i = times.partition_point(|&t| t <= time).clamp(1, times.len() - 1) - 1;
            curve.between(&times, &values, i, time)
        }
    }

    #[test]
    fn two_keys_ease_in_and_out_as_smoothstep() {
        let at = smooth(&[2.0, 6.0], &[10.0, 30.0]);
        for i in 0..=8 {
            let s = f64::from(i) / 8.0;
            let expected = 10.0 + 20.0 * s * s * (3.0 - 2.0 * s);
            assert!((at(2.0 + 4.0 * s) - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn even_keys_on_a_line_are_passed_at_full_speed() {
        // The harmonic mean of two equal secants is that secant.
        let slopes = monotone_slopes(&[0.0, 1.0, 2.0, 5.0], &[0.0, 3.0, 6.0, 15.0]);
        assert_eq!(slopes[0], 0.0);
        assert!((slopes[1] - 3.0).abs() < 1e-12 && (slopes[2] - 3.0).abs() < 1e-12);
        assert_eq!(slopes[3], 0.0);
    }

    #[test]
    fn uneven_secants_give_the_weighted_harmonic_mean() {
        // Secants 1 (over 1 s) and 4 (over 2 s): weights 1 + 4 = 5 and 2 + 2 = 4: 9 / (5/1 + 4/4) = 1.5.
        let slopes = monotone_slopes(&[0.0, 1.0, 3.0], &[0.0, 1.0, 9.0]);
        assert!((slopes[1] - 1.5).abs() < 1e-12);
    }

    #[test]
    fn the_curve_has_no_kink_and_no_overshoot() {
        let times = [0.0, 0.3, 1.0, 1.1, 4.0];
        let values = [0.0, 5.0, 5.0, -2.0, 1.0];
        let at = smooth(&times, &values);
        let h = 1e-6;
        for (i, pair) in times.windows(2).enumerate() {
            let (low, high) = (values[i].min(values[i + 1]), values[i].max(values[i + 1]));
            for step in 0..=100 {
                let v = at(pair[0] + (pair[1] - pair[0]) * f64::from(step) / 100.0);
                assert!(v >= low - 1e-12 && v <= high + 1e-12, "{v} outside [{low}, {high}]");
            }
        }
        for &key in &times[1..times.len() - 1] {
            let (left, right) = ((at(key) - at(key - h)) / h, (at(key + h) - at(key)) / h);
            assert!((left - right).abs() < 1e-2, "kink at {key}: {left} {right}");
        }
        assert!((at(times[0] + h) - at(times[0])).abs() / h < 1e-3, "starts at rest");
    }
}
