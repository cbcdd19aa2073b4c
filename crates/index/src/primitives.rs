//! What an index needs to know of the things it indexes: how many, and where.

use crate::clip::clipped_triangle_bounds;
use heliostat_geometry::{Aabb, TriMesh};

/// A list of primitives that are known by their boxes.
pub trait Primitives: Sync {
    /// How many there are; ids run from 0 to one below.
    fn len(&self) -> usize;

    /// Whether there are none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A box that holds primitive `i` whole: every point at which the caller's closure may find it.
    ///
    /// Rounding in proportion to the way of the ray and to the size of the box is allowed for by the tree
    /// ([`heliostat_geometry::error_bound::cell_padding`]); a closure that rounds more must say so by a larger box.
    ///
    /// Sides may be infinite: such a primitive stays outside the tree, and every query tests it. An empty box or a
    /// NaN is an error of the build.
    fn bounds(&self, i: u32) -> Aabb;

    /// A box that holds the part of primitive `i` inside `cell`, no larger than `cell`; empty when they do not
    /// meet.
    ///
    /// The tighter it is, the fewer cells name a long or slanted primitive.
    fn clipped_bounds(&self, i: u32, cell: Aabb) -> Aabb {
        self.bounds(i).intersect(cell)
    }
}

impl Primitives for [Aabb] {
    fn len(&self) -> usize {
        <[Aabb]>::len(self)
    }

    fn bounds(&self, i: u32) -> Aabb {
        self[i as usize]
    }
}

impl Primitives for Vec<Aabb> {
    fn len(&self) -> usize {
        self.as_slice().len()
    }

    fn bounds(&self, i: u32) -> Aabb {
        self[i as usize]
    }
}

impl Primitives for TriMesh {
    fn len(&self) -> usize {
        self.triangles.len()
    }

    fn bounds(&self, i: u32) -> Aabb {
        // `f32::min` would drop a NaN corner silently: it becomes a box that the build refuses.
        let corners = self.corners(i);
        if corners.iter().any(|c| c.is_nan()) { Aabb::EMPTY } else { Aabb::of_points(corners) }
    }

    fn clipped_bounds(&self, i: u32, cell: Aabb) -> Aabb {
        clipped_triangle_bounds(self.corners(i), cell)
    }
}
