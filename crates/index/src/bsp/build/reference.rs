//! A primitive in the cell at hand, with the box of the part of it that lies there.

use glam::{Vec3, Vec4, Vec4Swizzles};
use heliostat_geometry::Aabb;

/// A primitive in a cell. Two vectors of four, because builds do little else than compare them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reference {
    /// Lower corner; in the fourth lane the bits of the primitive's id.
    low: Vec4,
    /// Upper corner.
    high: Vec4,
}

impl Reference {
    pub(crate) fn new(primitive: u32, bounds: Aabb) -> Self {
        Self { low: bounds.min.extend(f32::from_bits(primitive)), high: bounds.max.extend(0.0) }
    }

    #[inline(always)]
    pub(crate) fn primitive(&self) -> u32 {
        self.low.w.to_bits()
    }

    #[inline(always)]
    pub(crate) fn bounds(&self) -> Aabb {
        Aabb { min: self.low.xyz(), max: self.high.xyz() }
    }

    #[inline(always)]
    pub(crate) fn with_bounds(&self, bounds: Aabb) -> Self {
        Self::new(self.primitive(), bounds)
    }

    #[inline(always)]
    pub(crate) fn low(&self, axis: usize) -> f32 {
        // By way of the array: as a vector, it would be loaded whole.
        self.low.as_ref()[axis]
    }

    #[inline(always)]
    pub(crate) fn high(&self, axis: usize) -> f32 {
        self.high.as_ref()[axis]
    }

    /// The corners, with something in the fourth lane that must not be looked at.
    #[inline(always)]
    pub(crate) fn corners(&self) -> (Vec4, Vec4) {
        (self.low, self.high)
    }
}

/// A box that grows around references; the fourth lanes hold nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Around {
    pub(crate) low: Vec4,
    pub(crate) high: Vec4,
}

impl Around {
    pub(crate) const NOTHING: Self = Self { low: Vec4::INFINITY, high: Vec4::NEG_INFINITY };

    #[inline(always)]
    pub(crate) fn add(&mut self, low: Vec4, high: Vec4) {
        self.low = self.low.min(low);
        self.high = self.high.max(high);
    }

    #[inline(always)]
    pub(crate) fn union(mut self, other: Self) -> Self {
        self.add(other.low, other.high);
        self
    }

    pub(crate) fn of(refs: &[Reference]) -> Self {
        let mut around = Self::NOTHING;
        refs.iter().for_each(|r| around.add(r.low, r.high));
        around
    }

    pub(crate) fn bounds(self) -> Aabb {
        Aabb { min: self.low.xyz(), max: self.high.xyz() }
    }

    /// Half the area of the faces; 0 when there is nothing.
    #[inline(always)]
    pub(crate) fn half_area(self) -> f64 {
        let d = (self.high - self.low).max(Vec4::ZERO);
        let Vec3 { x, y, z } = d.xyz();
        let (x, y, z) = (f64::from(x), f64::from(y), f64::from(z));
        x * y + y * z + z * x
    }
}
