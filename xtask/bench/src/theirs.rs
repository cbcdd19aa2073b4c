//! The BVHs of `obvhs`, as its own documentation would have them used: triangles in the order of the leaves.

use crate::contestant::{Contestant, Query};
use glam::Vec3A;
use heliostat_geometry::{Ray, TriMesh};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray as TheirRay, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;
use std::time::{Duration, Instant};

/// Their structures.
enum Bvh {
    Two(Bvh2),
    Eight(CwBvh),
}

/// One structure by one preset.
pub(crate) struct Obvhs {
    name: String,
    bvh: Bvh,
    triangles: Vec<RtTriangle>,
    build_seconds: f64,
}

/// Their presets that are compared.
pub(crate) const PRESETS: [&str; 3] = ["fast", "medium", "very_slow"];

impl Obvhs {
    /// Builds the eight-wide or the binary structure.
    pub(crate) fn build(mesh: &TriMesh, eight: bool, preset: &str) -> Self {
        let params = match preset {
            "fast" => BvhBuildParams::fast_build(),
            "medium" => BvhBuildParams::medium_build(),
            _ => BvhBuildParams::very_slow_build(),
        };
        let corners = |i: u32| mesh.corners(i).map(Vec3A::from);
        let triangles: Vec<Triangle> = (0..mesh.triangles.len() as u32)
            .map(|i| {
                let [v0, v1, v2] = corners(i);
                Triangle { v0, v1, v2 }
            })
            .collect();
        let mut unused = Duration::ZERO;
        let begin = Instant::now();
        let bvh = if eight {
            Bvh::Eight(build_cwbvh_from_tris(&triangles, params, &mut unused))
        } else {
            Bvh::Two(build_bvh2_from_tris(&triangles, params, &mut unused))
        };
        let build_seconds = begin.elapsed().as_secs_f64();
        let order = match &bvh {
            Bvh::Two(bvh) => &bvh.primitive_indices,
            Bvh::Eight(bvh) => &bvh.primitive_indices,
        };
        let triangles = order.iter().map(|&i| RtTriangle::from(&triangles[i as usize])).collect();
        let name = format!("obvhs {} {preset}", if eight { "CWBVH" } else { "BVH2" });
        Self { name, bvh, triangles, build_seconds }
    }
}

impl Contestant for Obvhs {
    fn name(&self) -> &str {
        &self.name
    }

    fn build_seconds(&self) -> f64 {
        self.build_seconds
    }

    fn trace(&self, query: Query, rays: &[Ray], distances: &mut [f32]) {
        for (ray, distance) in rays.iter().zip(distances) {
            let query_ray = TheirRay::new(ray.origin.into(), ray.dir.into(), ray.range.min, ray.range.max);
            let test = |ray: &TheirRay, i: usize| self.triangles[i].intersect(ray);
            let mut hit = RayHit::none();
            let found = match (query, &self.bvh) {
                (Query::Closest, Bvh::Two(bvh)) => bvh.ray_traverse(query_ray, &mut hit, test),
                (Query::Closest, Bvh::Eight(bvh)) => bvh.ray_traverse(query_ray, &mut hit, test),
                (Query::Any, Bvh::Two(bvh)) => !bvh.ray_traverse_miss(query_ray, test),
                (Query::Any, Bvh::Eight(bvh)) => !bvh.ray_traverse_miss(query_ray, test),
            };
            *distance = match query {
                _ if !found => f32::INFINITY,
                Query::Closest => hit.t,
                Query::Any => 0.0,
            };
        }
    }
}
