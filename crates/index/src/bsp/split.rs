//! Planes: to which side of one a reference goes, and the plane in the middle.

use heliostat_geometry::Aabb;

/// A primitive in the cell at hand, with the box of the part of it that lies there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reference {
    pub(crate) primitive: u32,
    pub(crate) bounds: Aabb,
}

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
    pub(crate) fn side(self, bounds: &Aabb) -> Side {
        if bounds.max[self.axis] <= self.position {
            Side::Left
        } else if bounds.min[self.axis] >= self.position {
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
        refs.iter().fold((0, 0), |(left, right), r| match self.side(&r.bounds) {
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
