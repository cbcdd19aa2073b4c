//! Polygons into triangles.
//!
//! A polygon is looked at along its Newell normal, the direction that shows most of its area. Convex ones become a fan;
//! others go to ear clipping (`earcut`). The library leaves out corners on straight edges; they are put back here, so
//! that a polygon of n corners gives n - 2 triangles and neighbours meet vertex to vertex.
//!
//! # Source
//! Meisters, "Polygons Have Ears", American Mathematical Monthly 1975.

use super::normals::newell;
use earcut::Earcut;
use glam::{DVec2, Vec3};
use heliostat_geometry::OrthonormalFrame;
use std::collections::HashMap;

/// A polygon that has been cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// Into triangles that cover it once.
    Whole,
    /// The border crosses itself, or encloses nothing: the triangles are a guess.
    Crossing,
}

/// Cuts polygons; keeps its buffers.
pub(super) struct Triangulator {
    earcut: Earcut<f64>,
    flat: Vec<DVec2>,
    /// Corners of the triangles of the last polygon, as indices into it.
    pub(super) triangles: Vec<[u32; 3]>,
    ears: Vec<u32>,
    used: Vec<bool>,
}

impl Triangulator {
    pub(super) fn new() -> Self {
        Self {
            earcut: Earcut::new(),
            flat: Vec::new(),
            triangles: Vec::new(),
            ears: Vec::new(),
            used: Vec::new(),
        }
    }

    /// Cuts the polygon with these corners, in order, into [`Triangulator::triangles`].
    pub(super) fn cut(&mut self, polygon: &[Vec3]) -> Cut {
        self.triangles.clear();
        let n = polygon.len() as u32;
        if n == 3 {
            self.triangles.push([0, 1, 2]);
            return Cut::Whole;
        }
        let normal = newell(polygon.iter().copied());
        let Some(normal) = normal.try_normalize() else {
            // No side has more area than the other: a line, or a bow tie.
            self.fan(n);
            return Cut::Crossing;
        };
        self.flatten(polygon, normal.as_vec3().normalize());
        if self.is_convex() {
            self.fan(n);
            return Cut::Whole;
        }
        self.clip_ears();
        self.put_back_straight_corners(n);
        let is_whole = self.triangles.len() + 2 == polygon.len()
            && self.triangles.iter().all(|t| area(t.map(|i| self.flat[i as usize])) >= 0.0);
        if self.triangles.is_empty() {
            self.fan(n);
        }
        if is_whole { Cut::Whole } else { Cut::Crossing }
    }

    fn fan(&mut self, n: u32) {
        self.triangles.extend((1..n - 1).map(|i| [0, i, i + 1]));
    }

    /// The polygon in its plane, counter-clockwise, in `f64`.
    fn flatten(&mut self, polygon: &[Vec3], normal: Vec3) {
        let frame = OrthonormalFrame::around(normal);
        let (x, y) = (frame.x.as_dvec3(), frame.y.as_dvec3());
        let origin = polygon[0].as_dvec3();
        self.flat.clear();
        self.flat.extend(polygon.iter().map(|p| {
            let p = p.as_dvec3() - origin;
            DVec2::new(p.dot(x), p.dot(y))
        }));
    }

    /// Whether all corners turn left and the first one sees all the others turn left: convex, and around once.
    fn is_convex(&self) -> bool {
        let n = self.flat.len();
        let turns_left =
            |i: usize| area([self.flat[i], self.flat[(i + 1) % n], self.flat[(i + 2) % n]]) > 0.0;
        let seen_left = |i: usize| area([self.flat[0], self.flat[i], self.flat[i + 1]]) > 0.0;
        (0..n).all(turns_left) && (1..n - 1).all(seen_left)
    }

    fn clip_ears(&mut self) {
        let no_holes: &[u32] = &[];
        let points = self.flat.iter().map(|p| p.to_array());
        self.earcut.earcut(points, no_holes, &mut self.ears);
        self.triangles.extend(self.ears.chunks_exact(3).map(|t| {
            let t = [t[0], t[1], t[2]];
            // Ears come in either direction; the polygon runs counter-clockwise.
            if area(t.map(|i| self.flat[i as usize])) < 0.0 { [t[0], t[2], t[1]] } else { t }
        }));
    }

    /// Splits the triangle at each edge from which corners were left out into a fan over them.
    fn put_back_straight_corners(&mut self, n: u32) {
        self.used.clear();
        self.used.resize(n as usize, false);
        self.triangles.iter().flatten().for_each(|&i| self.used[i as usize] = true);
        let Some(start) = (0..n).find(|&i| self.used[i as usize]).filter(|_| self.used.contains(&false))
        else {
            return;
        };
        // The triangle to the left of each directed edge.
        let mut left_of = HashMap::new();
        for (at, &[a, b, c]) in self.triangles.iter().enumerate() {
            left_of.extend([((a, b), at), ((b, c), at), ((c, a), at)]);
        }
        let mut from = start;
        for to in (1..=n).map(|step| (start + step) % n) {
            if self.used[to as usize] {
                if (from + 1) % n != to {
                    self.split_edge(from, to, &mut left_of);
                }
                from = to;
            }
        }
    }

