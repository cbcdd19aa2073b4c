//! Planes: to which side of one a reference goes, and the plane in the middle.

use super::build::Reference;
use heliostat_geometry::Aabb;

/// An axis-aligned plane strictly inside a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane {
    pub(crate) axis: usize,
    pub(crate) position: f32,
}

/// Where a box lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    Right,
    Both,
}

impl Plane {
    /// The side of a box. One that touches the plane from a side belongs to that side alone, one that lies in the
    /// plane to the left: the walk looks a padding beyond each plane and so finds it from both sides.
    #[inline]
    pub(crate) fn side(self, reference: &Reference) -> Side {
        if reference.high(self.axis) <= self.position {
            Side::Left
        } else if reference.low(self.axis) >= self.position {
            Side::Right
        } else {
            Side::Both
        }
    }

    /// The two parts of a box that the plane cuts.
    pub(crate) fn cut(self, bounds: Aabb) -> (Aabb, Aabb) {
        let (mut left, mut right) = (bounds, bounds);
        left.max[self.axis] = self.position;
        right.min[self.axis] = self.position;
        (left, right)
    }

    /// How many references go left and how many go right.
    pub(crate) fn count(self, refs: &[Reference]) -> (usize, usize) {
        refs.iter().fold((0, 0), |(left, right), r| match self.side(r) {
            Side::Left => (left + 1, right),
            Side::Right => (left, right + 1),
            Side::Both => (left + 1, right + 1),
        })
    }

    /// The plane in the middle of the longest edge; `None` when no float lies between its ends.
    pub(crate) fn midpoint(cell: Aabb) -> Option<Self> {
        let axis = cell.longest_axis();
        let position = cell.centre()[axis];
        (cell.min[axis] < position && position < cell.max[axis]).then_some(Self { axis, position })
    }
}
