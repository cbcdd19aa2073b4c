//! Shading normals for the corners that have none.
//!
//! Works on the polygons of the whole file before they are cut into objects and triangles, so that neither the
//! diagonal of a quad nor the border of a group shows. Two faces are smooth across an edge when they are of the same
//! smoothing group, `s off` is not in force, and the angle between them is at most the limit. Faces that hang together
//! over smooth edges around a vertex share one normal there: the mean of theirs, weighted by the angle at the vertex.
//!
//! # Source
//! Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", JGT 1998 (weights).

use super::face::NONE;
use super::raw::RawObj;
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// Faces at one edge that are compared with each other; beyond, the edge counts as sharp.
const MOST_FACES_AT_EDGE: usize = 8;

/// Gives a normal to every corner that has none or a zero one. `smooth_angle` in radians.
pub(super) fn fill_in(raw: &mut RawObj, smooth_angle: f32) {
    let zero: Vec<bool> = raw.normals.iter().map(|&n| n == Vec3::ZERO).collect();
    for corner in &mut raw.corners {
        if corner.normal != NONE && zero[corner.normal as usize] {
            corner.normal = NONE;
        }
    }
    if raw.corners.iter().all(|corner| corner.normal != NONE) {
        return;
    }
    let facets = Facets::of(raw);
    let spokes = spokes_by_vertex(&facets, raw);
    let mut fans = Fans { cos_limit: f64::from(smooth_angle).cos(), ..Fans::default() };
    for around in spokes.chunk_by(|a, b| a.vertex == b.vertex) {
        fans.join_over_smooth_edges(around, &facets, raw);
        fans.assign_normals(around, &facets, raw);
    }
}

/// One corner of a face that lacks normals, with the edges on both sides of it. Vertices at one place are one vertex.
#[derive(Clone, Copy, Debug)]
struct Spoke {
    vertex: u32,
    /// Index into [`RawObj::corners`].
    corner: u32,
    face: u32,
    /// The vertices at the other ends of the two edges.
    neighbours: [u32; 2],
    /// Angle between the two edges in radians.
    angle: f64,
}

/// What is needed of each face that lacks normals.
#[derive(Debug, Default)]
struct Facets {
    /// Unit normal, zero on a face without area and on faces that lack nothing.
    normals: Vec<DVec3>,
    /// Whether at least one corner lacks a normal.
    lacking: Vec<bool>,
}

impl Facets {
    fn of(raw: &RawObj) -> Self {
        let mut facets = Self::default();
        for i in 0..raw.faces.len() {
            let corners = &raw.corners[raw.corners_of(i)];
            let lacks = corners.iter().any(|c| c.normal == NONE);
            let points = corners.iter().map(|c| raw.positions[c.position as usize]);
            facets.lacking.push(lacks);
            facets.normals.push(if lacks { newell(points).normalize_or_zero() } else { DVec3::ZERO });
        }
        facets
    }
}

/// Twice the area vector of a polygon.
///
/// # Source
/// Newell's method; Sutherland, Sproull, Schumacker, "A Characterization of Ten Hidden-Surface Algorithms", 1974.
pub(super) fn newell(points: impl Iterator<Item = Vec3> + Clone) -> DVec3 {
    let Some(origin) = points.clone().next().map(|p| p.as_dvec3()) else {
        return DVec3::ZERO;
    };
    // Relative to the first point, so that nothing cancels far from the origin.
    let relative = points.map(|p| p.as_dvec3() - origin);
    relative.clone().zip(relative.skip(1)).map(|(a, b)| a.cross(b)).sum()
}

/// For each position the first one at the same place: exporters repeat vertices at seams.
fn weld(positions: &[Vec3]) -> Vec<u32> {
    let mut first_at = HashMap::with_capacity(positions.len());
    // Adding zero makes -0 and 0 the same bits.
    let key = |p: &Vec3| (*p + Vec3::ZERO).to_array().map(f32::to_bits);
    positions.iter().enumerate().map(|(i, p)| *first_at.entry(key(p)).or_insert(i as u32)).collect()
}

/// The corners of lacking faces, sorted by vertex.
fn spokes_by_vertex(facets: &Facets, raw: &RawObj) -> Vec<Spoke> {
    let welded = weld(&raw.positions);
    let mut spokes = Vec::with_capacity(raw.corners.len());
    let mut runs = Vec::new();
    for (face, _) in facets.lacking.iter().enumerate().filter(|&(_, &lacks)| lacks) {
        push_spokes(raw, &welded, face, &mut runs, &mut spokes);
    }
    spokes.sort_unstable_by_key(|spoke| (spoke.vertex, spoke.corner));
    spokes
}

