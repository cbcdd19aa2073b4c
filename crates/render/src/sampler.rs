//! Random numbers as pure functions of (seed, pixel, sample, branch, dimension).
//!
//! Each draw is one point of a two-dimensional Sobol sequence, shuffled and Owen-scrambled by a hash of everything but
//! the sample index. So the samples of one pixel are stratified among themselves in every draw, whatever the number of
//! samples; different draws, branches and pixels have nothing to do with each other. There is no state to seed,
//! store or share: sample 5 of a pixel is the same on every thread, in every tile, in every pass.
//!
//! # Source
//! Burley, "Practical Hash-based Owen Scrambling", JCGT 2020 (shuffled padding); Vegdahl, "Building a Better LK Hash",
//! 2021 (the scramble, from the crate `sobol_burley`); Ahmed, "An Implementation Algorithm of 2D Sobol Sequence Fast,
//! Elegant, and Compact", EGSR 2024 (the second dimension without a table, over the full 32 bits).

use glam::Vec2;
use sobol_burley::parts::{hash, owen_scramble_rev};

/// Odd constant of the golden ratio: spreads consecutive integers over 64 bits.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The first branches of every sample: what the film and the camera draw never moves what the integrator draws.
pub(crate) mod branch {
    /// Place of a sample that adds to its pixel.
    pub(crate) const POSITIVE: u32 = 0;
    /// Place of a sample that subtracts.
    pub(crate) const NEGATIVE: u32 = 1;
    /// Lens and time.
    pub(crate) const CAMERA: u32 = 2;
    /// Everything that happens to the ray.
    pub(crate) const INTEGRATOR: u32 = 3;
}

/// The random numbers of one sample of one pixel, in one branch of its recursion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampler {
    /// Hash of seed, pixel and the branches on the way here; the same for all samples of the pixel.
    key: u64,
    /// Index of the sample within the pixel.
    sample: u32,
    /// Draws taken so far.
    dimension: u32,
}

impl Sampler {
    /// The numbers of sample `sample` of the pixel at column `pixel[0]`, row `pixel[1]` of the whole picture.
    pub fn new(seed: u64, pixel: [u32; 2], sample: u32) -> Self {
        let place = u64::from(pixel[0]) << 32 | u64::from(pixel[1]);
        Self { key: mix(mix(seed ^ GOLDEN) ^ place), sample, dimension: 0 }
    }

    /// Index of the sample within the pixel.
    pub fn sample(&self) -> u32 {
        self.sample
    }

    /// A number in `[0, 1)`; stratified over the samples of the pixel.
    pub fn next_1d(&mut self) -> f32 {
        self.next_2d().x
    }

    /// A point of the unit square `[0, 1)²`; stratified over the samples of the pixel.
    pub fn next_2d(&mut self) -> Vec2 {
        let scramble = self.next_scramble();
        scramble.point(scramble.shuffled(self.sample))
    }

    /// `n` points of the unit square for the current point of the scene.
    ///
    /// They are points `s n .. (s + 1) n` of one sequence for sample `s`: stratified among themselves, and the union over
    /// the samples of the pixel is stratified too. Best when `n` is a power of two. The sequence repeats after
    /// 2³² points.
    pub fn array_2d(&mut self, n: u32) -> Points {
        let first = self.sample.wrapping_mul(n);
        // Points of one block are used together: only the order of whole blocks needs a shuffle.
        let within = if n.is_power_of_two() { n - 1 } else { 0 };
        Points { scramble: self.next_scramble(), within, next: first, left: n }
    }

    /// The numbers of a branch of the recursion, independent of those of other branches and of this one.
    ///
    /// What a branch draws does not move the numbers of its siblings; a branch reached by the same numbers from
    /// the camera stays stratified over the samples of the pixel. Draws taken so far do not matter.
    #[must_use]
    pub fn fork(&self, branch: u32) -> Self {
        // The constant keeps forks apart from draws, which step the key by multiples of GOLDEN.
        let key = mix(self.key.rotate_left(32) ^ mix(u64::from(branch) ^ 0xd1b5_4a32_d192_ed03));
        Self { key, sample: self.sample, dimension: 0 }
    }

    /// The sequence of the next draw.
    fn next_scramble(&mut self) -> Scramble {
        self.dimension += 1;
        let bits = mix(self.key.wrapping_add(GOLDEN.wrapping_mul(u64::from(self.dimension))));
        let (order, x) = (bits as u32, (bits >> 32) as u32);
        Scramble { order, x, y: hash(x) }
    }
}

