//! Analytic shapes and the transforms that put them into the world.

use super::random::Random;
use crate::shape::Shape;
use crate::transform::Transform;
use proptest::prelude::*;

/// Any bounded shape with lengths about 1.
pub fn shape() -> impl Strategy<Value = Shape> {
    any::<u64>().prop_map(|seed| Random::new(seed).shape())
}

/// A turn, a scale of `1e-3` to `1e5` that differs per axis and may mirror, and a shift by up to `1e4`.
pub fn transform() -> impl Strategy<Value = Transform> {
    any::<u64>().prop_map(|seed| Random::new(seed).transform(0.001, 100_000.0, 10_000.0))
}
