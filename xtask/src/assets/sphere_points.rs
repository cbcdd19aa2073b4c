//! An even triangulation of the sphere with any number of vertices: Fibonacci points, joined by Delaunay.

use super::obj::Mesh;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The unit sphere with `count >= 4` vertices and `2 * count - 4` triangles.
///
/// Seen from the last point, a stereographic projection takes circles to circles, so the plane's Delaunay
/// triangulation is the sphere's; the hull of the plane is closed by the point that was projected from.
pub(super) fn sphere(count: usize) -> Mesh {
    let positions: Vec<DVec3> = (0..count).map(|i| fibonacci(i, count)).collect();
    let centre = positions[count - 1];
    let frame = centre.any_orthonormal_pair();
    let flat: Vec<delaunator::Point> = positions[..count - 1]
        .iter()
        .map(|p| {
            let scale = 1.0 / (1.0 - p.dot(centre));
            let at = DVec2::new(p.dot(frame.0), p.dot(frame.1)) * scale;
            delaunator::Point { x: at.x, y: at.y }
        })
        .collect();
    let plane = delaunator::triangulate(&flat);
    let mut triangles: Vec<[usize; 3]> =
        plane.triangles.chunks_exact(3).map(|t| outward(&positions, [t[0], t[1], t[2]])).collect();
    let hull = &plane.hull;
    for (i, &a) in hull.iter().enumerate() {
        triangles.push(outward(&positions, [a, hull[(i + 1) % hull.len()], count - 1]));
    }
    Mesh { positions, triangles }
}

/// Point `i` of `count` on the Fibonacci spiral.
fn fibonacci(i: usize, count: usize) -> DVec3 {
    let y = 1.0 - (2 * i + 1) as f64 / count as f64;
    let angle = TAU * ((i as f64) * (5.0_f64.sqrt() - 1.0) / 2.0).fract();
    let ring = (PI / 2.0 - y.asin()).sin();
    DVec3::new(ring * angle.cos(), y, ring * angle.sin())
}

/// The corners in the order that faces away from the centre of the sphere.
fn outward(positions: &[DVec3], [a, b, c]: [usize; 3]) -> [usize; 3] {
    let (pa, pb, pc) = (positions[a], positions[b], positions[c]);
    if (pb - pa).cross(pc - pa).dot(pa) >= 0.0 { [a, b, c] } else { [a, c, b] }
}
