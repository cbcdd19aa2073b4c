//! The surface of a mesh around a point of a triangle.

use super::TriMesh;
use crate::error_bound::triangle_point;
use crate::shape::{AreaSample, LocalHit};
use crate::triangle::TriangleHit;
use crate::warp::square_to_triangle;
use glam::{DVec3, Vec2, Vec3, Vec4};

impl TriMesh {
    /// The surface at a hit: position, normals, texture coordinates and their tangents.
    ///
    /// Tangents of the mesh give the directions of those of the texture coordinates, which keep their lengths: relief was made
    /// along them.
    ///
    /// Without texture coordinates `u` and `v` are the weights of the second and the third corner. Without vertex
    /// normals the shading normal is zero, which means "as the geometric normal". Where the texture coordinates
    /// of the triangle have no area the tangents are zero.
    pub fn surface(&self, triangle: u32, hit: &TriangleHit) -> LocalHit {
        let vertices = self.triangles[triangle as usize].map(|v| v as usize);
        let corners = self.corners(triangle);
        let [a, b, c] = corners.map(|p| p.as_dvec3());
        let (to_b, to_c) = (b - a, c - a);
        let [_, wb, wc] = hit.barycentric.map(f64::from);

        // From one corner along the edges: three weights that do not add up to 1 would leave the plane.
        let p = a + wb * to_b + wc * to_c;

        let ns = match self.normals.as_slice() {
            [] => DVec3::ZERO,
            normals => blend(vertices.map(|v| normals[v]), hit.barycentric).as_dvec3(),
        };
        let (uv, dpdu, dpdv) = match self.uvs.as_slice() {
            [] => (Vec2::new(hit.barycentric[1], hit.barycentric[2]), to_b.as_vec3(), to_c.as_vec3()),
            uvs => texture_frame(vertices.map(|v| uvs[v]), hit.barycentric, to_b, to_c),
        };
        let (dpdu, dpdv) = match self.tangents.as_slice() {
            [] => (dpdu, dpdv),
            tangents => {
                let ns = if ns == DVec3::ZERO { to_b.cross(to_c) } else { ns };
                along(vertices.map(|v| tangents[v]), hit.barycentric, ns.as_vec3(), [dpdu, dpdv])
            }
        };
        LocalHit {
            t: f64::from(hit.t),
            p,
            p_err: triangle_point(corners),
            ng: to_b.cross(to_c),
            ns,
            uv,
            dpdu,
            dpdv,
        }
    }

    /// The colour between the vertex colours at a hit; `None` when the mesh has no colours.
    pub fn color(&self, triangle: u32, hit: &TriangleHit) -> Option<Vec3> {
        let vertices = self.triangles[triangle as usize];
        (!self.colors.is_empty()).then(|| blend(vertices.map(|v| self.colors[v as usize]), hit.barycentric))
    }

    /// The second texture coordinates at a hit; `None` when the mesh has one set of them or none.
    pub fn second_uv(&self, triangle: u32, hit: &TriangleHit) -> Option<Vec2> {
        let [a, b, c] = self.triangles[triangle as usize].map(|v| self.uvs1.get(v as usize));
        let [wa, wb, wc] = hit.barycentric;
        Some(wa * *a? + wb * *b? + wc * *c?)
    }

    /// The coverage between those of the vertices at a hit; 1 when the mesh has none.
    pub fn opacity(&self, triangle: u32, hit: &TriangleHit) -> f32 {
        if self.opacities.is_empty() {
            return 1.0;
        }
        let corners = self.triangles[triangle as usize].map(|v| self.opacities[v as usize]);
        corners.into_iter().zip(hit.barycentric).map(|(opacity, weight)| weight * opacity).sum()
    }

    /// A point uniform by area on one triangle, from `u` in `[0, 1)^2`; pdf infinite when it has no area.
    pub fn sample_triangle(&self, triangle: u32, u: Vec2) -> AreaSample {
        self.sample_at(triangle, &TriangleHit { t: 0.0, barycentric: square_to_triangle(u) })
    }

    /// [`TriMesh::sample_triangle`] at a given point of the triangle.
    pub fn sample_at(&self, triangle: u32, hit: &TriangleHit) -> AreaSample {
        let surface = self.surface(triangle, hit);
        AreaSample {
            p: surface.p,
            p_err: surface.p_err,
            ng: surface.ng.normalize_or_zero(),
            uv: surface.uv,
            pdf: 1.0 / self.area(triangle),
        }
    }
}

/// The mean of three values by barycentric weights.
fn blend(values: [Vec3; 3], weights: [f32; 3]) -> Vec3 {
    weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]
}

/// The tangents `along` the texture coordinates, turned to the interpolated tangent and its bitangent.
fn along(tangents: [Vec4; 3], weights: [f32; 3], ns: Vec3, along: [Vec3; 2]) -> (Vec3, Vec3) {
    let tangent = blend(tangents.map(Vec4::truncate), weights);
    let [length, width] = along.map(|v| if v == Vec3::ZERO { 1.0 } else { v.length() });
    // All corners of a triangle have the same hand.
    let bitangent = tangents[0].w * ns.cross(tangent);
    (length * tangent.normalize_or_zero(), width * bitangent.normalize_or_zero())
}

/// Texture coordinates and the tangents along them: the linear map from `uv` to positions, solved in `f64`.
fn texture_frame(uvs: [Vec2; 3], weights: [f32; 3], to_b: DVec3, to_c: DVec3) -> (Vec2, Vec3, Vec3) {
    let uv = weights[0] * uvs[0] + weights[1] * uvs[1] + weights[2] * uvs[2];
    let [a, b, c] = uvs.map(|p| p.as_dvec2());
    let (uv_b, uv_c) = (b - a, c - a);
    let determinant = uv_b.perp_dot(uv_c);
    if determinant == 0.0 {
        return (uv, Vec3::ZERO, Vec3::ZERO);
    }
    let dpdu = (uv_c.y * to_b - uv_b.y * to_c) / determinant;
    let dpdv = (uv_b.x * to_c - uv_c.x * to_b) / determinant;
    (uv, dpdu.as_vec3(), dpdv.as_vec3())
}
