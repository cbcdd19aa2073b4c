//! The form of the tree that rays walk: up to eight children a node, each with the box of what is in its cell.
//!
//! A wide node is a treelet of the binary tree: its children are the cells at the treelet's lower ends. A child carries not
//! its cell but the box around the parts of primitives inside it, which is often much smaller; an empty cell is left out.
//! Because the cells are disjoint, the order in which a ray meets them follows from the signs of its direction alone: each
//! node has the order for each of the eight octants, and no distances are sorted.
//!
//! # Source
//! Wald, Benthin, Boulos, "Getting Rid of Packets", 2008 (wide nodes); Fuetterling et al., "Accelerated Single Ray Tracing
//! for Wide Vector Units", HPG 2017 (orders by octant, compressed children).

pub(crate) mod batch;
pub(crate) mod collapse;
mod plans;
pub(crate) mod ray;
pub(crate) mod rays;
pub(crate) mod set;
mod validate;
pub(crate) mod walk;

use crate::simd::{LANES, Row};
use glam::Vec3;
use heliostat_geometry::Aabb;
use ray::Room;

/// Marks a child that is a leaf; the other bits are for whoever searches it.
pub(crate) const LEAF: u32 = 1 << 31;

/// All wide nodes, the root first, and where they are.
#[derive(Clone, Debug)]
pub(crate) struct Wide {
    pub(crate) nodes: Vec<WideNode>,
    pub(crate) room: Room,
}

/// Up to eight children.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct WideNode {
    /// Along x, y, z the lower sides of the children's boxes, then the upper ones. A lane without a child holds an empty box.
    planes: [[Row; 2]; 3],
    /// Index of a node, or [`LEAF`] and what the leaf is.
    children: [u32; LANES],
    /// For each octant of directions (bit a: downward along axis a), the lanes from the first to be met to the last, three
    /// bits each.
    orders: [u32; LANES],
}

impl WideNode {
    pub(crate) const EMPTY: Self = {
        let (none, nothing) = (Row([f32::INFINITY; LANES]), Row([f32::NEG_INFINITY; LANES]));
        Self { planes: [[none, nothing]; 3], children: [LEAF; LANES], orders: [0o76543210; LANES] }
    };

    /// The box of a child; empty where there is none.
    pub(crate) fn bounds(&self, lane: usize) -> Aabb {
        let corner = |side: usize| Vec3::from_array(std::array::from_fn(|a| self.planes[a][side].0[lane]));
        Aabb { min: corner(0), max: corner(1) }
    }

    fn set(&mut self, lane: usize, bounds: Aabb, child: u32) {
        for axis in 0..3 {
            self.planes[axis][0].0[lane] = bounds.min[axis];
            self.planes[axis][1].0[lane] = bounds.max[axis];
        }
        self.children[lane] = child;
    }

    /// Gives the nodes among the children other numbers.
    fn renumber(&mut self, number: impl Fn(usize) -> usize) {
        for child in self.children.iter_mut().filter(|child| **child & LEAF == 0) {
            *child = number(*child as usize) as u32;
        }
    }

    /// The children that there are, with their boxes.
    pub(crate) fn children(&self) -> impl Iterator<Item = (u32, Aabb)> {
        (0..LANES)
            .map(|lane| (self.children[lane], self.bounds(lane)))
            .filter(|(_, bounds)| !bounds.is_empty())
    }
}
