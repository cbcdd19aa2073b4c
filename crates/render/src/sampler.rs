//! Random numbers as pure functions of (seed, pixel, sample, branch, dimension).
//!
//! Each draw is one point of a two-dimensional Sobol sequence, shuffled and Owen-scrambled by a hash of everything but
//! the sample index. So the samples of one pixel are stratified among themselves in every draw, whatever the number of
//! samples; different draws and branches have nothing to do with each other. There is no state to seed,
//! store or share: sample 5 of a pixel is the same on every thread, in every tile, in every pass.
//!
//! Pixels either have nothing to do with each other, so that the error of a picture is white noise, or are stratified among each other as
//! well, in squares of every size: then it is blue noise. The module `neighbours` says how.
//!
//! # Source
//! Burley, "Practical Hash-based Owen Scrambling", JCGT 2020 (shuffled padding); Vegdahl, "Building a Better LK Hash",
//! 2021 (the scramble, from the crate `sobol_burley`); Ahmed, "An Implementation Algorithm of 2D Sobol Sequence Fast,
//! Elegant, and Compact", EGSR 2024 (the second dimension without a table, over the full 32 bits).

mod neighbours;

use glam::Vec2;
use heliostat_scene::RenderSettings;
use heliostat_scene::settings::SamplerKind;
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

/// The random numbers of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pattern {
    seed: u64,
    kind: SamplerKind,
    /// Whether pixels of the two colours of a chessboard have nothing to do with each other.
    is_chequered: bool,
}

impl Pattern {
    /// The numbers that settings ask for.
    pub fn new(settings: &RenderSettings) -> Self {
        // Where noise decides, the pixels of one colour say how many samples those of the other take.
        Self { seed: settings.seed, kind: settings.sampler, is_chequered: settings.noise.is_some() }
    }

    /// The numbers of sample `sample` of the pixel at column `pixel[0]`, row `pixel[1]` of the whole picture.
    #[inline]
    pub fn sampler(&self, pixel: [u32; 2], sample: u32) -> Sampler {
        match self.kind {
            SamplerKind::White => Sampler::new(self.seed, pixel, sample),
            SamplerKind::Blue if self.is_chequered => {
                // Half of the pixels of a row, moved together.
                let colour = (pixel[0] ^ pixel[1]) & 1;
                Sampler::among_neighbours(self.seed, 1 + colour, [pixel[0] >> 1, pixel[1]], sample)
            }
            SamplerKind::Blue => Sampler::among_neighbours(self.seed, 0, pixel, sample),
        }
    }
}

/// The random numbers of one sample of one pixel, in one branch of its recursion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampler {
    /// Hash of seed, pixel and the branches on the way here; the same for all samples of the pixel, and for all pixels where they are
    /// stratified among each other.
    key: u64,
    /// The code of the pixel, where it is stratified among its neighbours.
    code: Option<u32>,
    /// Index of the sample within the pixel.
    sample: u32,
    /// Draws taken so far.
    dimension: u32,
}

impl Sampler {
    /// The numbers of sample `sample` of the pixel at column `pixel[0]`, row `pixel[1]` of the whole picture, which has nothing to do
    /// with other pixels.
    pub fn new(seed: u64, pixel: [u32; 2], sample: u32) -> Self {
        let place = u64::from(pixel[0]) << 32 | u64::from(pixel[1]);
        Self { key: mix(mix(seed ^ GOLDEN) ^ place), code: None, sample, dimension: 0 }
    }

    /// The same for a pixel that is stratified among those of the same set.
    fn among_neighbours(seed: u64, set: u32, pixel: [u32; 2], sample: u32) -> Self {
        // No pixel is so far to the right: the keys are none of those above.
        let place = u64::from(u32::MAX) << 32 | u64::from(set);
        let code = Some(neighbours::code(pixel));
        // Beyond the curve begins another one.
        let beyond = u64::from(pixel[0] >> 16) << 16 | u64::from(pixel[1] >> 16);
        Self { key: mix(mix(mix(seed ^ GOLDEN) ^ place) ^ beyond), code, sample, dimension: 0 }
    }

    /// The numbers of a photon of an iteration: stratified among the photons of the iteration, and nothing to those of others and to
    /// those of pixels.
    pub(crate) fn of_photon(seed: u64, iteration: u32, photon: u32) -> Self {
        // No pixel is so far below.
        Self::new(seed, [iteration, u32::MAX], photon)
    }

    /// The numbers of a path that is followed for practice: stratified among the paths of its turn, and nothing to those of others and
    /// to those of pixels.
    pub(crate) fn of_practice(seed: u64, turn: u32, path: u32) -> Self {
        // Nor so far below.
        Self::new(seed, [turn, u32::MAX - 1], path)
    }

    /// Index of the sample within the pixel.
    pub fn sample(&self) -> u32 {
        self.sample
    }

    /// A number in `[0, 1)`; stratified over the samples of the pixel.
    #[inline]
    pub fn next_1d(&mut self) -> f32 {
        let scramble = self.next_scramble();
        scramble.first(scramble.shuffled(self.sample))
    }

    /// A point of the unit square `[0, 1)²`; stratified over the samples of the pixel.
    #[inline]
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
    #[inline]
    pub fn fork(&self, branch: u32) -> Self {
        // The constant keeps forks apart from draws, which step the key by multiples of GOLDEN.
        let key = mix(self.key.rotate_left(32) ^ mix(u64::from(branch) ^ 0xd1b5_4a32_d192_ed03));
        Self { key, dimension: 0, ..*self }
    }

    /// The sequence of the next draw.
    #[inline]
    fn next_scramble(&mut self) -> Scramble {
        self.dimension += 1;
        let bits = mix(self.key.wrapping_add(GOLDEN.wrapping_mul(u64::from(self.dimension))));
        let (order, x) = (bits as u32, (bits >> 32) as u32);
        let y = hash(x);
        // Squares of the picture stay squares, in another order for each draw.
        let shift = self.code.map_or([0; 2], |code| neighbours::shift(owen_scramble_rev(code, hash(y))));
        let own_order = self.code.map(|code| hash(code ^ hash(order)));
        Scramble { order, own_order, x, y, shift }
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
    /// Where pixels share the order: what keeps them from sharing all of it.
    own_order: Option<u32>,
    x: u32,
    y: u32,
    /// What is added to the digits of both coordinates, for the pixel's place among its neighbours.
    shift: [u32; 2],
}

impl Scramble {
    /// The place of index `i` after a shuffle in which blocks of 2^k indices stay blocks, so that every such block of samples
    /// is a (0, k, 2)-net.
    #[inline(always)]
    fn shuffled(self, i: u32) -> u32 {
        let i = self.own_order.map_or(i, |key| neighbours::reordered(i, key));
        owen_scramble_rev(i.reverse_bits(), self.order).reverse_bits()
    }

    /// Point `index` of the sequence.
    #[inline(always)]
    fn point(self, index: u32) -> Vec2 {
        let y = owen_scramble_rev(pascal(index) ^ self.shift[1], self.y).reverse_bits();
        Vec2::new(self.first(index), to_unit(y))
    }

    /// The first coordinate of point `index`.
    #[inline(always)]
    fn first(self, index: u32) -> f32 {
        // Scramble: the bits of a Sobol coordinate, reversed, are those of the index times a matrix.
        to_unit(owen_scramble_rev(index ^ self.shift[0], self.x).reverse_bits())
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
mod tests;
