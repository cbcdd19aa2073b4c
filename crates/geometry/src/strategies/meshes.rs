//! Meshes: loose soups of bad triangles, and closed surfaces.

use super::generate::{box_grid, displaced_sphere, icosphere, torus_mesh};
use super::numbers::{point, scale};
use super::triangles::triangle;
use crate::mesh::TriMesh;
use glam::Vec3;
use proptest::collection::vec;
use proptest::prelude::*;

/// Up to `count` triangles of every kind with no order between them; some touch, repeat, or nest in each other.
pub fn soup(count: usize) -> impl Strategy<Value = TriMesh> {
    let relation = 0_u8..8;
    vec((triangle(), relation, point()), 1..=count.max(1)).prop_map(|parts| {
        let mut triangles: Vec<[Vec3; 3]> = Vec::with_capacity(parts.len());
        for (own, relation, at) in parts {
            let last = triangles.last().copied();
            triangles.push(match (relation, last) {
                // The same again.
                (0, Some(last)) => last,
                // Touching: shares an edge.
                (1, Some(last)) => [last[1], last[0], at],
                // Touching: shares a corner.
                (2, Some(last)) => [last[2], own[1], own[2]],
                // Nested: the same shape, shrunk towards its middle.
                (3, Some(last)) => {
                    let middle = (last[0] + last[1] + last[2]) / 3.0;
                    last.map(|corner| middle.lerp(corner, 0.5))
                }
                // Coplanar, beside it.
                (4, Some(last)) => last.map(|corner| corner + (last[1] - last[0])),
                _ => own,
            });
        }
        from_triangles(&triangles)
    })
}

/// A closed surface without holes: icosphere, displaced sphere, torus or box of grids; scaled and moved.
pub fn closed_mesh() -> impl Strategy<Value = TriMesh> {
    let base = prop_oneof![
        (0_u32..4).prop_map(icosphere),
        (0_u32..4, 0.0_f32..0.4, any::<u64>())
            .prop_map(|(level, depth, seed)| displaced_sphere(level, depth, seed)),
        (3_u32..24, 3_u32..16, 0.05_f32..0.9)
            .prop_map(|(around, tube, minor)| torus_mesh(1.0, minor, around, tube)),
        (1_u32..6).prop_map(box_grid),
    ];
    (base, scale(), point(), 0_u8..4).prop_map(|(mut mesh, scale, offset, keep)| {
        if keep > 0 {
            for p in &mut mesh.positions {
                *p = scale * (*p + offset);
            }
        }
        mesh
    })
}

/// Either a soup of up to `count` triangles or a closed surface.
pub fn mesh(count: usize) -> impl Strategy<Value = TriMesh> {
    prop_oneof![2 => soup(count), 1 => closed_mesh()]
}

/// A mesh in which no triangle shares a vertex.
fn from_triangles(triangles: &[[Vec3; 3]]) -> TriMesh {
    TriMesh {
        positions: triangles.iter().flatten().copied().collect(),
        triangles: (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..TriMesh::default()
    }
}
