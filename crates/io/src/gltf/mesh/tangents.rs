//! Tangents for normal maps where the file has none, by the algorithm that glTF names: `MikkTSpace`.
//!
//! # Source
//! Khronos, "glTF 2.0 Specification", section 3.7.2.1; Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, through the
//! crate `bevy_mikktspace`. Coordinates grow upwards here, as the algorithm wants them.

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{Vec2, Vec4};
use heliostat_geometry::TriMesh;
use std::collections::HashMap;

/// A mesh while its tangents are worked out, one for each corner.
struct Corners<'a> {
    mesh: &'a TriMesh,
    uvs: &'a [Vec2],
    tangents: Vec<[Vec4; 3]>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.mesh.triangles[face][corner] as usize
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.positions[self.vertex(face, corner)].to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.normals[self.vertex(face, corner)].to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.uvs[self.vertex(face, corner)].to_array()
    }

    fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, corner: usize) {
        // Zero where there is none: such a corner keeps the direction of its coordinates.
        self.tangents[face][corner] =
            tangent.map_or(Vec4::new(0.0, 0.0, 0.0, 1.0), |t| Vec4::from(t.tangent_encoded()));
    }
}

/// Gives a mesh tangents along a set of its coordinates. Vertices whose corners disagree are split. A mesh without normals or those
/// coordinates stays as it is.
pub(super) fn add(mesh: &mut TriMesh, set: usize) {
    let uvs = if set == 1 && !mesh.uvs1.is_empty() { &mesh.uvs1 } else { &mesh.uvs };
    if mesh.normals.is_empty() || uvs.is_empty() {
        return;
    }
    let tangents = vec![[Vec4::ZERO; 3]; mesh.triangles.len()];
    let mut corners = Corners { mesh, uvs, tangents };
    if generate_tangents(&mut corners).is_ok() {
        let tangents = corners.tangents;
        give(mesh, &tangents);
    }
}

/// Puts the tangents of corners into vertices.
fn give(mesh: &mut TriMesh, corners: &[[Vec4; 3]]) {
    let mut own: Vec<Option<Vec4>> = vec![None; mesh.positions.len()];
    let mut split: HashMap<(u32, [u32; 4]), u32> = HashMap::new();
    // The vertices that new ones are copies of, and the tangents of these.
    let (mut sources, mut others) = (Vec::new(), Vec::new());
    let old = mesh.positions.len() as u32;
    for (triangle, tangents) in mesh.triangles.iter_mut().zip(corners) {
        for (vertex, tangent) in triangle.iter_mut().zip(tangents) {
            let first = own[*vertex as usize].get_or_insert(*tangent);
            if first == tangent {
                continue;
            }
            let source = *vertex;
            *vertex = *split.entry((source, tangent.to_array().map(f32::to_bits))).or_insert_with(|| {
                sources.push(source as usize);
                others.push(*tangent);
                old + sources.len() as u32 - 1
            });
        }
    }
    copy(&mut mesh.positions, &sources);
    copy(&mut mesh.normals, &sources);
    copy(&mut mesh.uvs, &sources);
    copy(&mut mesh.uvs1, &sources);
    copy(&mut mesh.colors, &sources);
    copy(&mut mesh.opacities, &sources);
    let unused = Vec4::new(0.0, 0.0, 0.0, 1.0);
    mesh.tangents = own.into_iter().map(|tangent| tangent.unwrap_or(unused)).chain(others).collect();
}

/// Appends copies of some values, unless there are none at all.
fn copy<T: Copy>(values: &mut Vec<T>, sources: &[usize]) {
    if !values.is_empty() {
        values.extend_from_within_each(sources);
    }
}

/// [`Vec::extend_from_within`] for places that are not in a row.
trait ExtendFromWithin {
    fn extend_from_within_each(&mut self, sources: &[usize]);
}

impl<T: Copy> ExtendFromWithin for Vec<T> {
    fn extend_from_within_each(&mut self, sources: &[usize]) {
        self.reserve(sources.len());
        for &source in sources {
            self.push(self[source]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// Two squares side by side in the plane z = 0; on the right one u runs backwards, as on a mirrored half.
    fn mirrored() -> TriMesh {
        let point = |x: u32, y: u32| Vec3::new(x as f32, y as f32, 0.0);
        let uv = |x: u32, y: u32| Vec2::new(if x == 1 { 1.0 } else { 0.0 }, y as f32);
        let places: Vec<_> = (0..2).flat_map(|y| (0..3).map(move |x| (x, y))).collect();
        TriMesh {
            positions: places.iter().map(|&(x, y)| point(x, y)).collect(),
            normals: vec![Vec3::Z; 6],
            uvs: places.iter().map(|&(x, y)| uv(x, y)).collect(),
            triangles: vec![[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]],
            ..TriMesh::default()
        }
    }

    #[test]
    fn tangents_run_along_u_and_mirrored_halves_are_split() {
        let mut mesh = mirrored();
        let before = mesh.clone();
        add(&mut mesh, 0);
        mesh.validate().expect("a sound mesh");
        assert_eq!(mesh.positions.len(), 8, "the two vertices of the seam are split");
        for (i, (triangle, old)) in mesh.triangles.iter().zip(&before.triangles).enumerate() {
            let (direction, side) = if i < 2 { (Vec3::X, 1.0) } else { (Vec3::NEG_X, -1.0) };
            for (&vertex, &old) in triangle.iter().zip(old) {
                let (new, old) = (vertex as usize, old as usize);
                let tangent = mesh.tangents[new];
                assert!(tangent.truncate().distance(direction) < 1e-6 && tangent.w == side, "{tangent}");
                // The bitangent goes up with v on both halves.
                assert!((tangent.w * mesh.normals[new].cross(tangent.truncate())).distance(Vec3::Y) < 1e-6);
                assert_eq!((mesh.positions[new], mesh.uvs[new]), (before.positions[old], before.uvs[old]));
            }
        }
    }

    #[test]
    fn meshes_without_coordinates_stay() {
        let mut mesh = TriMesh { uvs: Vec::new(), ..mirrored() };
        add(&mut mesh, 0);
        assert!(mesh.tangents.is_empty() && mesh.positions.len() == 6);
    }
}