/// Consecutive points of one sequence; see [`Sampler::array_2d`].
#[derive(Clone, Debug)]
pub struct Points {
    scramble: Scramble,
    /// Bits of an index that are not shuffled.
    within: u32,
    next: u32,
    left: u32,
}

impl Points {
    /// The next points, as many as `x` and `y` hold, and how many of them still belong to the set.
    ///
    /// All lanes are worked out alike, so that the compiler can do several at once.
    #[inline(always)]
    pub fn next_lanes<const N: usize>(&mut self, x: &mut [f32; N], y: &mut [f32; N]) -> usize {
        let mut indices = [0; N];
        if self.within as usize + 1 >= N && N.is_power_of_two() {
            let first = self.index(self.next);
            (0_u32..).zip(&mut indices).for_each(|(i, index)| *index = first | i);
        } else {
            (0_u32..).zip(&mut indices).for_each(|(i, index)| *index = self.index(self.next.wrapping_add(i)));
        }
        for i in 0..N {
            let point = self.scramble.point(indices[i]);
            (x[i], y[i]) = (point.x, point.y);
        }
        let count = N.min(self.left as usize);
        self.next = self.next.wrapping_add(count as u32);
        self.left -= count as u32;
        count
    }

    /// The place in the sequence of point `i` of the set.
    #[inline(always)]
    fn index(&self, i: u32) -> u32 {
        self.scramble.shuffled(i & !self.within) & !self.within | i & self.within
    }
}

impl Iterator for Points {
    type Item = Vec2;

    #[inline]
    fn next(&mut self) -> Option<Vec2> {
        self.left = self.left.checked_sub(1)?;
        let point = self.scramble.point(self.index(self.next));
        self.next = self.next.wrapping_add(1);
        Some(point)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.left as usize, Some(self.left as usize))
    }
}

impl ExactSizeIterator for Points {}

/// One shuffled and scrambled Sobol sequence.
#[derive(Clone, Copy, Debug)]
struct Scramble {
    order: u32,
    x: u32,
    y: u32,
}

impl Scramble {
    /// The place of index `i` after a shuffle in which blocks of 2^k indices stay blocks, so that every such block of samples
    /// is a (0, k, 2)-net.
    #[inline(always)]
    fn shuffled(self, i: u32) -> u32 {
        owen_scramble_rev(i.reverse_bits(), self.order).reverse_bits()
    }

    /// Point `index` of the sequence.
    #[inline(always)]
    fn point(self, index: u32) -> Vec2 {
        // Scramble: the bits of a Sobol coordinate, reversed, are those of the index times a matrix.
        let x = owen_scramble_rev(index, self.x).reverse_bits();
        let y = owen_scramble_rev(pascal(index), self.y).reverse_bits();
        Vec2::new(to_unit(x), to_unit(y))
    }
}

/// The index times Pascal's triangle modulo 2, the generator of the second Sobol dimension.
///
/// # Source
/// By Lucas' theorem entry (i, j) is 1 where the bits of i are among those of j, so the product is a sum over supersets:
/// five steps of exclusive or instead of one per bit.
#[inline]
fn pascal(index: u32) -> u32 {
    let index = index ^ (index >> 1 & 0x5555_5555);
    let index = index ^ (index >> 2 & 0x3333_3333);
    let index = index ^ (index >> 4 & 0x0f0f_0f0f);
    let index = index ^ (index >> 8 & 0x00ff_00ff);
    index ^ index >> 16
}

/// The upper 24 bits as a number in `[0, 1)`, exactly.
#[inline]
fn to_unit(bits: u32) -> f32 {
    const SCALE: f32 = 1.0 / (1u32 << 24) as f32;
    (bits >> 8) as f32 * SCALE
}

