//! Meshes that shine: triangles by area and brightness, in pieces that lie together.
//!
//! A triangle whose texture has many texels counts as many cells. Pieces are what a choice among lights sees: a large mesh is
//! asked where it is near and bright. All of it takes some 24 bytes per triangle and cell, and is shared by all objects that
//! show the mesh with the same materials.

use super::cells::{cell_of, to_triangle};
use super::{EVEN, EmitterPiece, EmitterSample, Glow};
use crate::light::cluster::Cone;
use crate::light::sums;
use crate::texture_eval::{TexturePoint, uv_step};
use glam::{DVec3, Vec2, Vec3};
use heliostat_geometry::triangle::TriangleHit;
use heliostat_geometry::warp::square_to_triangle;
use heliostat_geometry::{Aabb, TriMesh};
use heliostat_scene::color::luminance;
use rayon::prelude::*;
use std::ops::Range;

/// Most cuts of a triangle: 4^9 cells.
const MOST_LEVELS: u8 = 9;
/// Most cells of a mesh beside one for each triangle.
const MOST_CELLS: u64 = 1 << 20;
/// Texels to a cell.
const TEXELS: f64 = 4.0;
/// Most points along one side of a cell at which its brightness is looked at.
const MOST_POINTS: f64 = 8.0;
/// For triangles that do not shine.
const NONE: u32 = u32::MAX;

/// A mesh that shines.
#[derive(Debug)]
pub(in super::super) struct MeshLamp<'s> {
    pub(super) mesh: &'s TriMesh,
    /// The triangle of each cell; cells of a triangle follow each other.
    triangles: Vec<u32>,
    /// Area times luminance of the cells up to and including this one.
    sums: Vec<f64>,
    /// The first cell of each triangle of the mesh.
    firsts: Vec<u32>,
    /// Cuts of each triangle of the mesh; empty where none is cut.
    levels: Vec<u8>,
    pieces: Vec<MeshPiece>,
}

/// Triangles that lie together.
#[derive(Clone, Copy, Debug)]
struct MeshPiece {
    /// The cell after its last.
    end: u32,
    bounds: Aabb,
    normals: Cone,
}

impl<'s> MeshLamp<'s> {
    /// The triangles of a mesh that shine, in at most so many pieces; `None` when there is nothing to see of them.
    pub(in super::super) fn new(mesh: &'s TriMesh, glow: &Glow<'_>, most_pieces: usize) -> Option<Self> {
        let shines = |i: &u32| glow.factor(mesh.slot(*i)) > 0.0 && mesh.area(*i) > 0.0;
        let mut order: Vec<u32> = (0..mesh.triangles.len() as u32).filter(shines).collect();
        if order.is_empty() {
            return None;
        }
        let bounds = mesh.bounds();
        order.par_sort_by_cached_key(|&i| morton(bounds, mesh.corners(i)));
        let levels = levels(mesh, glow, &order);
        let weights: Vec<Vec<f64>> =
            order.par_iter().map(|&i| weights(mesh, glow, i, level(&levels, i))).collect();
        let mut firsts = vec![NONE; mesh.triangles.len()];
        let mut triangles = Vec::new();
        let mut ends = Vec::with_capacity(order.len());
        for (&triangle, weights) in order.iter().zip(&weights) {
            firsts[triangle as usize] = triangles.len() as u32;
            triangles.extend(weights.iter().map(|_| triangle));
            ends.push(triangles.len() as u32);
        }
        let sums: Vec<f64> = sums::running(weights.into_iter().flatten()).collect();
        let total = sums::total(&sums);
        let count = order.len().min(most_pieces.max(1));
        let piece = |i: usize| {
            let (start, end) = (i * order.len() / count, (i + 1) * order.len() / count);
            MeshPiece::new(mesh, &order[start..end], ends[end - 1])
        };
        let pieces = (0..count).into_par_iter().map(piece).collect();
        (total > 0.0 && total.is_finite()).then_some(Self { mesh, triangles, sums, firsts, levels, pieces })
    }

    /// What is known of the pieces.
    pub(super) fn pieces(&self) -> impl Iterator<Item = EmitterPiece> {
        self.pieces.iter().enumerate().map(|(i, piece)| EmitterPiece {
            bounds: piece.bounds,
            normals: piece.normals,
            brightness: sums::total_in(&self.sums, self.cells(i)),
        })
    }

