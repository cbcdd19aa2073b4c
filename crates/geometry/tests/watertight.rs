//! Closed meshes leak no ray: not at vertices, not at edges, not at any scale or distance from the origin.

use glam::Vec3;
use heliostat_geometry::strategies::{Random, box_grid, displaced_sphere, icosphere, torus_mesh};
use heliostat_geometry::triangle::{TriangleRay, intersect};
use heliostat_geometry::{Interval, Ray, TriMesh};

/// The nearest hit by trying every triangle.
fn nearest(mesh: &TriMesh, ray: &Ray) -> Option<(u32, f32)> {
    let mut range = ray.range;
    let ray = TriangleRay::new(ray);
    let mut best = None;
    for triangle in 0..mesh.triangles.len() as u32 {
        if let Some(hit) = intersect(&ray, range, mesh.corners(triangle)) {
            range = Interval { max: hit.t, ..range };
            best = Some((triangle, hit.t));
        }
    }
    best
}

fn moved(mut mesh: TriMesh, scale: f32, offset: Vec3) -> TriMesh {
    for p in &mut mesh.positions {
        *p = scale * (*p + offset);
    }
    mesh
}

/// Star-shaped meshes and a point that sees them from inside, which offsets must not round onto the surface.
fn closed_meshes() -> Vec<TriMesh> {
    vec![icosphere(2), displaced_sphere(2, 0.3, 1), displaced_sphere(1, 0.6, 2), box_grid(5)]
}

#[test]
fn rays_from_inside_at_vertices_and_edges_are_stopped() {
    let mut random = Random::new(50);
    let mut rays = 0;
    for base in closed_meshes() {
        for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            for offset in [Vec3::ZERO, Vec3::new(7.0, -3.0, 11.0), 1e3 * Vec3::new(-1.4, 0.1, 2.2)] {
                let mesh = moved(base.clone(), scale, offset);
                for triangle in 0..mesh.triangles.len() as u32 {
                    let [a, b, _] = mesh.corners(triangle);
                    let inside = scale * (offset + 0.2 * random.cube());
                    for target in [a, a.lerp(b, random.unit()), 0.5 * (a + b)] {
                        let ray = Ray::new(inside, target - inside);
                        rays += 1;
                        assert!(nearest(&mesh, &ray).is_some(), "{ray:?} leaves {scale} {offset}");
                    }
                }
            }
        }
    }
    assert!(rays > 30_000, "{rays}");
}

/// Embree's test of the same name: a sphere far from the origin, rays in all directions.
#[test]
fn rays_from_inside_a_far_sphere_are_stopped() {
    let mut random = Random::new(51);
    let offset = Vec3::new(148_376.0, 1_234.0, -223_423.0);
    let mesh = moved(icosphere(3), 1.0, offset);
    for _ in 0..2_000 {
        let ray = Ray::new(offset + 0.5 * random.cube(), random.direction());
        assert!(nearest(&mesh, &ray).is_some(), "{ray:?}");
    }
}

/// Rays along the axes and through the lattice of a box of grids run along edges and in the planes of faces.
#[test]
fn axis_parallel_rays_in_a_box_of_grids_are_stopped() {
    for cells in [1, 2, 3, 8] {
        let mesh = box_grid(cells);
        for i in 0..=16 {
            for j in 0..=16 {
                // The lattice of 8 cells and the middles between, borders included.
                let at = |k: i32| (k as f32 - 8.0) / 8.0;
                for axis in 0..3 {
                    let mut origin = Vec3::ZERO;
                    origin[(axis + 1) % 3] = at(i);
                    origin[(axis + 2) % 3] = at(j);
                    for sign in [1.0, -1.0] {
                        let mut dir = Vec3::ZERO;
                        dir[axis] = sign;
                        let found = nearest(&mesh, &Ray::new(origin, dir));
                        assert_eq!(found.map(|hit| hit.1), Some(1.0), "{cells} cells, {origin} along {dir}");
                    }
                }
            }
        }
    }
}

/// A ray that leaves a closed mesh has crossed it an even number of times, whether it grazes or not.
#[test]
fn rays_from_outside_that_enter_also_leave() {
    let mut random = Random::new(52);
    let mesh = torus_mesh(1.0, 0.4, 24, 12);
    let mut entered = 0;
    for _ in 0..5_000 {
        let origin = 3.0 * random.direction();
        let ray = Ray::new(origin, 1.2 * random.cube() - origin);
        let Some((triangle, t)) = nearest(&mesh, &ray) else { continue };
        // Where the mesh is entered its normal looks back.
        let [a, b, c] = mesh.corners(triangle).map(|p| p.as_dvec3());
        assert!((b - a).cross(c - a).dot(ray.dir.as_dvec3()) < 0.0, "{ray:?} enters from inside");
        entered += 1;
        let behind = Ray { range: Interval { min: t.next_up(), max: f32::INFINITY }, ..ray };
        assert!(nearest(&mesh, &behind).is_some(), "{ray:?} never leaves");
    }
    assert!(entered > 1_000);
}

/// Meshes from the generators are closed: each edge is used once in each direction.
#[test]
fn generated_meshes_are_closed_and_outward() {
    for mesh in closed_meshes().into_iter().chain([torus_mesh(1.0, 0.3, 7, 5)]) {
        mesh.validate().unwrap();
        let mut edges = std::collections::HashMap::new();
        for t in &mesh.triangles {
            for k in 0..3 {
                *edges.entry((t[k], t[(k + 1) % 3])).or_insert(0) += 1;
            }
        }
        for (&(a, b), &count) in &edges {
            assert_eq!((count, edges.get(&(b, a))), (1, Some(&1)));
        }
        // The volume under the triangles is positive when they face outward.
        let volume: f32 = (0..mesh.triangles.len() as u32)
            .map(|i| {
                let [a, b, c] = mesh.corners(i);
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        assert!(volume > 0.1, "{volume}");
    }
    assert_eq!(icosphere(3).triangles.len(), 20 * 64);
    assert_eq!(box_grid(4).positions.len(), 6 * 16 + 2);
}
