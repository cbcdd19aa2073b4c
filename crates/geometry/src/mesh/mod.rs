//! Indexed triangle meshes: plain arrays, and what can be said of one triangle.
//!
//! Search structures over the triangles are the business of the index crate.

mod normals;
mod surface;
mod validate;

pub use validate::MeshError;

use crate::aabb::Aabb;
use glam::{DVec3, Vec2, Vec3, Vec4};

/// Triangles over shared vertices. Vertex arrays other than the positions are empty or of the same length.
///
/// ```
/// use glam::Vec3;
/// use heliostat_geometry::TriMesh;
///
/// let mesh = TriMesh {
///     positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
///     triangles: vec![[0, 1, 2]],
///     ..TriMesh::default()
/// };
/// assert!(mesh.validate().is_ok());
/// assert_eq!(mesh.area(0), 0.5);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriMesh {
    /// Vertex positions in local space.
    pub positions: Vec<Vec3>,
    /// Unit shading normals per vertex; empty for a faceted mesh.
    pub normals: Vec<Vec3>,
    /// Texture coordinates per vertex, v up; may be empty.
    pub uvs: Vec<Vec2>,
    /// A second set of texture coordinates per vertex; may be empty.
    pub uvs1: Vec<Vec2>,
    /// Unit tangents per vertex along which normal maps were made, and in `w` which way the bitangent
    /// `w * normal x tangent` goes, 1 or -1; may be empty.
    pub tangents: Vec<Vec4>,
    /// Coverage in `[0, 1]` per vertex; may be empty.
    pub opacities: Vec<f32>,
    /// Linear Rec.709 colours per vertex; may be empty.
    pub colors: Vec<Vec3>,
    /// Corners of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Material slot of each triangle; empty when all are slot 0.
    pub slots: Vec<u16>,
}

impl TriMesh {
    /// The corners of triangle `i`.
    #[inline]
    pub fn corners(&self, i: u32) -> [Vec3; 3] {
        self.triangles[i as usize].map(|v| self.positions[v as usize])
    }

    /// The material slot of triangle `i`.
    #[inline]
    pub fn slot(&self, i: u32) -> u16 {
        self.slots.get(i as usize).copied().unwrap_or(0)
    }

    /// The box around all triangles.
    pub fn bounds(&self) -> Aabb {
        Aabb::of_points(self.triangles.iter().flatten().map(|&v| self.positions[v as usize]))
    }

    /// The area of a triangle, in `f64`.
    pub fn area(&self, triangle: u32) -> f64 {
        0.5 * self.winding_normal(triangle).length()
    }

    /// The normal of a triangle by its winding; its length is twice the area.
    fn winding_normal(&self, triangle: u32) -> DVec3 {
        let [a, b, c] = self.corners(triangle).map(|p| p.as_dvec3());
        (b - a).cross(c - a)
    }
}