    /// The piece in which a point lies; `None` where it does not shine.
    pub(super) fn piece_of(&self, triangle: u32, weights: [f32; 3]) -> Option<usize> {
        let cell = self.cell(triangle, weights)?;
        Some(self.pieces.partition_point(|piece| piece.end as usize <= cell))
    }

    /// A point of a piece.
    pub(super) fn sample(&self, piece: usize, u: Vec2) -> EmitterSample {
        let (cell, x) = sums::pick_in(&self.sums, self.cells(piece), u.x);
        let triangle = self.triangles[cell];
        let inside = square_to_triangle(Vec2::new(x, u.y));
        let number = cell as u32 - self.firsts[triangle as usize];
        let weights = to_triangle(number, level(&self.levels, triangle), inside);
        let hit = TriangleHit { t: 0.0, barycentric: weights };
        let mut point = self.mesh.sample_at(triangle, &hit);
        point.pdf = self.density_in(piece, cell, triangle);
        let at = texture_point(self.mesh, triangle, &hit, point.uv, point.p);
        EmitterSample { point, slot: self.mesh.slot(triangle), at }
    }

    /// The density by local area with which a point of a piece is drawn.
    pub(super) fn density(&self, piece: usize, triangle: u32, weights: [f32; 3]) -> f64 {
        self.cell(triangle, weights).map_or(0.0, |cell| self.density_in(piece, cell, triangle))
    }

    fn density_in(&self, piece: usize, cell: usize, triangle: u32) -> f64 {
        let area = cell_area(self.mesh, triangle, level(&self.levels, triangle));
        sums::share(&self.sums, cell) / (sums::total_in(&self.sums, self.cells(piece)) * area)
    }

    fn cell(&self, triangle: u32, weights: [f32; 3]) -> Option<usize> {
        let first = self.firsts[triangle as usize];
        (first != NONE).then(|| first as usize + cell_of(level(&self.levels, triangle), weights) as usize)
    }

    fn cells(&self, piece: usize) -> Range<usize> {
        let start = if piece == 0 { 0 } else { self.pieces[piece - 1].end as usize };
        start..self.pieces[piece].end as usize
    }
}

impl MeshPiece {
    fn new(mesh: &TriMesh, triangles: &[u32], end: u32) -> Self {
        let corners = triangles.iter().flat_map(|&i| mesh.corners(i));
        let cone = |&i: &u32| {
            let [a, b, c] = mesh.corners(i).map(|p| p.as_dvec3());
            let axis = (b - a).cross(c - a).normalize_or_zero().as_vec3();
            Cone { axis, angle: 0.0 }
        };
        let normals = triangles.iter().map(cone).reduce(Cone::union).unwrap_or(Cone::ALL);
        Self { end, bounds: Aabb::of_points(corners), normals }
    }
}

/// Where the textures of a point are looked at.
fn texture_point(mesh: &TriMesh, triangle: u32, hit: &TriangleHit, uv: Vec2, p: DVec3) -> TexturePoint {
    TexturePoint {
        uv1: mesh.second_uv(triangle, hit).unwrap_or(uv),
        coverage: mesh.opacity(triangle, hit),
        ..TexturePoint::plain(uv, p.as_vec3())
    }
}

#[inline]
fn level(levels: &[u8], triangle: u32) -> u8 {
    levels.get(triangle as usize).copied().unwrap_or(0)
}

fn cell_area(mesh: &TriMesh, triangle: u32, level: u8) -> f64 {
    mesh.area(triangle) / f64::from(1_u32 << (2 * level))
}

/// Area times luminance of each cell of a triangle.
fn weights(mesh: &TriMesh, glow: &Glow<'_>, triangle: u32, level: u8) -> Vec<f64> {
    let area = cell_area(mesh, triangle, level);
    let slot = mesh.slot(triangle);
    if glow.texture(slot).is_none() {
        return vec![area * f64::from(glow.factor(slot))];
    }
    let count = 1_u32 << (2 * level);
    let points = (texels(mesh, glow, triangle) / f64::from(count)).sqrt().ceil().clamp(1.0, MOST_POINTS);
    let points = points as u32;
    let at = |cell: u32, k: u32| {
        let u = (Vec2::new((k % points) as f32, (k / points) as f32) + 0.5) / points as f32;
        let hit = TriangleHit { t: 0.0, barycentric: to_triangle(cell, level, square_to_triangle(u)) };
        let surface = mesh.surface(triangle, &hit);
        luminance(glow.radiance(slot, texture_point(mesh, triangle, &hit, surface.uv, surface.p)))
    };
    let mean = |cell: u32| (0..points * points).map(|k| at(cell, k)).sum::<f32>() / (points * points) as f32;
    let means: Vec<f32> = (0..count).map(mean).collect();
    let even = EVEN * means.iter().sum::<f32>() / count as f32;
    means.into_iter().map(|mean| area * f64::from((1.0 - EVEN) * mean + even)).collect()
}

