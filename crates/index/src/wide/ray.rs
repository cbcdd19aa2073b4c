//! A ray as the walk compares it with boxes: constants that already hold all rounding.

use glam::{Vec3, Vec3A};
use heliostat_geometry::error_bound::{cell_padding, inverse_direction, slab_padding};
use heliostat_geometry::{Aabb, Interval, Ray};

/// Where all boxes are, and how fine they are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room {
    low: Vec3A,
    high: Vec3A,
    /// How far beside its place something may be met even where a ray starts.
    pub(super) slack: f32,
    /// Bound of the rounding of coordinates in here.
    rounding: Vec3A,
    /// A size that few boxes of leaves are below.
    detail: f32,
}

impl Room {
    /// The room inside `bounds`; what is in it may be met `slack` beside its place, and few boxes are smaller than `detail`.
    pub(crate) fn new(bounds: Aabb, slack: f32, detail: f32) -> Self {
        let extent = if bounds.is_empty() { Vec3::ZERO } else { bounds.min.abs().max(bounds.max.abs()) };
        Self {
            low: bounds.min.into(),
            high: bounds.max.into(),
            slack,
            rounding: slab_padding(extent.into()),
            detail,
        }
    }

    /// The largest distance along an axis between a point and anything in the room.
    #[inline(always)]
    pub(crate) fn reach(&self, from: Vec3A) -> f32 {
        (self.high - from).max(from - self.low).max_element()
    }
}

/// What the walk needs of a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxRay {
    pub(super) origin: Vec3A,
    pub(super) inverse: Vec3A,
    /// How far beside a box a ray may run, along each axis, and still meet what is in it.
    padding: Vec3A,
    /// The largest distance along an axis up to which something may be met.
    pub(super) reach: f32,
    pub(super) range: Interval,
}

impl BoxRay {
    /// The ray in a room.
    #[inline(always)]
    pub(super) fn new(ray: &Ray, room: &Room) -> Self {
        let (origin, dir) = (Vec3A::from(ray.origin), Vec3A::from(ray.dir));
        let reach = room.reach(origin);
        let along = room.slack + reach * cell_padding(1.0, 0.0);
        Self {
            origin,
            inverse: inverse_direction(dir),
            padding: Vec3A::splat(along) + room.rounding + slab_padding(origin.abs()),
            reach,
            range: ray.range,
        }
    }

    /// The distance to a plane at `b` is `b * inverse - offset`: the offsets for the sides where the ray enters and where it
    /// leaves lie as far apart as the padding.
    #[inline(always)]
    pub(super) fn offsets(&self) -> (Vec3A, Vec3A) {
        let padding = self.padding.copysign(self.inverse);
        ((self.origin + padding) * self.inverse, (self.origin - padding) * self.inverse)
    }

    /// Whether offsets and one padding for all would blur the boxes of the room: where it spans very different sizes, lies far
    /// from the origin of coordinates, or is larger than products of numbers can be.
    #[inline(always)]
    pub(super) fn blurs(&self, room: &Room) -> bool {
        let (near, far) = self.offsets();
        let is_sharp = self.padding.max_element() <= room.detail;
        !(is_sharp & near.is_finite() & far.is_finite())
    }

    /// Bit a: the ray runs downward along axis a.
    #[inline(always)]
    pub(super) fn octant(&self) -> usize {
        self.inverse.is_negative_bitmask() as usize
    }
}
