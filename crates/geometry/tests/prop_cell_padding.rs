//! The bounds on which search structures rest.

use glam::Vec3;
use heliostat_geometry::error_bound::{cell_padding, inverse_direction};
use heliostat_geometry::strategies::{mesh, ray_at_mesh};
use heliostat_geometry::triangle::{TriangleRay, intersect};
use heliostat_geometry::{Aabb, Ray, TriMesh};
use proptest::prelude::*;

fn config() -> ProptestConfig {
    ProptestConfig { failure_persistence: None, ..ProptestConfig::default() }
}

fn mesh_and_rays() -> impl Strategy<Value = (TriMesh, Vec<Ray>)> {
    mesh(12).prop_flat_map(|mesh| {
        let rays = prop::collection::vec(ray_at_mesh(&mesh), 8);
        (Just(mesh), rays)
    })
}

proptest! {
    #![proptest_config(config())]

    // Where a ray is when it meets a triangle, it is in the box of that triangle, give or take the padding: also on
    // triangles seen edge on.
    #[test]
    fn hits_lie_in_the_padded_box((mesh, rays) in mesh_and_rays()) {
        for ray in &rays {
            let sheared = TriangleRay::new(ray);
            for i in 0..mesh.triangles.len() as u32 {
                let corners = mesh.corners(i);
                let Some(hit) = intersect(&sheared, ray.range, corners) else { continue };
                let bounds = Aabb::of_points(corners);
                let p = ray.origin.as_dvec3() + f64::from(hit.t) * ray.dir.as_dvec3();
                let distance = hit.t * ray.dir.abs().max_element();
                let padding = f64::from(cell_padding(distance, bounds.size().max_element()));
                let outside = (bounds.min.as_dvec3() - p).max(p - bounds.max.as_dvec3()).max_element();
                prop_assert!(outside <= padding, "{} outside, {} allowed: {:?} {:?}", outside, padding, ray, corners);
            }
        }
    }
}

#[test]
fn inverse_directions_are_numbers_with_the_right_sign() {
    for scale in [1.0_f32, 1e-10, 1e10] {
        let inverse = inverse_direction((scale * Vec3::new(0.0, -0.0, -4.0)).into());
        assert!(inverse.is_finite(), "{inverse}");
        assert!(inverse.x > 0.0 && inverse.y < 0.0);
        assert_eq!(inverse.z, 1.0 / (-4.0 * scale));
        // Over a thousand units of way along z, less than the rounding of any coordinate near 1.
        assert!(1000.0 / inverse.x.abs() < f32::EPSILON * scale);
    }
}
