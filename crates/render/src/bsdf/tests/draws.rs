//! Draws against their density: counts in bins, the sum of the density, and weights.

use super::*;
use crate::bsdf::BsdfSample;
use crate::bsdf::quadrature::gauss_legendre;
use crate::bsdf::standard::view::View;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Bins of the sphere: angles from the normal by turns.
const HEIGHTS: usize = 20;
const TURNS: usize = 20;
/// Draws of each test.
const DRAWS: u32 = 40_000;
/// Nodes of the integral of the density along either side of a piece of a bin.
const NODES: usize = 5;
/// How often pieces are parted into four, at least and at most.
const PARTS: [u32; 2] = [1, 7];
/// How far a piece may be from its four parts in sum.
const TOLERANCE: f64 = 2e-6;
/// Chance of a test to fail by itself, all of them together.
const SIGNIFICANCE: f64 = 1e-4;

/// What draws do, or should do: the share in each bin, and the share that has no density.
struct Shares {
    bins: Vec<f64>,
    rest: f64,
}

/// Counted, with numbers that do not know of each other.
fn counted(bsdf: &StandardBsdf, wo: Vec3, seed: u64) -> Shares {
    let mut shares = Shares { bins: vec![0.0; HEIGHTS * TURNS], rest: 0.0 };
    let mut state = seed;
    let mut next = move || {
        // SplitMix64.
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1_u64 << 24) as f32
    };
    for _ in 0..DRAWS {
        match bsdf.seen_from(wo).sample(Vec3::new(next(), next(), next())) {
            Some(sample) if !sample.is_delta() => {
                let height =
                    (sample.wi.z.clamp(-1.0, 1.0).acos() / std::f32::consts::PI * HEIGHTS as f32) as usize;
                let turn = (sample.wi.y.atan2(sample.wi.x) / TAU).rem_euclid(1.0) * TURNS as f32;
                let bin = height.min(HEIGHTS - 1) * TURNS + (turn as usize).min(TURNS - 1);
                shares.bins[bin] += 1.0 / f64::from(DRAWS);
            }
            _ => shares.rest += 1.0 / f64::from(DRAWS),
        }
    }
    shares
}

/// Integrated from the density.
fn expected(bsdf: &StandardBsdf, wo: Vec3) -> Shares {
    let view = bsdf.seen_from(wo);
    let share = |bin: usize| {
        let step = [PI / HEIGHTS as f64, 2.0 * PI / TURNS as f64];
        let piece =
            Piece { from: [(bin / TURNS) as f64 * step[0], (bin % TURNS) as f64 * step[1]], size: step };
        piece.refined(&view, piece.sum(&view), 0)
    };
    let bins: Vec<f64> = (0..HEIGHTS * TURNS).map(share).collect();
    let rest = 1.0 - bins.iter().sum::<f64>();
    Shares { bins, rest }
}

/// A rectangle of angles from the normal and around it.
#[derive(Clone, Copy)]
struct Piece {
    from: [f64; 2],
    size: [f64; 2],
}

impl Piece {
    /// The integral of the density by one rule.
    fn sum(&self, view: &View<'_>) -> f64 {
        let nodes = gauss_legendre::<NODES>();
        let mut sum = 0.0;
        for (x, across) in nodes {
            let angle = self.from[0] + self.size[0] * f64::from(x);
            for (y, along) in nodes {
                let turn = self.from[1] + self.size[1] * f64::from(y);
                let wi = (angle.sin() as f32 * Vec2::from_angle(turn as f32)).extend(angle.cos() as f32);
                sum += f64::from(across * along * view.answer(wi).1) * angle.sin();
            }
        }
        sum * self.size[0] * self.size[1]
    }

    /// The same by parts, until they do not tell more.
    fn refined(&self, view: &View<'_>, whole: f64, depth: u32) -> f64 {
        let size = self.size.map(|side| 0.5 * side);
        let part = |k: usize| {
            let at = [(k % 2) as f64 * size[0], (k / 2) as f64 * size[1]];
            let part = Self { from: [self.from[0] + at[0], self.from[1] + at[1]], size };
            (part, part.sum(view))
        };
        let parts = [0, 1, 2, 3].map(part);
        let sum: f64 = parts.iter().map(|(_, sum)| sum).sum();
        let is_known = depth >= PARTS[0] && (sum - whole).abs() < TOLERANCE;
        if is_known || depth == PARTS[1] {
            return sum;
        }
        parts.iter().map(|(part, sum)| part.refined(view, *sum, depth + 1)).sum()
    }
}

/// Chance to deviate at least so far, for this many degrees of freedom: Wilson and Hilferty's approximation, 1931.
fn chance(chi_square: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    let normal = ((chi_square / freedom).cbrt() - (1.0 - spread)) / spread.sqrt();
    // The tail of the normal distribution, by Mills' ratio where it is thin: Abramowitz and Stegun, 26.2.17.
    let t = 1.0 / (1.0 + 0.231_641_9 * normal.abs());
    let poly = t
        * (0.319_381_530
            + t * (-0.356_563_782 + t * (1.781_477_937 + t * (-1.821_255_978 + t * 1.330_274_429))));
    let tail = poly * (-0.5 * normal * normal).exp() / (2.0 * PI).sqrt();
    if normal > 0.0 { tail } else { 1.0 - tail }
}