/// A bijection of 64 bits in which every input bit flips half of the output bits.
///
/// # Source
/// Stafford's variant 13, as in `SplitMix64` (Steele, Lea, Flood, OOPSLA 2014).
#[inline]
fn mix(mut bits: u64) -> u64 {
    bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ bits >> 31
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Asserts that every elementary interval of volume 1 / 2^k holds exactly one of the 2^k points.
    fn assert_net(points: &[Vec2]) {
        let k = points.len().trailing_zeros();
        assert_eq!(points.len(), 1 << k);
        for columns in 0..=k {
            let mut seen = vec![0; points.len()];
            for p in points {
                let x = (p.x * (1u32 << columns) as f32) as usize;
                let y = (p.y * (1u32 << (k - columns)) as f32) as usize;
                seen[(y << columns) + x] += 1;
            }
            assert!(seen.iter().all(|&n| n == 1), "2^{columns} columns of {} points: {seen:?}", points.len());
        }
    }

    #[test]
    fn pascal_is_the_second_sobol_dimension() {
        for index in (0..1 << 16).step_by(7) {
            let from_table = sobol_burley::parts::sobol_rev(u32::reverse_bits(index), 1);
            assert_eq!(pascal(index), from_table);
        }
    }

    #[test]
    fn every_power_of_two_of_samples_is_a_net() {
        for pixel in [[0, 0], [1, 0], [0, 1], [1919, 1079], [u32::MAX, 3]] {
            for draw in 0..4 {
                let point = |sample| {
                    let mut sampler = Sampler::new(7, pixel, sample).fork(2).fork(0);
                    (0..=draw).map(|_| sampler.next_2d()).last().unwrap()
                };
                for block in [0..1, 0..16, 16..32, 0..256] {
                    assert_net(&block.map(point).collect::<Vec<_>>());
                }
            }
        }
    }

    #[test]
    fn arrays_are_nets_and_so_is_their_union() {
        let array = |sample| Sampler::new(1, [30, 40], sample).array_2d(16).collect::<Vec<_>>();
        for sample in 0..16 {
            assert_net(&array(sample));
        }
        assert_net(&(0..16).flat_map(array).collect::<Vec<_>>());
    }

    #[test]
    fn an_array_of_one_is_a_single_draw() {
        for sample in 0..32 {
            let mut single = Sampler::new(1, [3, 4], sample);
            let mut array = single;
            assert_eq!(array.array_2d(1).collect::<Vec<_>>(), [single.next_2d()]);
        }
    }

    #[test]
    fn numbers_stay_inside_the_unit_square() {
        assert_eq!(to_unit(0), 0.0);
        assert!(to_unit(u32::MAX) < 1.0);
    }

    #[test]
    fn draws_branches_and_pixels_are_uncorrelated() {
        // With n independent pairs the correlation has deviation 1 / sqrt(n); 5 deviations are asked for.
        let n = 4096;
        type Pairs<'a> = &'a dyn Fn(u32) -> (f32, f32);
        let correlation = |pair: Pairs<'_>| {
            let sum: f64 = (0..n).map(pair).map(|(a, b)| (f64::from(a) - 0.5) * (f64::from(b) - 0.5)).sum();
            12.0 * sum / f64::from(n)
        };
        let limit = 5.0 / f64::from(n).sqrt();
        let at = |x, y| Sampler::new(0, [x, y], 0);
        let pairs: [(&str, Pairs<'_>); 6] = [
            ("neighbours in x", &|i| (at(i, 0).next_1d(), at(i + 1, 0).next_1d())),
            ("neighbours in y", &|i| (at(0, i).next_1d(), at(0, i + 1).next_1d())),
            ("x and y of a draw", &|i| at(i, 9).next_2d().into()),
            ("two draws", &|i| {
                let mut sampler = at(i, 9);
                (sampler.next_1d(), sampler.next_1d())
            }),
            ("two branches", &|i| (at(i, 9).fork(0).next_1d(), at(i, 9).fork(1).next_1d())),
            ("parent and branch", &|i| (at(i, 9).next_1d(), at(i, 9).fork(0).next_1d())),
        ];
        for (name, pair) in pairs {
            let found = correlation(pair);
            assert!(found.abs() < limit, "{name}: {found}");
        }
    }

    #[test]
    fn two_draws_of_the_samples_of_a_pixel_are_uncorrelated() {
        let n = 1024;
        let sum: f64 = (0..n)
            .map(|sample| {
                let mut sampler = Sampler::new(0, [5, 6], sample);
                let (a, b) = (sampler.next_1d(), sampler.next_1d());
                (f64::from(a) - 0.5) * (f64::from(b) - 0.5)
            })
            .sum();
        assert!((12.0 * sum / f64::from(n)).abs() < 5.0 / f64::from(n).sqrt());
    }

    #[test]
    fn the_same_place_gives_the_same_numbers_and_others_differ() {
        let all = |mut s: Sampler| [s.next_1d(), s.next_1d(), s.array_2d(3).map(|p| p.y).sum()];
        let base = Sampler::new(3, [10, 20], 4);
        assert_eq!(all(base), all(Sampler::new(3, [10, 20], 4)));
        let others = [
            Sampler::new(4, [10, 20], 4),
            Sampler::new(3, [20, 10], 4),
            Sampler::new(3, [10, 20], 5),
            base.fork(0),
            base.fork(1),
            base.fork(0).fork(1),
            base.fork(1).fork(0),
        ];
        for (i, a) in others.iter().enumerate() {
            assert_ne!(all(*a), all(base));
            assert!(others[..i].iter().all(|b| all(*a) != all(*b)));
        }
    }
}
