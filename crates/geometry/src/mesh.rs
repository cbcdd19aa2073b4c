//! Indexed triangle meshes: plain arrays.

use crate::aabb::Aabb;
use glam::{Vec2, Vec3};

/// Triangles over shared vertices. Vertex arrays other than the positions are empty or of the same length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriMesh {
    /// Vertex positions in local space.
    pub positions: Vec<Vec3>,
    /// Unit shading normals per vertex; empty for a faceted mesh.
    pub normals: Vec<Vec3>,
    /// Texture coordinates per vertex, v up; may be empty.
    pub uvs: Vec<Vec2>,
    /// Linear Rec.709 colours per vertex; may be empty.
    pub colors: Vec<Vec3>,
    /// Corners of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Material slot of each triangle; empty when all are slot 0.
    pub slots: Vec<u16>,
}

impl TriMesh {
    /// The corners of triangle `i`.
    pub fn corners(&self, i: u32) -> [Vec3; 3] {
        self.triangles[i as usize].map(|v| self.positions[v as usize])
    }

    /// The material slot of triangle `i`.
    pub fn slot(&self, i: u32) -> u16 {
        self.slots.get(i as usize).copied().unwrap_or(0)
    }

    /// The box around all triangles.
    pub fn bounds(&self) -> Aabb {
        Aabb::of_points(self.triangles.iter().flatten().map(|&v| self.positions[v as usize]))
    }
}
