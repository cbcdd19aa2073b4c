//! Random numbers that depend on the number of a ray alone.

use glam::Vec3;
use heliostat_geometry::Aabb;

/// Random numbers that follow from the number of a ray and a seed.
///
/// # Source
/// Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014 (`SplitMix64`).
pub(super) struct Random(u64);

impl Random {
    const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

    pub(super) fn new(number: u64, seed: u64) -> Self {
        let mut start = Self(seed);
        let mixed = start.bits();
        Self(mixed ^ number.wrapping_mul(0xD134_2543_DE82_EF95))
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(Self::STEP);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In `[0, 1)`.
    pub(super) fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1_u64 << 24) as f32
    }

    /// In `0..n`; the bias for an `n` far below 2^64 is nil.
    pub(super) fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    pub(super) fn point(&mut self, bounds: Aabb) -> Vec3 {
        let u = Vec3::new(self.unit(), self.unit(), self.unit());
        bounds.min + u * bounds.size()
    }

    /// A unit vector, uniform on the sphere.
    pub(super) fn direction(&mut self) -> Vec3 {
        let z = 1.0 - 2.0 * self.unit();
        let (sin, cos) = (std::f32::consts::TAU * self.unit()).sin_cos();
        let r = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new(r * cos, r * sin, z)
    }
}
