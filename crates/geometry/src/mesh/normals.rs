//! Vertex normals for meshes that come without: smooth across shallow edges, sharp across steep ones.

use super::TriMesh;
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// For the first vertex at each position, the triangles around it with their angles there.
type Fans = HashMap<u32, Vec<(u32, f64)>>;

impl TriMesh {
    /// Makes shading normals: smooth between triangles whose normals differ by at most `max_angle` radians around
    /// the vertex they share, sharp elsewhere. Vertices at sharp edges are split.
    ///
    /// Vertices of equal position count as one, so seams of texture coordinates stay smooth. Each triangle weighs
    /// in with its area times its angle at the vertex, so that neither slivers nor the way a polygon was cut
    /// into triangles bend the normal. Old normals are dropped. Triangles without area take part in nothing and
    /// receive the mean of their neighbours.
    pub fn compute_normals(&mut self, max_angle: f32) {
        let faces: Vec<DVec3> = (0..self.triangles.len() as u32).map(|i| self.winding_normal(i)).collect();
        let units: Vec<DVec3> = faces.iter().map(|n| n.normalize_or_zero()).collect();
        let cos_max = f64::from(max_angle).cos();
        let (first, around) = self.corners_by_position();

        // The normal of every corner: the mean of the triangles around its position that are not too steep.
        let mut corner_normals = Vec::with_capacity(3 * self.triangles.len());
        for (triangle, corners) in self.triangles.iter().enumerate() {
            let own = units[triangle];
            for &vertex in corners {
                let sum: DVec3 = around[&first[vertex as usize]]
                    .iter()
                    .filter(|&&(other, _)| {
                        own == DVec3::ZERO
                            || other as usize == triangle
                            || own.dot(units[other as usize]) >= cos_max
                    })
                    .map(|&(other, angle)| angle * faces[other as usize])
                    .sum();
                corner_normals.push(sum.try_normalize().unwrap_or(own).as_vec3());
            }
        }
        self.split_vertices(&corner_normals);
    }

    /// For each vertex the first one at its position, and for each such first vertex its triangles with their
    /// angles there.
    fn corners_by_position(&self) -> (Vec<u32>, Fans) {
        let mut at: HashMap<[u32; 3], u32> = HashMap::with_capacity(self.positions.len());
        let first: Vec<u32> = (0u32..)
            .zip(&self.positions)
            // Adding 0 makes -0 and 0 the same key.
            .map(|(i, p)| *at.entry((*p + Vec3::ZERO).to_array().map(f32::to_bits)).or_insert(i))
            .collect();
        let mut around: HashMap<u32, Vec<(u32, f64)>> = HashMap::with_capacity(at.len());
        for (triangle, corners) in (0u32..).zip(&self.triangles) {
            let p = self.corners(triangle).map(|p| p.as_dvec3());
            for k in 0..3 {
                let (to_next, to_last) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                let angle = to_next.cross(to_last).length().atan2(to_next.dot(to_last));
                around.entry(first[corners[k] as usize]).or_default().push((triangle, angle));
            }
        }
        (first, around)
    }

    /// Gives each corner the normal wished for, with a copy of its vertex for every further normal.
    fn split_vertices(&mut self, corner_normals: &[Vec3]) {
        let vertices = self.positions.len();
        let mut taken = vec![false; vertices];
        self.normals = vec![Vec3::Y; vertices];
        let mut copies: HashMap<(u32, [u32; 3]), u32> = HashMap::new();
        let mut triangles = std::mem::take(&mut self.triangles);
        for (corner, normal) in triangles.iter_mut().flatten().zip(corner_normals) {
            let old = *corner as usize;
            if !taken[old] {
                taken[old] = true;
                self.normals[old] = *normal;
            } else if self.normals[old] != *normal {
                let key = (*corner, normal.to_array().map(f32::to_bits));
                *corner = *copies.entry(key).or_insert_with(|| self.copy_vertex(old, *normal));
            }
        }
        self.triangles = triangles;
    }

    /// Appends a copy of a vertex with another normal.
    fn copy_vertex(&mut self, vertex: usize, normal: Vec3) -> u32 {
        let copy = self.positions.len() as u32;
        self.positions.push(self.positions[vertex]);
        self.normals.push(normal);
        if !self.uvs.is_empty() {
            self.uvs.push(self.uvs[vertex]);
        }
        if !self.colors.is_empty() {
            self.colors.push(self.colors[vertex]);
        }
        copy
    }
}
