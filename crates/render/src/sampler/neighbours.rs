//! Where the pixels of a picture stand among each other: the shifts that make the errors of neighbours cancel.
//!
//! # What is wanted
//! Each pixel takes points of a Sobol sequence, and its first `2^k` points fill every elementary interval of that volume once. Where the
//! sequences of neighbours have nothing to do with each other, neither have their errors: the noise is white, and a look from
//! farther away, or any blur, sees a part of it. Where the points of a square of `2^j` x `2^j` pixels fill all elementary
//! intervals of volume `4^-j 2^-k` *together*, the errors of a square cancel as well as those of a pixel with so many samples: only
//! noise of high frequency is left, which eyes, encoders and denoisers take away.
//!
//! # How
//! Take the Sobol sequence of three dimensions whose polynomials are `x`, `x + 1` and `x^2 + x + 1`, and let the third dimension be the place of
//! the pixel on the Z-order (Morton) curve of 65536 x 65536 pixels: the points of a pixel are those of the sequence that fall into its
//! cell, in their order. A square on the curve is an interval of the third dimension of an even number of binary digits, and for
//! multiples of the degree of their polynomial, 2, intervals lose nothing: so the first `2^k` points of all pixels of a square are
//! a (0, 2j + k, 2)-net in the other two dimensions, for every `j` and `k` at once. No number of samples is fixed
//! beforehand, so samples can be added to a picture at any time.
//!
//! Solved for the points of one pixel with the code `z` (digits of its place on the curve, the first one lowest) this is
//!
//! `x(s) = s + A z,  y(s) = P s + B z`
//!
//! over the field of two elements, with Pascal's matrix `P`: the sequence of any pixel, shifted. For let `Z = [Z1 Z2]` be the
//! generator of the third dimension, cut after 32 columns, `Z1^-1 Z2 = L1 U1` and `P (Z1^-1 Z2 + 1) U1^-1 = L2 P` with lower triangular
//! `L1` and `L2`, which Owen's scramble does not see; then `A = L1^-1 Z1^-1` and `B = L2^-1 P Z1^-1`.
//!
//! # Source
//! The idea: Ahmed, Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels",
//! SIGGRAPH Asia 2020, whose sequence is one long Sobol sequence for a number of samples that is fixed. Intervals of multiples of the
//! degree: Niederreiter, "Low-Discrepancy and Low-Dispersion Sequences", J. Number Theory 30, 1988. That `L2 P` comes out:
//! Hofer, Suzuki, "A Complete Classification of Digital (0, m, 3)-Nets and Digital (0, 2)-Sequences in Base 2", 2019.

use sobol_burley::parts::{hash, owen_scramble_rev};

/// The columns of `A`; bit `r` is row `r`, the row of the leading binary digit first.
const A: [u32; 32] = [
    0x0001_0001,
    0x0003_0003,
    0x0007_0007,
    0x0009_0009,
    0x0015_0015,
    0x003f_003f,
    0x006b_006b,
    0x00bd_00bd,
    0x0111_0111,
    0x0333_0333,
    0x0777_0777,
    0x0999_0999,
    0x1445_1445,
    0x3ccf_3ccf,
    0x6ddb_6ddb,
    0xb66d_b66d,
    0x0100_0101,
    0x0300_0303,
    0x0700_0707,
    0x0900_0909,
    0x1500_1515,
    0x3f00_3f3f,
    0x6b00_6b6b,
    0xbd00_bdbd,
    0x1101_1011,
    0x3303_3033,
    0x7707_7077,
    0x9909_9099,
    0x4514_5145,
    0xcf3c_f3cf,
    0xdb6d_b6db,
    0x6db6_db6d,
];

/// The columns of `B`.
const B: [u32; 32] = [
    0x0001_0001,
    0x0002_0002,
    0x0007_0007,
    0x000e_000e,
    0x0015_0015,
    0x002a_002a,
    0x006b_006b,
    0x00d6_00d6,
    0x0111_0111,
    0x0222_0222,
    0x0777_0777,
    0x0eee_0eee,
    0x1445_1445,
    0x288a_288a,
    0x6ddb_6ddb,
    0xdbb6_dbb6,
    0x0100_0101,
    0x0200_0202,
    0x0700_0707,
    0x0e00_0e0e,
    0x1500_1515,
    0x2a00_2a2a,
    0x6b00_6b6b,
    0xd600_d6d6,
    0x1101_1011,
    0x2202_2022,
    0x7707_7077,
    0xee0e_e0ee,
    0x4514_5145,
    0x8a28_a28a,
    0xdb6d_b6db,
    0xb6db_6db6,
];