    fn split_edge(&mut self, from: u32, to: u32, left_of: &mut HashMap<(u32, u32), usize>) {
        let n = self.flat.len() as u32;
        let Some(&at) = left_of.get(&(from, to)) else {
            return;
        };
        let Some(apex) = self.triangles[at].into_iter().find(|&i| i != from && i != to) else {
            return;
        };
        let first = (from + 1) % n;
        self.triangles[at] = [apex, from, first];
        let mut i = first;
        while i != to {
            let next = (i + 1) % n;
            left_of.insert((next, apex), self.triangles.len());
            self.triangles.push([apex, i, next]);
            i = next;
        }
    }
}

/// Twice the signed area, above 0 when counter-clockwise.
fn area([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(polygon: &[Vec3]) -> (Cut, Vec<[u32; 3]>) {
        let mut triangulator = Triangulator::new();
        let cut = triangulator.cut(polygon);
        (cut, triangulator.triangles)
    }

    /// Sum of the areas of the triangles.
    fn covered(polygon: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
        let corner = |i: u32| polygon[i as usize].as_dvec3();
        triangles
            .iter()
            .map(|t| 0.5 * (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0])).length())
            .sum()
    }

    /// Checks that simple polygons are covered once, in a tilted plane away from the origin, at some scales.
    fn check(outline: &[(f32, f32)]) {
        for scale in [1e-3, 1.0, 1e5] {
            let x = Vec3::new(2.0, -1.0, 0.5).normalize() * scale;
            let y = x.cross(Vec3::new(0.3, 0.4, 0.9)).normalize() * scale;
            let at = |&(u, v): &(f32, f32)| scale * Vec3::new(7.0, -3.0, 11.0) + u * x + v * y;
            let polygon: Vec<_> = outline.iter().map(at).collect();
            let (cut, triangles) = cut(&polygon);
            assert_eq!(cut, Cut::Whole, "{outline:?} at {scale}");
            assert_eq!(triangles.len(), outline.len() - 2, "{outline:?} at {scale}");
            let expected = 0.5 * newell(polygon.iter().copied()).length();
            let relative = (covered(&polygon, &triangles) - expected).abs() / expected;
            assert!(relative < 1e-5, "{outline:?} at {scale}: {relative}");
        }
    }

    #[test]
    fn convex_polygons_become_fans() {
        let square = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
        assert_eq!(cut(&square), (Cut::Whole, vec![[0, 1, 2], [0, 2, 3]]));
    }

    #[test]
    fn a_concave_quad_is_cut_along_the_inner_diagonal() {
        // An arrow head: corner 2 points inwards.
        for start in 0..4 {
            let mut arrow = [(0.0, 0.0), (4.0, -2.0), (1.0, 0.0), (4.0, 2.0)];
            arrow.rotate_left(start);
            check(&arrow);
        }
    }

    #[test]
    fn concave_polygons_are_covered_once() {
        check(&[(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)]);
        let star = (0..24).map(|i| {
            let angle = std::f32::consts::TAU * i as f32 / 24.0;
            let radius = if i % 2 == 0 { 1.0 } else { 0.3 };
            (radius * angle.cos(), radius * angle.sin())
        });
        check(&star.collect::<Vec<_>>());
    }

    #[test]
    fn corners_on_straight_edges_stay() {
        let outline = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (3.0, 3.0), (1.0, 1.0)];
        let polygon = outline.map(|(x, y)| Vec3::new(x, y, 5.0));
        let (result, triangles) = cut(&polygon);
        assert_eq!((result, triangles.len()), (Cut::Whole, 4));
        assert!(triangles.iter().all(|t| area(t.map(|i| polygon[i as usize].as_dvec3().truncate())) > 0.0));
    }

    #[test]
    fn a_convex_polygon_with_a_straight_corner_has_no_flat_triangle() {
        let polygon = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
        let (result, triangles) = cut(&polygon);
        assert_eq!((result, triangles.len()), (Cut::Whole, 2));
        assert!(triangles.iter().all(|t| area(t.map(|i| polygon[i as usize].as_dvec3().truncate())) > 0.0));
    }

    #[test]
    fn crossing_borders_are_told() {
        let bow_tie = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
        assert_eq!(cut(&bow_tie).0, Cut::Crossing);
        let uneven = [(0.0, 0.0), (3.0, 3.0), (3.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
        assert_eq!(cut(&uneven).0, Cut::Crossing);
        let pentagram: Vec<_> = (0..5)
            .map(|i| {
                let angle = 2.0 * std::f32::consts::TAU * i as f32 / 5.0;
                Vec3::new(angle.cos(), angle.sin(), 0.0)
            })
            .collect();
        assert_eq!(cut(&pentagram).0, Cut::Crossing);
    }

    #[test]
    fn polygons_without_area_give_triangles_without_area() {
        let (_, triangles) = cut(&[Vec3::X; 5]);
        assert_eq!(triangles.len(), 3);
        let line = [0.0, 1.0, 2.0, 3.0].map(|x| Vec3::new(x, 2.0 * x, 0.0));
        assert_eq!(cut(&line).1.len(), 2);
    }
}
