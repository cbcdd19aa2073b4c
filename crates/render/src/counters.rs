//! Counts of the rays that were traced, by kind.
//!
//! Counters are plain numbers that each tile owns; sums over tiles do not depend on their order.

use std::ops::AddAssign;

/// Rays traced, by what they were for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounters {
    /// From the camera into the scene.
    pub camera: u64,
    /// In mirror directions, total internal reflection included.
    pub reflection: u64,
    /// Into directions into which surfaces scatter light.
    pub scatter: u64,
    /// Through surfaces: refracted ones, and straight ones through cut-outs.
    pub refraction: u64,
    /// Towards light sources.
    pub shadow: u64,
    /// Into the hemisphere above a point, for its openness.
    pub ao: u64,
}

impl RayCounters {
    /// Rays of all kinds.
    pub fn total(&self) -> u64 {
        self.camera + self.reflection + self.scatter + self.refraction + self.shadow + self.ao
    }
}

impl AddAssign for RayCounters {
    fn add_assign(&mut self, other: Self) {
        self.camera += other.camera;
        self.reflection += other.reflection;
        self.scatter += other.scatter;
        self.refraction += other.refraction;
        self.shadow += other.shadow;
        self.ao += other.ao;
    }
}
