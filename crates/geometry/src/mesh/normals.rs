//! Vertex normals for meshes that come without: smooth across shallow edges, sharp across steep ones.

use super::TriMesh;
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// Fans with more triangles than this are thinned out, or a vertex shared by a whole mesh would cost its square.
const LARGE_FAN: usize = 1024;

/// The triangles around a position.
#[derive(Default)]
struct Fan {
    /// Unit normals, and normals weighted by area and angle.
    members: Vec<(DVec3, DVec3)>,
    /// Sum of the weighted normals.
    total: DVec3,
}

impl Fan {
    /// Merges members of almost the same direction in a large fan.
    fn thin_out(&mut self) {
        if self.members.len() <= LARGE_FAN {
            return;
        }
        // A lattice on the sphere with steps of about 7 degrees.
        let cell = |unit: DVec3| (8.0 * unit).round().to_array().map(|x| x as i8);
        let mut index = HashMap::new();
        let mut merged: Vec<(DVec3, DVec3)> = Vec::new();
        for (unit, weighted) in std::mem::take(&mut self.members) {
            let i = *index.entry(cell(unit)).or_insert(merged.len());
            match merged.get_mut(i) {
                Some((_, sum)) => *sum += weighted,
                None => merged.push((unit, weighted)),
            }
        }
        self.members =
            merged.into_iter().map(|(unit, sum)| (sum.try_normalize().unwrap_or(unit), sum)).collect();
    }

    /// The normal at this position of the triangle with unit normal `own`, zero when it has no area.
    fn normal(&self, own: DVec3, cos_max: f64) -> Vec3 {
        let sum = if own == DVec3::ZERO {
            self.total
        } else {
            let shallow = self.members.iter().filter(|(unit, _)| own.dot(*unit) >= cos_max);
            shallow.map(|(_, weighted)| *weighted).sum()
        };
        sum.try_normalize().unwrap_or(own).as_vec3()
    }
}

impl TriMesh {
    /// Makes shading normals: smooth between triangles whose normals differ by at most `max_angle` radians around
    /// the vertex they share, sharp elsewhere. Vertices at sharp edges are split.
    ///
    /// Vertices of equal position count as one, so seams of texture coordinates stay smooth. Each triangle weighs
    /// in with its area times its angle at the vertex, so that neither slivers nor the way a polygon was cut
    /// into triangles bend the normal. Old normals are dropped. Triangles without area take part in nothing and
    /// receive the mean of their neighbours.
    ///
    /// ```
    /// use glam::Vec3;
    /// use heliostat_geometry::TriMesh;
    ///
    /// // A roof of two triangles with a right angle at the ridge from 0 to Z.
    /// let positions = vec![Vec3::ZERO, Vec3::Z, Vec3::new(1.0, -1.0, 0.0), Vec3::new(-1.0, -1.0, 0.0)];
    /// let roof = TriMesh { positions, triangles: vec![[0, 1, 2], [1, 0, 3]], ..TriMesh::default() };
    /// let (mut sharp, mut smooth) = (roof.clone(), roof);
    /// sharp.compute_normals(60.0_f32.to_radians());
    /// smooth.compute_normals(120.0_f32.to_radians());
    /// assert_eq!((sharp.positions.len(), smooth.positions.len()), (6, 4));
    /// assert!(smooth.normals[0].y > 0.9);
    /// ```
    pub fn compute_normals(&mut self, max_angle: f32) {
        let cos_max = f64::from(max_angle).cos();
        let units: Vec<DVec3> =
            (0..self.triangles.len() as u32).map(|i| self.winding_normal(i).normalize_or_zero()).collect();
        let (place, fans) = self.fans(&units);
        let corner_normals: Vec<Vec3> = self
            .triangles
            .iter()
            .zip(&units)
            .flat_map(|(corners, own)| corners.map(|v| fans[place[v as usize]].normal(*own, cos_max)))
            .collect();
        self.split_vertices(&corner_normals);
    }

    /// For each vertex the number of its position, and for each position its fan.
    fn fans(&self, units: &[DVec3]) -> (Vec<usize>, Vec<Fan>) {
        let mut numbers: HashMap<[u32; 3], usize> = HashMap::with_capacity(self.positions.len());
        let mut place = Vec::with_capacity(self.positions.len());
        for p in &self.positions {
            // Adding 0 makes -0 and 0 the same key.
            let key = (*p + Vec3::ZERO).to_array().map(f32::to_bits);
            let next = numbers.len();
            place.push(*numbers.entry(key).or_insert(next));
        }
        let mut fans: Vec<Fan> = std::iter::repeat_with(Fan::default).take(numbers.len()).collect();
        for ((triangle, corners), unit) in (0..).zip(&self.triangles).zip(units) {
            if *unit == DVec3::ZERO {
                continue;
            }
            let face = self.winding_normal(triangle);
            let p = self.corners(triangle).map(|p| p.as_dvec3());
            for k in 0..3 {
                let (to_next, to_last) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                let angle = face.length().atan2(to_next.dot(to_last));
                let fan = &mut fans[place[corners[k] as usize]];
                fan.members.push((*unit, angle * face));
                fan.total += angle * face;
            }
        }
        fans.iter_mut().for_each(Fan::thin_out);
        (place, fans)
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
