//! A block with a grid on each face, and spheres made from the icosahedron.

use super::obj::Mesh;
use glam::DVec3;
use std::collections::HashMap;

/// A closed block centred at the origin with `cells` squares along x, y and z, each cut into two triangles.
pub(super) fn block(cells: [usize; 3], size: [f64; 3]) -> Mesh {
    let mut mesh = Mesh::default();
    let mut seen = HashMap::new();
    // Each face: the axis that it is normal to, and whether it lies at the far end of it.
    for (axis, far) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut vertex = |i: usize, j: usize| {
            let mut at = [0; 3];
            at[axis] = if far { cells[axis] } else { 0 };
            at[u] = i;
            at[v] = j;
            *seen.entry(at).or_insert_with(|| {
                let p: [f64; 3] = std::array::from_fn(|a| size[a] * (at[a] as f64 / cells[a] as f64 - 0.5));
                mesh.positions.push(DVec3::from_array(p));
                mesh.positions.len() - 1
            })
        };
        let mut quads = Vec::new();
        for j in 0..cells[v] {
            for i in 0..cells[u] {
                quads.push([vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]);
            }
        }
        for [a, b, c, d] in quads {
            let pair = if far { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
            mesh.triangles.extend(pair);
        }
    }
    mesh
}

/// A unit sphere of `20 * 4^levels` triangles: each level cuts every triangle into four.
pub(super) fn icosphere(levels: u32) -> Mesh {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut mesh = Mesh { positions: Vec::new(), triangles: icosahedron_faces() };
    for axis in 0..3 {
        for (one, phi) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
            let mut p = [0.0; 3];
            p[axis] = 0.0;
            p[(axis + 1) % 3] = one;
            p[(axis + 2) % 3] = phi;
            mesh.positions.push(DVec3::from_array(p).normalize());
        }
    }
    for _ in 0..levels {
        subdivide(&mut mesh);
    }
    mesh
}

/// The 20 faces: all triples of corners that are one edge apart, turned to the outside.
fn icosahedron_faces() -> Vec<[usize; 3]> {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let corner = |i: usize| {
        let mut p = [0.0; 3];
        p[(i / 4 + 1) % 3] = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        p[(i / 4 + 2) % 3] = if i % 4 < 2 { golden } else { -golden };
        DVec3::from_array(p)
    };
    let touching = |a: usize, b: usize| (corner(a).distance(corner(b)) - 2.0).abs() < 0.1;
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if touching(a, b) && touching(b, c) && touching(c, a) {
                    let outward = (corner(b) - corner(a)).cross(corner(c) - corner(a)).dot(corner(a)) > 0.0;
                    faces.push(if outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    faces
}

/// Cuts every triangle into four, the new corners on the sphere.
fn subdivide(mesh: &mut Mesh) {
    let mut middles = HashMap::new();
    let mut middle = |positions: &mut Vec<DVec3>, a: usize, b: usize| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            positions.push((positions[a] + positions[b]).normalize());
            positions.len() - 1
        })
    };
    let mut finer = Vec::with_capacity(4 * mesh.triangles.len());
    for &[a, b, c] in &mesh.triangles {
        let ab = middle(&mut mesh.positions, a, b);
        let bc = middle(&mut mesh.positions, b, c);
        let ca = middle(&mut mesh.positions, c, a);
        finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    mesh.triangles = finer;
}

/// A right prism of unit height on `y = 0` whose base is a right isosceles triangle with legs of length 1, the long
/// side towards `+z`: the glass that turns a picture around by total internal reflection.
pub(super) fn prism() -> Mesh {
    let half = 0.5_f64.sqrt();
    let base = [(-half, 0.25), (half, 0.25), (0.0, 0.25 - half)];
    let positions = [0.0, 1.0].into_iter().flat_map(|y| base.map(|(x, z)| DVec3::new(x, y, z))).collect();
    let mut triangles = vec![[0, 2, 1], [3, 4, 5]];
    for i in 0..3 {
        let j = (i + 1) % 3;
        triangles.extend([[i, j, j + 3], [i, j + 3, i + 3]]);
    }
    Mesh { positions, triangles }
}
