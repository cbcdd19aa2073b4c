//! The witness: the BVH of the `obvhs` crate behind the same queries, asking the same closure.
//!
//! It was written by others on another principle, so an error shared with our tree is unlikely. It is no truth:
//! its slab test has no margin, and it takes the inverse of a direction no larger than 1 / `f32::EPSILON`, so
//! it misses small far boxes on rays along an axis. Boxes are therefore handed to it grown by the padding of a
//! ray that starts within some ten extents of the scene. Hits at negative distances it does not find.

use crate::bsp::BuildError;
use crate::bsp::build::gather;
use crate::bsp::visited::Visited;
use crate::primitives::Primitives;
use crate::query::{Found, Nearest, RayIndex};
use glam::{Vec3, Vec3A};
use heliostat_geometry::error_bound::{cell_padding, grow_slab};
use heliostat_geometry::{Aabb, Ray};
use obvhs::bvh2::Bvh2;
use obvhs::ray::RayHit;
use obvhs::{BvhBuildParams, bvh2::builder::build_bvh2};
use std::time::Duration;

/// An `obvhs` BVH2 over the boxes of primitives.
#[derive(Clone)]
pub struct ReferenceBvh {
    bvh: Bvh2,
    /// The primitive of each box.
    ids: Vec<u32>,
    unbounded: Vec<u32>,
}

impl std::fmt::Debug for ReferenceBvh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ReferenceBvh")
            .field("nodes", &self.bvh.nodes.len())
            .field("primitives", &self.ids.len())
            .field("unbounded", &self.unbounded.len())
            .finish()
    }
}

impl ReferenceBvh {
    /// Builds the BVH with the preset that `obvhs` calls medium.
    ///
    /// # Errors
    /// When a primitive has an empty or NaN box, or there are more than ids can name.
    pub fn build<P: Primitives + ?Sized>(primitives: &P) -> Result<Self, BuildError> {
        let (refs, unbounded) = gather(primitives)?;
        let refs = refs.into_vec();
        let around = refs.iter().fold(Aabb::EMPTY, |around, r| around.union(r.bounds()));
        let extent = if refs.is_empty() { 0.0 } else { around.min.abs().max(around.max.abs()).max_element() };
        let margin = Vec3::splat(cell_padding(12.0 * extent, extent));
        let boxes: Vec<obvhs::aabb::Aabb> = refs
            .iter()
            .map(|r| {
                let (min, max) = (r.bounds().min - margin, r.bounds().max + margin);
                obvhs::aabb::Aabb::new(Vec3A::from(min), Vec3A::from(max))
            })
            .collect();
        let bvh = if boxes.is_empty() {
            Bvh2::default()
        } else {
            let mut seconds = Duration::ZERO;
            build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut seconds)
        };
        Ok(Self { bvh, ids: refs.iter().map(|r| r.primitive()).collect(), unbounded })
    }

    /// Hands candidates to `test`, which answers up to which distance hits still matter; minus infinity ends
    /// the visit.
    fn visit(&self, ray: &Ray, mut test: impl FnMut(u32) -> f32) {
        // A unit direction, because the limits of the inverse there are absolute.
        let length = ray.dir.as_dvec3().length();
        let distance = |t: f32| grow_slab(0.0, ((f64::from(t) * length) as f32).next_up()).max;
        let query = obvhs::ray::Ray::new(
            Vec3A::from(ray.origin),
            Vec3A::from((ray.dir.as_dvec3() / length).as_vec3()),
            0.0,
            distance(ray.range.max),
        );
        let id = |slot: usize| self.ids[self.bvh.primitive_indices[slot] as usize];
        self.bvh.ray_traverse(query, &mut RayHit::none(), |_, slot| distance(test(id(slot))));
    }
}

impl RayIndex for ReferenceBvh {
    fn closest_hit<T>(
        &self,
        ray: &Ray,
        mut hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>,
    ) -> Option<Found<T>> {
        let mut nearest = Nearest::new(ray);
        for &primitive in &self.unbounded {
            nearest.test(primitive, &mut hit);
        }
        self.visit(ray, |primitive| {
            nearest.test(primitive, &mut hit);
            nearest.ray.range.max
        });
        nearest.found
    }

    fn any_hit(&self, ray: &Ray, mut hit: impl FnMut(u32, &Ray) -> bool) -> bool {
        let mut found = self.unbounded.iter().any(|&primitive| hit(primitive, ray));
        self.visit(ray, |primitive| {
            found = found || hit(primitive, ray);
            // Nothing lies before minus infinity: that ends the walk.
            if found { f32::NEG_INFINITY } else { f32::INFINITY }
        });
        found
    }

    fn for_each_hit(&self, ray: &Ray, mut visit: impl FnMut(u32)) {
        self.unbounded.iter().for_each(|&primitive| visit(primitive));
        let mut visited = Visited::new();
        self.visit(ray, |primitive| {
            if visited.insert(primitive) {
                visit(primitive);
            }
            f32::INFINITY
        });
    }
}
