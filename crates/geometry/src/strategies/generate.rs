//! Deterministic meshes with known answers: closed, outward, without gaps.

use super::random::Random;
use crate::mesh::TriMesh;
use glam::{Vec2, Vec3};
use std::collections::HashMap;
use std::f32::consts::TAU;

/// The unit sphere of `20 * 4^level` triangles, with exact normals.
pub fn icosphere(level: u32) -> TriMesh {
    let golden = 0.5 * (1.0 + 5.0_f32.sqrt());
    let mut positions: Vec<Vec3> = Vec::new();
    for (a, b) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        positions.extend([Vec3::new(a, b, 0.0), Vec3::new(0.0, a, b), Vec3::new(b, 0.0, a)]);
    }
    let mut positions: Vec<Vec3> = positions.into_iter().map(Vec3::normalize).collect();
    let mut triangles = hull_of_icosahedron(&positions);
    for _ in 0..level {
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize());
                positions.len() as u32 - 1
            })
        };
        let parts = triangles.iter().flat_map(|&[a, b, c]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        });
        triangles = parts.collect();
    }
    TriMesh { normals: positions.clone(), positions, triangles, ..TriMesh::default() }
}

/// The 20 triples of icosahedron corners that are all neighbours, turned outward.
fn hull_of_icosahedron(corners: &[Vec3]) -> Vec<[u32; 3]> {
    // Neighbours have cosine 1 / sqrt 5, all others -1 / sqrt 5 or -1.
    let near = |a: usize, b: usize| corners[a].dot(corners[b]) > 0.0;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let outward = corners[a].dot(corners[b].cross(corners[c])) > 0.0;
                    let (b, c) = if outward { (b, c) } else { (c, b) };
                    triangles.push([a as u32, b as u32, c as u32]);
                }
            }
        }
    }
    triangles
}

/// An icosphere whose vertices are pulled in by up to `depth` of the radius; closed, star-shaped, not convex.
pub fn displaced_sphere(level: u32, depth: f32, seed: u64) -> TriMesh {
    let mut random = Random::new(seed);
    let mut mesh = icosphere(level);
    mesh.normals.clear();
    for p in &mut mesh.positions {
        *p *= 1.0 - depth * random.unit();
    }
    mesh
}

/// The square `[-1, 1]^2` in the plane `y = 0` in `cells * cells` cells of two triangles, with `+y` outside and uvs.
pub fn grid(cells: u32) -> TriMesh {
    let cells = cells.max(1);
    // Exactly symmetric, so that the faces of a box meet.
    let place = |k: u32| (2.0 * k as f32 - cells as f32) / cells as f32;
    let mut mesh = TriMesh::default();
    for row in 0..=cells {
        for column in 0..=cells {
            mesh.positions.push(Vec3::new(place(column), 0.0, -place(row)));
            mesh.normals.push(Vec3::Y);
            mesh.uvs.push(Vec2::new(column as f32, row as f32) / cells as f32);
        }
    }
    add_quads(&mut mesh.triangles, cells, cells, |row, column| row * (cells + 1) + column);
    mesh
}

/// Two triangles per cell of `rows * columns`, outward when rows grow along v and columns along u.
fn add_quads(triangles: &mut Vec<[u32; 3]>, rows: u32, columns: u32, index: impl Fn(u32, u32) -> u32) {
    for row in 0..rows {
        for column in 0..columns {
            let (a, b) = (index(row, column), index(row, column + 1));
            let (c, d) = (index(row + 1, column), index(row + 1, column + 1));
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
}

/// The surface of the cube `[-1, 1]^3`, each face in `cells * cells` cells; faces share their border vertices.
pub fn box_grid(cells: u32) -> TriMesh {
    let cells = cells.max(1);
    let face = grid(cells);
    let mut mesh = TriMesh::default();
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    for turn in FACES {
        let ids: Vec<u32> = face
            .positions
            .iter()
            .map(|p| {
                let p = turn(*p + Vec3::Y) + Vec3::ZERO;
                *known.entry(p.to_array().map(f32::to_bits)).or_insert_with(|| {
                    mesh.positions.push(p);
                    mesh.positions.len() as u32 - 1
                })
            })
            .collect();
        mesh.triangles.extend(face.triangles.iter().map(|t| t.map(|v| ids[v as usize])));
    }
    mesh
}

/// Rotations that bring the face `+y` to each face of a cube.
const FACES: [fn(Vec3) -> Vec3; 6] = [
    |p| p,
    |p| Vec3::new(p.x, -p.y, -p.z),
    |p| Vec3::new(p.y, p.z, p.x),
    |p| Vec3::new(-p.y, p.z, -p.x),
    |p| Vec3::new(p.z, p.x, p.y),
    |p| Vec3::new(-p.z, p.x, -p.y),
];

/// A closed torus around the y axis, `around * tube` cells of two triangles, with exact normals.
pub fn torus_mesh(major: f32, minor: f32, around: u32, tube: u32) -> TriMesh {
    let (around, tube) = (around.max(3), tube.max(3));
    let mut mesh = TriMesh::default();
    for row in 0..tube {
        let (up, out) = (TAU * row as f32 / tube as f32).sin_cos();
        for column in 0..around {
            let (sin, cos) = (TAU * column as f32 / around as f32).sin_cos();
            mesh.normals.push(Vec3::new(out * sin, up, out * cos));
            let distance = major + minor * out;
            mesh.positions.push(Vec3::new(distance * sin, minor * up, distance * cos));
        }
    }
    add_quads(&mut mesh.triangles, tube, around, |row, column| (row % tube) * around + column % around);
    mesh
}
