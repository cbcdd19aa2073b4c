//! Filters against quadrature of their formulas, and the two strata against their masses.

use super::*;
use heliostat_scene::RenderSettings;

const ALL: [(Filter, f32); 6] = [
    (Filter::Box, 0.5),
    (Filter::Tent, 1.0),
    (Filter::Gaussian, 1.5),
    (Filter::Mitchell, 2.0),
    (Filter::BlackmanHarris, 1.5),
    (Filter::Lanczos, 3.0),
];

/// The integral of `g` times the filter over the integral of the filter, by Simpson's rule.
fn expected(filter: Filter, radius: f64, g: impl Fn(f64) -> f64) -> f64 {
    let n = 60_000;
    let at = |i: usize| radius * (2.0 * i as f64 / n as f64 - 1.0);
    let weight = |i: usize| if i == 0 || i == n { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
    let simpson = |h: &dyn Fn(f64) -> f64| (0..=n).map(|i| weight(i) * h(at(i))).sum::<f64>();
    simpson(&|x| value(filter, radius, x) * g(x)) / simpson(&|x| value(filter, radius, x))
}

/// The filter's answer to `g` over the picture, from `samples` samples of one pixel.
fn estimate(filter: &PixelFilter, samples: u32, g: impl Fn(DVec2) -> f64) -> f64 {
    let (a, b) = filter.masses();
    let mut sums = [(0.0, 0.0); 2];
    for sample in 0..samples {
        let at = filter.sample(&pattern(5), [100, 200], sample);
        let stratum = &mut sums[usize::from(at.is_negative)];
        *stratum = (stratum.0 + g(at.offset), stratum.1 + 1.0);
    }
    let mean = |(sum, count): (f64, f64)| if count == 0.0 { 0.0 } else { sum / count };
    a * mean(sums[0]) - b * mean(sums[1])
}

#[test]
fn values_are_those_of_the_papers() {
    // Mitchell and Netravali, B = C = 1/3: 8/9 in the middle, 1/18 at 1, 0 at 2.
    assert!((value(Filter::Mitchell, 2.0, 0.0) - 8.0 / 9.0).abs() < 1e-15);
    assert!((value(Filter::Mitchell, 2.0, 1.0) - 1.0 / 18.0).abs() < 1e-15);
    assert!(value(Filter::Mitchell, 2.0, 2.0).abs() < 1e-15);
    // The cubic pieces meet with equal value and slope at 1.
    let slope = |x: f64| (mitchell(x + 1e-7) - mitchell(x - 1e-7)) / 2e-7;
    assert!((mitchell(1.0 - 1e-12) - mitchell(1.0)).abs() < 1e-11);
    assert!((slope(1.0 - 1e-6) - slope(1.0 + 1e-6)).abs() < 1e-4);
    // The window of Harris: 1 in the middle, 6e-5 at the end.
    assert!((value(Filter::BlackmanHarris, 1.5, 0.0) - 1.0).abs() < 1e-15);
    assert!((value(Filter::BlackmanHarris, 1.5, 1.5) - 6e-5).abs() < 1e-15);
    // Lanczos interpolates: 1 at 0 and 0 at the other integers.
    assert_eq!(value(Filter::Lanczos, 3.0, 0.0), 1.0);
    assert!((1..=3).all(|i| value(Filter::Lanczos, 3.0, f64::from(i)).abs() < 1e-15));
    assert_eq!(value(Filter::Gaussian, 1.5, 1.5), 0.0);
    assert_eq!(value(Filter::Tent, 2.0, -0.5), 0.75);
    assert!(ALL.iter().all(|&(filter, r)| value(filter, f64::from(r), f64::from(r) + 0.01) == 0.0));
}

#[test]
fn a_constant_stays_itself_at_any_number_of_samples() {
    for (filter, radius) in ALL {
        for samples in [1, 2, 3, 4, 5, 16, 33] {
            let found = estimate(&PixelFilter::new(filter, radius, samples), samples, |_| 0.7);
            assert!((found - 0.7).abs() < 1e-14, "{filter:?}, {samples}: {found}");
        }
    }
}

#[test]
fn masses_are_the_integrals_of_the_parts() {
    for (filter, radius) in ALL {
        let (a, b) = PixelFilter::new(filter, radius, 16).masses();
        assert!((a - b - 1.0).abs() < 1e-12, "{filter:?}");
        let r = f64::from(radius);
        let n = expected(filter, r, |x| f64::from(u8::from(value(filter, r, x) < 0.0)));
        // n is minus the integral of the negative part along an axis; b = 2 p n with p = 1 + n.
        let want = 2.0 * (1.0 - n) * -n;
        assert!((b - want).abs() < 2e-5, "{filter:?}: {b} for {want}");
    }
}

#[test]
fn moments_are_those_of_the_formula() {
    let samples = 1 << 16;
    // Each lobe is a jump of the offset over u, and strata are no powers of two: the error of a net, 1 / n, is met
    // once per lobe and per power of two in n.
    let close = |a: f64, b: f64| (a - b).abs() < 64.0 / f64::from(samples);
    for (kind, radius) in ALL {
        for scale in [1.0, 1.7] {
            let r = radius * scale;
            let filter = PixelFilter::new(kind, r, samples);
            for frequency in [0.3, 1.1, 2.9] {
                let wave = |x: f64| (frequency * x).cos();
                let want = expected(kind, f64::from(r), wave);
                let along_x = estimate(&filter, samples, |p| wave(p.x));
                let along_y = estimate(&filter, samples, |p| wave(p.y));
                let both = estimate(&filter, samples, |p| wave(p.x) * wave(p.y));
                assert!(close(along_x, want), "{kind:?} {r} x: {along_x} for {want}");
                assert!(close(along_y, want), "{kind:?} {r} y: {along_y} for {want}");
                assert!(close(both, want * want), "{kind:?} {r}: {both} for {}", want * want);
                let odd = estimate(&filter, samples, |p| (frequency * p.x).sin());
                assert!(close(odd, 0.0), "{kind:?} {r}: {odd} for 0");
            }
        }
    }
}

#[test]
fn tables_follow_the_formula() {
    let n = 100_000;
    for (kind, radius) in ALL {
        for scale in [1.0, 1.7, 5.0] {
            let r = radius * scale;
            let filter = PixelFilter::new(kind, r, 16);
            // The mean over even steps of u is the integral over the density that the table stands for.
            let integral = |table: &Table, frequency: f64| {
                let u = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
                let sum: f64 = (0..n).map(|i| (frequency * table.sample(u(i))).cos()).sum();
                table.integral * sum / f64::from(n)
            };
            for frequency in [0.3, 1.1, 2.9] {
                let part = |frequency| {
                    let minus = filter.negative.as_ref().map_or(0.0, |table| integral(table, frequency));
                    integral(&filter.positive, frequency) - minus
                };
                let found = part(frequency) / part(0.0);
                let want = expected(kind, f64::from(r), |x| (frequency * x).cos());
                // The offset jumps over the other sign's lobes: the quadrature over u is good to lobes / n.
                assert!((found - want).abs() < 1e-4, "{kind:?} {r}: {found} for {want}");
            }
        }
    }
}

#[test]
fn tables_of_piecewise_linear_filters_are_exact() {
    let tent = PixelFilter::new(Filter::Tent, 1.0, 4);
    for i in 0..=100 {
        let u = f64::from(i) / 100.0;
        // The cumulative integral of the tent: (1 + x)^2 / 2 for x below 0, mirrored above.
        let x = tent.positive.sample(u);
        let back = if x < 0.0 { 0.5 * (1.0 + x).powi(2) } else { 1.0 - 0.5 * (1.0 - x).powi(2) };
        assert!((back - u).abs() < 1e-14, "{u}: {x}");
    }
    let flat = PixelFilter::new(Filter::Box, 0.5, 4);
    assert!((0..=64).all(|i| flat.positive.sample(f64::from(i) / 64.0) == f64::from(i) / 64.0 - 0.5));
}

#[test]
fn samples_stay_within_the_radius() {
    for (kind, radius) in ALL {
        let filter = PixelFilter::new(kind, radius, 64);
        let tables = std::iter::once(&filter.positive).chain(&filter.negative);
        for table in tables {
            for u in [0.0, f64::EPSILON, 0.25, 0.5, 1.0 - f64::EPSILON, 1.0] {
                let x = table.sample(u);
                assert!(x.abs() <= f64::from(radius), "{kind:?} at {u}: {x}");
            }
        }
    }
}

#[test]
fn one_sample_lies_on_the_centre_and_adds() {
    for (kind, radius) in ALL {
        let filter = PixelFilter::new(kind, radius, 1);
        let at = filter.sample(&pattern(9), [3, 4], 0);
        assert_eq!(at, FilmSample { offset: DVec2::ZERO, is_negative: false });
        assert_eq!(filter.masses(), (1.0, 0.0));
    }
}

#[test]
fn negative_samples_are_as_many_as_planned_and_evenly_spread() {
    for samples in [2, 3, 4, 16, 100, 1000] {
        let filter = PixelFilter::new(Filter::Lanczos, 3.0, samples);
        let (a, b) = filter.masses();
        let signs: Vec<bool> =
            (0..samples).map(|s| filter.sample(&pattern(0), [0, 0], s).is_negative).collect();
        let count = |signs: &[bool]| signs.iter().filter(|&&s| s).count() as f64;
        let share = b / (a + b);
        assert!((count(&signs) - share * f64::from(samples)).abs() <= 1.0);
        assert!(count(&signs) >= 1.0 && count(&signs) < f64::from(samples));
        // Any run of samples has its share, to within two samples.
        let planned = count(&signs) / f64::from(samples);
        for start in 0..signs.len() {
            let run = &signs[start..];
            assert!((count(run) - planned * run.len() as f64).abs() <= 1.0, "{samples} from {start}");
        }
    }
}

#[test]
fn a_straight_edge_through_a_pixel_is_stratified() {
    // Half of the box lies left of its centre: n samples of a net see n / 2 of them there.
    for samples in [4, 16, 64, 256] {
        let filter = PixelFilter::new(Filter::Box, 0.5, samples);
        let left = estimate(&filter, samples, |p| f64::from(u8::from(p.x < 0.0)));
        assert_eq!(left, 0.5);
        for edge in [-0.3, 0.1, 0.437] {
            let covered = estimate(&filter, samples, |p| f64::from(u8::from(p.x < edge)));
            assert!((covered - (0.5 + edge)).abs() <= 1.0 / f64::from(samples));
        }
    }
}

fn pattern(seed: u64) -> Pattern {
    Pattern::new(&RenderSettings { seed, ..RenderSettings::default() })
}
