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
        if refs.len() == 0 {
            return Self::default();
        }
        let around = refs.around().bounds();
        let extent = around.min.abs().max(around.max.abs()).max_element();
        Self { usual_size: usual_size(refs), clipping: clipped_corner(extent) }
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

/// The size that one in [`RARE`] references reaches.
fn usual_size(refs: &Pieces) -> f32 {
    let rank = (refs.len() - 1) / RARE;
    // A sample tells which sizes need not be sorted.
    let mut sample = sizes(refs, RARE, 0.0);
    let limit = largest(&mut sample, 2 * rank / RARE);
    let mut candidates = sizes(refs, 1, limit);
    if candidates.len() <= rank {
        candidates = sizes(refs, 1, 0.0);
    }
    largest(&mut candidates, rank)
}

/// The sizes from `least` on, of one reference in so many.
fn sizes(refs: &Pieces, step: usize, least: f32) -> Vec<f32> {
    let some = |piece: &Vec<Reference>| {
        let sizes = piece.iter().step_by(step).map(|r| r.bounds().size().max_element());
        sizes.filter(|size| *size >= least).collect()
    };
    let join = |mut some: Vec<f32>, more: Vec<f32>| {
        some.extend(more);
        some
    };
    parallel::map_reduce(refs.as_slices(), some, join).unwrap_or_default()
}

/// The size that so many exceed.
fn largest(sizes: &mut [f32], rank: usize) -> f32 {
    let rank = rank.min(sizes.len() - 1);
    *sizes.select_nth_unstable_by(rank, |a, b| b.total_cmp(a)).1
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

#[cfg(test)]
mod tests {
    use super::{RARE, usual_size};
    use crate::bsp::build::gather;
    use glam::Vec3;
    use heliostat_geometry::Aabb;

    #[test]
    fn usual_size_is_that_of_sorted_sizes() {
        let n = 5000_usize;
        // The last two mislead the sample, which looks at one in so many.
        let sizes: [&dyn Fn(usize) -> f32; 4] = [
            &|_| 2.0,
            &|i| (i * 7919 % n) as f32,
            &|i| if i % RARE == 0 { 1e6 + i as f32 } else { i as f32 },
            &|i| if i % RARE == 0 { 0.0 } else { i as f32 },
        ];
        for size in sizes {
            for n in [1, 2, RARE, RARE + 1, n] {
                let boxes: Vec<Aabb> =
                    (0..n).map(|i| Aabb { min: Vec3::ZERO, max: Vec3::splat(size(i)) }).collect();
                let mut sorted: Vec<f32> = (0..n).map(size).collect();
                sorted.sort_by(f32::total_cmp);
                let expected = sorted[n - 1 - (n - 1) / RARE];
                assert_eq!(usual_size(&gather(&boxes).unwrap().0), expected, "{n}");
            }
        }
    }
}
