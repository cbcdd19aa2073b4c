//! Numbers in `[0, 1]` in whole steps; sRGB in 256 of them by a table, without a power for each number.

use crate::view::encoded;

/// The step of a number that is stored as it is.
pub(super) fn linear_step(v: f32, largest: u16) -> u16 {
    // To the nearest, without a call for each; `as` turns NaN into 0.
    (f64::from(v.clamp(0.0, 1.0)) * f64::from(largest) + 0.5) as u16
}

/// The 256 steps of linear display light, sRGB-encoded: exactly those of the formula.
#[derive(Debug)]
pub(super) struct EncodedSteps {
    /// The smallest number of each step from 1 on; infinite beyond the last.
    starts: [f32; 256],
    /// The step at the beginning of each run of numbers that share the upper bits.
    guesses: Vec<u8>,
}

/// So many lower bits of a number are left out in the table of guesses; a run reaches over one border or two.
const LOWER_BITS: u32 = 15;

impl EncodedSteps {
    pub(super) fn new() -> Self {
        let step = |bits: u32| formula(f32::from_bits(bits));
        let one = 1.0_f32.to_bits();
        // Steps rise with the number, and the bits of a number that is not negative rise with it.
        let start = |before: usize| {
            let (mut below, mut reached) = (0, one);
            while reached - below > 1 {
                let middle = below + (reached - below) / 2;
                if usize::from(step(middle)) > before {
                    reached = middle;
                } else {
                    below = middle;
                }
            }
            f32::from_bits(reached)
        };
        let starts = std::array::from_fn(|before| if before < 255 { start(before) } else { f32::INFINITY });
        Self { starts, guesses: (0..=one >> LOWER_BITS).map(|run| step(run << LOWER_BITS)).collect() }
    }

    /// The step of a number in `[0, 1]`.
    #[inline]
    pub(super) fn step(&self, v: f32) -> u8 {
        // The sum makes a positive zero of a negative one; what is not a number has no guess.
        let run = (v + 0.0).to_bits() >> LOWER_BITS;
        let Some(&(mut step)) = self.guesses.get(run as usize) else { return 0 };
        while self.starts[usize::from(step)] <= v {
            step += 1;
        }
        step
    }
}

fn formula(v: f32) -> u8 {
    linear_step(encoded(v), u16::from(u8::MAX)) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_formula() {
        let table = EncodedSteps::new();
        // A prime stride, and the numbers around every border.
        let borders = table.starts[..255].iter().flat_map(|v| [v.next_down(), *v]);
        let others = (0..=1.0_f32.to_bits()).step_by(10_007).map(f32::from_bits);
        for v in borders.chain(others).chain([1.0]) {
            assert_eq!(table.step(v), formula(v), "{v}");
        }
        assert_eq!([-0.0, f32::NAN].map(|v| table.step(v)), [0, 0]);
    }
}
