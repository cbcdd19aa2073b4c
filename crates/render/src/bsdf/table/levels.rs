//! What depends on the roughness alone, at many levels of it with lines between.
//!
//! Where a texture varies the roughness, a surface is put together at every hit: two levels are read, in place of all the
//! nodes of a polynomial. The levels are worked out once, when they are first asked for.

use super::chebyshev::weights;

/// `N` numbers at each level: evenly over the fourth root of the width, so that narrow ones are told apart.
#[derive(Debug)]
pub(super) struct Levels<const N: usize>(Box<[[f32; N]]>);

impl<const N: usize> Levels<N> {
    /// From the numbers at `W` nodes of the roughness, the root of the width, by polynomials.
    pub(super) fn new<const W: usize>(count: usize, nodes: &[[f32; N]]) -> Self {
        let level = |k: usize| {
            let mut sums = [0.0; N];
            for (node, weight) in nodes.iter().zip(weights::<W>((k as f32 / (count - 1) as f32).powi(2))) {
                sums.iter_mut().zip(node).for_each(|(sum, number)| *sum += weight * number);
            }
            sums
        };
        Self((0..count).map(level).collect())
    }

    /// From the numbers at each level itself, by the width.
    pub(super) fn each(count: usize, numbers: impl Fn(f32) -> [f32; N]) -> Self {
        Self((0..count).map(|k| numbers((k as f32 / (count - 1) as f32).powi(4))).collect())
    }

    /// The numbers at a width.
    pub(super) fn at(&self, alpha: f32) -> [f32; N] {
        let (low, high, between) = self.around(alpha);
        std::array::from_fn(|k| low[k] + (high[k] - low[k]) * between)
    }

    /// The numbers at the levels below and above a width, and how far it is from the one to the other.
    pub(super) fn around(&self, alpha: f32) -> (&[f32; N], &[f32; N], f32) {
        let x = alpha.clamp(0.0, 1.0).sqrt().sqrt() * (self.0.len() - 1) as f32;
        let level = (x as usize).min(self.0.len() - 2);
        (&self.0[level], &self.0[level + 1], x - level as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::table::chebyshev::nodes;

    #[test]
    fn levels_are_their_polynomial() {
        let levels = Levels::new::<5>(101, &nodes::<5>().map(|x| [x * x, 1.0 - x.powi(3)]));
        for k in 0..=77 {
            let x = k as f32 / 77.0;
            let [square, cube] = levels.at(x * x);
            // Lines leave out an eighth of the second derivative over the fourth root, over the square of the count.
            assert!((square - x * x).abs() < 2e-4 && (cube - 1.0 + x.powi(3)).abs() < 4e-4, "{x}");
        }
        let each = Levels::each(11, |alpha| [alpha.sqrt().sqrt()]);
        assert!((each.at(0.3)[0] - 0.3_f32.sqrt().sqrt()).abs() < 1e-6);
    }
}
