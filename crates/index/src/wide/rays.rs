//! Many rays, coordinate by coordinate: what is worked out once a ray is worked out for as many at a time as there are lanes.
//!
//! These are plain loops over columns, of which the compiler makes vector instructions.

use super::ray::Room;
use super::walk::{Boxes, Sides, splat};
use crate::simd::{LANES, Lanes};
use glam::{Vec3, Vec3A};
use heliostat_geometry::error_bound::{cell_padding, inverse_component, is_tiny, slab_padding};
use heliostat_geometry::{Interval, Ray};

/// So many rays are walked together: enough to hide how long one waits, few enough to stay in the nearest cache.
pub(crate) const TOGETHER: usize = 64;

/// A value for each ray.
pub(crate) type PerRay<T> = [T; TOGETHER];

/// A coordinate of each ray, for each axis.
pub(crate) type Coordinates = [PerRay<f32>; 3];

pub(crate) const NO_COORDINATES: Coordinates = [[0.0; TOGETHER]; 3];

/// Rays as they came.
pub(crate) struct Rays {
    pub(crate) origin: Coordinates,
    pub(crate) dir: Coordinates,
    /// The ends of their ranges.
    pub(crate) min: PerRay<f32>,
    pub(crate) max: PerRay<f32>,
    /// How many there are; behind them is what was there before.
    pub(crate) len: usize,
    /// Whether any of them starts in the room.
    pub(crate) any_inside: bool,
}

impl Rays {
    pub(crate) const NONE: Self = Self {
        origin: NO_COORDINATES,
        dir: NO_COORDINATES,
        min: [0.0; TOGETHER],
        max: [0.0; TOGETHER],
        len: 0,
        any_inside: false,
    };

    /// Puts these in the place of those that were there.
    #[inline(always)]
    pub(super) fn fill(&mut self, rays: &[Ray], room: &Room) {
        self.len = rays.len().min(TOGETHER);
        for (i, ray) in rays.iter().take(TOGETHER).enumerate() {
            for axis in 0..3 {
                (self.origin[axis][i], self.dir[axis][i]) = (ray.origin[axis], ray.dir[axis]);
            }
            (self.min[i], self.max[i]) = (ray.range.min, ray.range.max);
        }
        self.any_inside = (0..self.len).fold(false, |any, i| any | self.is_inside(room, i));
    }

    #[inline(always)]
    fn is_inside(&self, room: &Room, ray: usize) -> bool {
        (0..3).fold(true, |is_inside, axis| {
            let at = self.origin[axis][ray % TOGETHER];
            is_inside & (room.low[axis] <= at) & (at <= room.high[axis])
        })
    }

    /// How many there are, in whole lanes.
    #[inline(always)]
    pub(crate) fn padded(&self) -> usize {
        self.len.next_multiple_of(LANES).min(TOGETHER)
    }

    /// A ray as it came.
    #[inline(always)]
    pub(crate) fn ray(&self, i: usize) -> Ray {
        let at = |of: &Coordinates| Vec3::new(of[0][i], of[1][i], of[2][i]);
        let range = Interval { min: self.min[i], max: self.max[i] };
        Ray { origin: at(&self.origin), dir: at(&self.dir), range }
    }
}

/// Rays as they are compared with boxes; what [`BoxRay`](super::ray::BoxRay) is for one.
pub(super) struct BoxRays {
    inverse: Coordinates,
    near_offset: Coordinates,
    far_offset: Coordinates,
    start: PerRay<f32>,
    octant: PerRay<u32>,
    /// Not 0 where a ray is better walked alone: its offsets would blur the boxes, or it is all but without direction.
    is_alone: PerRay<u32>,
}

/// The sides that the rays of each octant meet first and last.
static SIDES: [Sides; LANES] = {
    let mut sides = [Sides::of(0); LANES];
    let mut octant = 1;
    while octant < LANES {
        sides[octant] = Sides::of(octant);
        octant += 1;
    }
    sides
};

impl BoxRays {
    pub(super) const NONE: Self = Self {
        inverse: NO_COORDINATES,
        near_offset: NO_COORDINATES,
        far_offset: NO_COORDINATES,
        start: [0.0; TOGETHER],
        octant: [0; TOGETHER],
        is_alone: [0; TOGETHER],
    };

    /// Works them out as [`BoxRay::new`](super::ray::BoxRay::new) does.
    #[inline(always)]
    pub(super) fn set_up(&mut self, rays: &Rays, room: &Room) {
        let (growth, rounding) = (cell_padding(1.0, 0.0), slab_padding(Vec3A::ONE).x);
        self.start = rays.min;
        for i in 0..rays.padded() {
            let (mut reach, mut longest) = (0.0, 0.0);
            for axis in 0..3 {
                let origin = rays.origin[axis][i];
                reach = greater(greater(room.high[axis] - origin, origin - room.low[axis]), reach);
                longest = greater(rays.dir[axis][i].abs(), longest);
            }
            let along = reach * growth;
            let (mut is_alone, mut octant) = (u32::from(is_tiny(longest)), 0);
            for axis in 0..3 {
                let (origin, inverse) = (rays.origin[axis][i], inverse_component(rays.dir[axis][i]));
                let padding = room.padding[axis] + rounding * origin.abs();
                let (middle, size) = (origin * inverse, inverse.abs());
                let near = middle + padding * size + along * size;
                let far = middle - padding * size - along * size;
                let is_finite = (near.abs() < f32::INFINITY) & (far.abs() < f32::INFINITY);
                is_alone |= u32::from(!(is_finite & (padding + along <= room.detail)));
                octant |= inverse.to_bits() >> 31 << axis;
                self.inverse[axis][i] = inverse;
                (self.near_offset[axis][i], self.far_offset[axis][i]) = (near, far);
            }
            (self.octant[i], self.is_alone[i]) = (octant, is_alone);
        }
    }

    /// Whether a ray is better walked alone.
    #[inline(always)]
    pub(super) fn is_alone(&self, ray: usize) -> bool {
        self.is_alone[ray] != 0
    }

    /// A ray in all lanes.
    #[inline(always)]
    pub(super) fn boxes<L: Lanes>(&self, lanes: L, ray: usize) -> Boxes<L> {
        let at = |of: &Coordinates| Vec3A::new(of[0][ray], of[1][ray], of[2][ray]);
        Boxes {
            sides: SIDES[self.octant[ray] as usize % LANES],
            inverse: splat(lanes, at(&self.inverse)),
            near_offset: splat(lanes, at(&self.near_offset)),
            far_offset: splat(lanes, at(&self.far_offset)),
            start: lanes.splat(self.start[ray]),
        }
    }
}

/// The larger of two numbers, `b` where one is NaN.
#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