/// Both matrices times every value of each byte of a code.
static SHIFTS: [[[u32; 2]; 256]; 4] = shifts();

const fn shifts() -> [[[u32; 2]; 256]; 4] {
    let mut table = [[[0; 2]; 256]; 4];
    let mut byte = 0;
    while byte < 4 {
        let mut value = 1;
        while value < 256 {
            let bit = (value as u32).trailing_zeros() as usize;
            let rest = table[byte][value & (value - 1)];
            table[byte][value] = [rest[0] ^ A[8 * byte + bit], rest[1] ^ B[8 * byte + bit]];
            value += 1;
        }
        byte += 1;
    }
    table
}

/// The shifts of both coordinates for the code of a pixel, their leading binary digit lowest.
#[inline]
pub(super) fn shift(code: u32) -> [u32; 2] {
    let bytes = code.to_le_bytes();
    let part = |i: usize| SHIFTS[i][usize::from(bytes[i])];
    let [a, b, c, d] = [part(0), part(1), part(2), part(3)];
    std::array::from_fn(|i| a[i] ^ b[i] ^ c[i] ^ d[i])
}

/// The place of index `i` in the order of one pixel: within each run from `2^k` to `2^(k + 1)` blocks of a power of two are shuffled.
///
/// The first `2^k` points of a pixel must be those of its neighbours, but not in the same order: else all pixels would pair the points of
/// two draws alike, and where that pairing is a poor one, be wrong together.
#[inline]
pub(super) fn reordered(i: u32, key: u32) -> u32 {
    let Some(run) = i.checked_ilog2().filter(|&run| run > 0) else { return i };
    let within = (i << (32 - run)).reverse_bits();
    let shuffled = owen_scramble_rev(within, key ^ hash(run)).reverse_bits() >> (32 - run);
    1 << run | shuffled
}

/// The place of a pixel on the Z-order curve of 65536 x 65536 pixels, by the lower 16 bits of column and row, its leading binary digit lowest.
pub(super) fn code(pixel: [u32; 2]) -> u32 {
    (spread(pixel[1]) << 1 | spread(pixel[0])).reverse_bits()
}

/// The lower 16 bits, with a zero before each.
///
/// # Source
/// Morton, "A Computer Oriented Geodetic Data Base", IBM 1966.
fn spread(bits: u32) -> u32 {
    let bits = (bits & 0xffff | bits << 8) & 0x00ff_00ff;
    let bits = (bits | bits << 4) & 0x0f0f_0f0f;
    let bits = (bits | bits << 2) & 0x3333_3333;
    (bits | bits << 1) & 0x5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_places_on_the_curve() {
        assert_eq!(code([0, 0]), 0);
        assert_eq!(code([1, 0]).reverse_bits(), 1);
        assert_eq!(code([0, 1]).reverse_bits(), 2);
        assert_eq!(code([3, 2]).reverse_bits(), 0b1101);
        assert_eq!(code([0xffff, 0xffff]), u32::MAX);
    }

    #[test]
    fn orders_differ_within_runs_alone() {
        for key in [0, 7, 0xdead_beef] {
            let order: Vec<u32> = (0..256).map(|i| reordered(i, key)).collect();
            assert_eq!(order[..2], [0, 1]);
            assert!((0..256).zip(&order).any(|(i, &place)| i != place), "{key}");
            for run in 1..8 {
                let mut places = order[1 << run..2 << run].to_vec();
                places.sort_unstable();
                assert_eq!(places, (1 << run..2 << run).collect::<Vec<_>>(), "{key}: {run}");
            }
        }
    }

    #[test]
    fn shifts_are_linear() {
        for (a, b) in [(1, 2), (0xdead_beef, 0x1234_5678), (1 << 31, 0x00ff_00ff)] {
            let (sa, sb) = (shift(a), shift(b));
            assert_eq!(shift(a ^ b), [sa[0] ^ sb[0], sa[1] ^ sb[1]]);
        }
        (0..32).for_each(|bit| assert_eq!(shift(1 << bit), [A[bit], B[bit]]));
    }
}
