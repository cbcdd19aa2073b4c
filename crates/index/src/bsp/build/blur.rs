//! How far beside its true place a primitive may be met, by rounding.
//!
//! The watertight triangle test displaces corners in proportion to their distance from the ray's origin. As far
//! as that distance is the way of the ray, the walk allows for it; what is left is the size of the primitive.
//! The walk allows for *usual* sizes everywhere; primitives beyond are grown instead.

use super::pieces::Pieces;
use super::reference::Reference;
use crate::parallel;
use glam::Vec3;
use heliostat_geometry::Aabb;
use heliostat_geometry::error_bound::{cell_padding, clipped_corner};

/// One primitive in so many may be larger than usual.
const RARE: usize = 64;

/// What the walk must allow for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Blur {
    /// The size, along one axis, that few primitives exceed.
    usual_size: f32,
    /// Error of clipping, per axis.
    pub(crate) clipping: f64,
}

impl Blur {
    pub(crate) fn of(refs: &Pieces) -> Self {
        let sizes_of =
            |piece: &Vec<Reference>| piece.iter().map(|r| r.bounds().size().max_element()).collect();
        let join = |mut some: Vec<f32>, more: Vec<f32>| {
            some.extend(more);
            some
        };
        let mut sizes = parallel::map_reduce(refs.as_slices(), sizes_of, join).unwrap_or_default();
        let Some(last) = sizes.len().checked_sub(1) else { return Self::default() };
        let (_, &mut usual_size, _) = sizes.select_nth_unstable_by(last - last / RARE, f32::total_cmp);
        let around = refs.around().bounds();
        let extent = around.min.abs().max(around.max.abs()).max_element();
        Self { usual_size, clipping: clipped_corner(extent) }
    }

    /// How far outside its cell, in lengths, the walk must look for a primitive.
    pub(crate) fn slack(self) -> f32 {
        cell_padding(0.0, self.usual_size) + self.clipping as f32 + f32::MIN_POSITIVE
    }

    /// By how much a primitive with this box must be grown; 0 for all but a few.
    pub(crate) fn margin(self, bounds: Aabb) -> f32 {
        let size = bounds.size().max_element();
        if size > self.usual_size { cell_padding(0.0, size) } else { 0.0 }
    }

    /// A primitive's box, grown when it is larger than usual.
    pub(crate) fn grown(self, bounds: Aabb) -> Aabb {
        grow(bounds, self.margin(bounds))
    }
}

/// The box grown by so much on all sides, and no less than without rounding; as it is for 0.
pub(crate) fn grow(bounds: Aabb, margin: f32) -> Aabb {
    if margin == 0.0 {
        return bounds;
    }
    let (low, high) = (bounds.min - Vec3::splat(margin), bounds.max + Vec3::splat(margin));
    Aabb {
        min: Vec3::new(low.x.next_down(), low.y.next_down(), low.z.next_down()),
        max: Vec3::new(high.x.next_up(), high.y.next_up(), high.z.next_up()),
    }
}
