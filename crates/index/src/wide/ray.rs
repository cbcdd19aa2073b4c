//! A ray as the walk compares it with boxes: constants that already hold all rounding.

use glam::{Vec3, Vec3A};
use heliostat_geometry::error_bound::{cell_padding, inverse_direction, slab_padding};
use heliostat_geometry::{Aabb, Interval, Ray};

/// Where all boxes are, and how fine they are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room {
    pub(super) low: Vec3A,
    pub(super) high: Vec3A,
    /// How far beside its place something may be met even where a ray starts.
    pub(super) slack: f32,
    /// The slack, and the rounding of coordinates in here.
    pub(super) padding: Vec3A,
    /// A size that few boxes of leaves are below.
    pub(super) detail: f32,
}

impl Room {
    /// The room inside `bounds`; what is in it may be met `slack` beside its place, and few boxes are smaller than `detail`.
    pub(crate) fn new(bounds: Aabb, slack: f32, detail: f32) -> Self {
        let extent = if bounds.is_empty() { Vec3::ZERO } else { bounds.min.abs().max(bounds.max.abs()) };
        Self {
            low: bounds.min.into(),
            high: bounds.max.into(),
            slack,
            padding: Vec3A::splat(slack) + slab_padding(extent.into()),
            detail,
        }
    }
}

/// What the walk needs of a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxRay {
    pub(super) origin: Vec3A,
    pub(super) inverse: Vec3A,
    /// The distance to a plane at `b` is `b * inverse - offset`: the offsets for the sides where the ray enters and where it
    /// leaves lie as far apart as a ray may run beside a box, along each axis, and still meet what is in it.
    pub(super) near_offset: Vec3A,
    pub(super) far_offset: Vec3A,
    /// The largest distance along an axis up to which something may be met.
    pub(super) reach: f32,
    pub(super) range: Interval,
    /// Whether the offsets would blur the boxes of the room: where it spans very different sizes, lies far from the origin of
    /// coordinates, or is larger than products of numbers can be.
    pub(super) blurs: bool,
}

impl BoxRay {
    /// The ray in a room.
    #[inline(always)]
    pub(super) fn new(ray: &Ray, room: &Room) -> Self {
        let (origin, inverse) = (Vec3A::from(ray.origin), inverse_direction(ray.dir.into()));
        // The offsets without the part that depends on the reach, which takes longest to find.
        let padding = room.padding + slab_padding(origin.abs());
        let (middle, size) = (origin * inverse, inverse.abs());
        let (near, far) = (middle + padding * size, middle - padding * size);
        let reach = (room.high - origin).max(origin - room.low).max_element();
        let along = Vec3A::splat(reach * cell_padding(1.0, 0.0));
        let (near_offset, far_offset) = (near + along * size, far - along * size);
        let is_sharp = (padding + along).cmple(Vec3A::splat(room.detail));
        let is_sharp = is_sharp & near_offset.is_finite_mask() & far_offset.is_finite_mask();
        Self { origin, inverse, near_offset, far_offset, reach, range: ray.range, blurs: !is_sharp.all() }
    }

    /// Bit a: the ray runs downward along axis a.
    #[inline(always)]
    pub(super) fn octant(&self) -> usize {
        self.inverse.is_negative_bitmask() as usize
    }
}