/// Chance of the counts, where bins that expect less than five are put together.
fn chance_of(counted: &Shares, expected: &Shares) -> f64 {
    let n = f64::from(DRAWS);
    let mut pairs: Vec<(f64, f64)> = expected
        .bins
        .iter()
        .copied()
        .zip(counted.bins.iter().copied())
        .map(|(e, c)| (n * e, n * c))
        .collect();
    pairs.push((n * expected.rest.max(0.0), n * counted.rest));
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut sum, mut bins, mut pool) = (0.0, 0.0, (0.0, 0.0));
    for (e, c) in pairs {
        pool = (pool.0 + e, pool.1 + c);
        if pool.0 >= 5.0 {
            sum += (pool.1 - pool.0) * (pool.1 - pool.0) / pool.0;
            bins += 1.0;
            pool = (0.0, 0.0);
        }
    }
    if bins < 2.0 { 1.0 } else { chance(sum, bins - 1.0) }
}

/// Surfaces and viewers to test: bodies from inside too.
fn cases() -> Vec<(String, StandardBsdf, f32)> {
    let mut cases = Vec::new();
    for (name, change) in LOSSLESS {
        let places = [(1.0, 0.2), (0.4, 0.6), (0.2, 0.9), (1.0, 0.9), (0.4, 0.1), (0.2, 0.3)];
        for (roughness, cos) in places.into_iter().take(fewer(6, 2)) {
            let point = rough(*change, roughness);
            let is_body = point.transmission > 0.0 && !point.thin_walled;
            for is_outside in [true, false].into_iter().filter(|outside| *outside || is_body) {
                let bsdf = StandardBsdf::new(&point, is_outside, Vec3::new(0.28, 0.0, 0.96));
                cases.push((format!("{name}, {roughness}, {cos}, {is_outside}"), bsdf, cos));
            }
        }
    }
    cases
}

#[test]
fn bsdf_draws_follow_their_density() {
    let cases = cases();
    // Sidak's share of the chance for each test.
    let level = 1.0 - (1.0 - SIGNIFICANCE).powf(1.0 / cases.len() as f64);
    cases.par_iter().enumerate().for_each(|(seed, (name, bsdf, cos))| {
        let (counted, expected) = (counted(bsdf, viewer(*cos), seed as u64), expected(bsdf, viewer(*cos)));
        let (chance, gap) = (chance_of(&counted, &expected), counted.rest - expected.rest);
        assert!(chance > level, "{name}: chance {chance:e}, rest {gap}");
        assert!(gap.abs() < 0.01, "{name}: density and draws without one add up to 1 less {gap}");
    });
}

#[test]
fn bsdf_weight_is_value_over_density() {
    let mut worst = 0.0_f32;
    for (name, change) in LOSSLESS {
        for roughness in ROUGHNESS {
            let bsdf = outside(&rough(*change, roughness));
            for (u, cos) in lattice(256).zip(COSINES.into_iter().cycle()) {
                let wo = viewer(cos);
                let Some(sample) = bsdf.seen_from(wo).sample(u).filter(|sample| !sample.is_delta()) else {
                    continue;
                };
                assert_eq!(sample.pdf, bsdf.seen_from(wo).answer(sample.wi).1, "{name} {roughness}");
                let error =
                    (sample.weight * sample.pdf - bsdf.seen_from(wo).answer(sample.wi).0).abs().max_element();
                worst = worst.max(error / (sample.weight.max_element() * sample.pdf).max(f32::MIN_POSITIVE));
            }
        }
    }
    assert!(worst < 1e-6, "{worst}");
}

/// Light that glass has parted already stays with its colour, and what all draws carry on is the same.
#[test]
fn colours_are_parted_by_what_is_carried() {
    const COUNT: u32 = 1 << 14;
    let glass = outside(&rough(|p| (p.transmission, p.dispersion) = (1.0, 2.0), 0.0));
    let wo = viewer(0.6);
    let view = glass.seen_from(wo);
    let mean = |carried: Rgb| {
        let carry = |sample: BsdfSample| carried * sample.weight;
        let drawn = lattice(COUNT).map(|u| view.sample_for(carried, u).map_or(Rgb::ZERO, carry));
        drawn.sum::<Rgb>() / COUNT as f32
    };
    let even = mean(Rgb::ONE);
    for carried in [Rgb::X, Rgb::Y, Rgb::Z, Rgb::new(0.7, 0.0, 0.2), Rgb::new(3.0, 0.1, 0.5)] {
        let error = (mean(carried) - carried * even).abs();
        assert!(error.cmple(Rgb::splat(0.01 * carried.max_element())).all(), "{carried}: {error}");
        let lost = lattice(COUNT).filter(|&u| {
            view.sample_for(carried, u).is_none_or(|sample| (carried * sample.weight).max_element() == 0.0)
        });
        assert_eq!(lost.count(), 0, "{carried}");
    }
}