/// The corners of one face. Corners in a row at one place, as quads have them at the pole of a ball, see past each other.
fn push_spokes(raw: &RawObj, welded: &[u32], face: usize, runs: &mut Vec<u32>, spokes: &mut Vec<Spoke>) {
    let range = raw.corners_of(face);
    let vertices = || raw.corners[range.clone()].iter().map(|corner| welded[corner.position as usize]);
    runs.clear();
    runs.extend(vertices());
    runs.dedup();
    if runs.len() > 1 && runs.first() == runs.last() {
        runs.pop();
    }
    let at = |vertex: u32| raw.positions[vertex as usize].as_dvec3();
    let mut run = 0;
    for (corner, vertex) in (range.start as u32..).zip(vertices()) {
        if runs[run] != vertex {
            run = (run + 1) % runs.len();
        }
        let neighbours = [runs[(run + runs.len() - 1) % runs.len()], runs[(run + 1) % runs.len()]];
        let [a, b] = neighbours.map(|end| at(end) - at(vertex));
        let angle = a.cross(b).length().atan2(a.dot(b));
        spokes.push(Spoke { vertex, corner, face: face as u32, neighbours, angle });
    }
}

/// The faces around one vertex as sets that share a normal. The buffers serve one vertex after another.
#[derive(Debug, Default)]
struct Fans {
    cos_limit: f64,
    /// A forest over the spokes around the vertex; a root is its own parent.
    parents: Vec<u32>,
    /// The edges of the spokes: the vertex at the other end, and the spoke.
    edges: Vec<(u32, u32)>,
    /// Weighted sum of the face normals, by root.
    sums: Vec<DVec3>,
    /// Index of the normal made, by root.
    made: Vec<u32>,
}

impl Fans {
    fn join_over_smooth_edges(&mut self, around: &[Spoke], facets: &Facets, raw: &RawObj) {
        self.parents.clear();
        self.parents.extend(0..around.len() as u32);
        self.edges.clear();
        for (i, spoke) in (0..).zip(around) {
            self.edges.extend(spoke.neighbours.map(|end| (end, i)));
        }
        self.edges.sort_unstable();
        let edges = std::mem::take(&mut self.edges);
        for at_edge in edges.chunk_by(|a, b| a.0 == b.0).filter(|e| e.len() <= MOST_FACES_AT_EDGE) {
            for (k, &(_, i)) in at_edge.iter().enumerate() {
                for &(_, j) in &at_edge[k + 1..] {
                    if self.is_smooth(&around[i as usize], &around[j as usize], facets, raw) {
                        let (a, b) = (self.root(i), self.root(j));
                        self.parents[a.max(b) as usize] = a.min(b);
                    }
                }
            }
        }
        self.edges = edges;
    }

    fn is_smooth(&self, a: &Spoke, b: &Spoke, facets: &Facets, raw: &RawObj) -> bool {
        let [group_a, group_b] = [a, b].map(|s| raw.attributes_of(s.face as usize).smoothing);
        let [normal_a, normal_b] = [a, b].map(|s| facets.normals[s.face as usize]);
        group_a == group_b && group_a != Some(0) && normal_a.dot(normal_b) >= self.cos_limit
    }

    fn root(&mut self, mut i: u32) -> u32 {
        while self.parents[i as usize] != i {
            // Halve the path on the way.
            self.parents[i as usize] = self.parents[self.parents[i as usize] as usize];
            i = self.parents[i as usize];
        }
        i
    }

    fn assign_normals(&mut self, around: &[Spoke], facets: &Facets, raw: &mut RawObj) {
        self.sums.clear();
        self.sums.resize(around.len(), DVec3::ZERO);
        for (i, spoke) in (0..).zip(around) {
            let root = self.root(i);
            self.sums[root as usize] += spoke.angle * facets.normals[spoke.face as usize];
        }
        self.made.clear();
        self.made.resize(around.len(), NONE);
        for (i, spoke) in (0..).zip(around) {
            if raw.corners[spoke.corner as usize].normal != NONE {
                continue;
            }
            let root = self.root(i) as usize;
            if self.made[root] == NONE {
                self.made[root] = raw.normals.len() as u32;
                // A fan without area shows to nobody; any unit vector serves.
                raw.normals.push(self.sums[root].try_normalize().unwrap_or(DVec3::Y).as_vec3());
            }
            raw.corners[spoke.corner as usize].normal = self.made[root];
        }
    }
}