/// How often each triangle is cut; empty where none is.
fn levels(mesh: &TriMesh, glow: &Glow<'_>, triangles: &[u32]) -> Vec<u8> {
    let wanted = |&i: &u32| {
        let cells = texels(mesh, glow, i) / TEXELS;
        if cells > 1.0 { (0.5 * cells.log2()).ceil().min(f64::from(MOST_LEVELS)) as u8 } else { 0 }
    };
    let wanted: Vec<u8> = triangles.iter().map(wanted).collect();
    let cells = |most: u8| wanted.iter().map(|&level| 1_u64 << (2 * level.min(most))).sum::<u64>();
    let fits = |most: &u8| cells(*most) <= MOST_CELLS + wanted.len() as u64;
    let most = (0..=MOST_LEVELS).rev().find(fits).unwrap_or(0);
    if wanted.iter().all(|&level| level.min(most) == 0) {
        return Vec::new();
    }
    let mut levels = vec![0; mesh.triangles.len()];
    triangles.iter().zip(wanted).for_each(|(&i, level)| levels[i as usize] = level.min(most));
    levels
}

/// How many texels of its emission a triangle shows; 0 without a texture.
fn texels(mesh: &TriMesh, glow: &Glow<'_>, triangle: u32) -> f64 {
    let Some(texture) = glow.texture(mesh.slot(triangle)) else { return 0.0 };
    let Some(step) = uv_step(texture) else { return TEXELS * MOST_POINTS * MOST_POINTS };
    let corner = |weights: [f32; 3]| {
        let hit = TriangleHit { t: 0.0, barycentric: weights };
        let uv = mesh.surface(triangle, &hit).uv;
        let second = texture.uv.set == heliostat_scene::texture::UvSet::Second;
        let uv = if second { mesh.second_uv(triangle, &hit).unwrap_or(uv) } else { uv };
        (uv / step).as_dvec2()
    };
    let [a, b, c] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(corner);
    0.5 * (b - a).perp_dot(c - a).abs()
}

/// Along a curve that fills the box: ten bits of each axis in turn.
fn morton(bounds: Aabb, corners: [Vec3; 3]) -> u32 {
    let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    let place = (centre - bounds.min) / bounds.size().max(Vec3::splat(f32::MIN_POSITIVE));
    let bits = |v: f32| (0..10).fold(0, |sum, bit| sum | (((v * 1023.0) as u32 >> bit) & 1) << (3 * bit));
    bits(place.x) | bits(place.y) << 1 | bits(place.z) << 2
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::Rgb;

    #[test]
    fn triangles_are_picked_by_area_and_the_rest_is_uniform() {
        // Areas 1, 3 and 4, side by side.
        let positions =
            [(2.0, 1.0, 0.0), (2.0, 3.0, 5.0), (4.0, 2.0, 10.0)].iter().flat_map(|&(x, y, at)| {
                [Vec3::ZERO, x * Vec3::X, y * Vec3::Y].map(|p| p + Vec3::new(0.0, 0.0, at))
            });
        let mesh = TriMesh {
            positions: positions.collect(),
            triangles: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]],
            ..TriMesh::default()
        };
        let lamp = MeshLamp::new(&mesh, &Glow::Even(Rgb::ONE), 1).unwrap();
        assert_eq!(sums::total(&lamp.sums), 8.0);
        let z = |u: f32| lamp.sample(0, Vec2::new(u, 0.3)).point.p.z;
        assert_eq!([z(0.1), z(0.2), z(0.45), z(0.55)], [0.0, 5.0, 5.0, 10.0]);
        assert_eq!(lamp.sample(0, Vec2::splat(0.9)).point.pdf, 0.125);
        let pieces = MeshLamp::new(&mesh, &Glow::Even(Rgb::ONE), 2).unwrap();
        let found = |triangle| pieces.piece_of(triangle, [0.2, 0.3, 0.5]);
        assert_eq!([found(0), found(1), found(2)], [Some(0), Some(1), Some(1)]);
        assert_eq!(pieces.density(1, 2, [0.2, 0.3, 0.5]), 1.0 / 7.0);
        assert!(MeshLamp::new(&mesh, &Glow::Even(Rgb::ZERO), 2).is_none());
    }
}
