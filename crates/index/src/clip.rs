//! The box around the part of a triangle inside a cell: what makes splits "perfect".
//!
//! # Source
//! Sutherland and Hodgman, "Reentrant Polygon Clipping", CACM 1974; its use for split decisions: Wald and Havran,
//! "On building fast kd-trees for ray tracing, and on doing that in O(N log N)", 2006, section 4.3.

use glam::{DVec3, Vec3};
use heliostat_geometry::Aabb;

/// A triangle cut by six planes has at most nine corners.
const MAX_CORNERS: usize = 9;

/// A convex polygon without allocation.
struct Polygon {
    corners: [DVec3; MAX_CORNERS],
    len: usize,
}

impl Polygon {
    const EMPTY: Self = Self { corners: [DVec3::ZERO; MAX_CORNERS], len: 0 };

    #[inline(always)]
    fn push(&mut self, p: DVec3) {
        // Rounding can in principle make one corner more than a convex polygon has: the last one then gives way.
        let slot = self.len.min(MAX_CORNERS - 1);
        self.corners[slot] = p;
        self.len = slot + 1;
    }

    /// Puts the part where `side * (p[AXIS] - plane) >= 0` into `kept`.
    fn cut<const AXIS: usize>(&self, plane: f64, side: f64, kept: &mut Self) {
        kept.len = 0;
        let corners = &self.corners[..self.len];
        let Some(&first) = corners.first() else { return };
        let beyond = |p: DVec3| side * (p[AXIS] - plane);
        let (mut p, mut dp) = (first, beyond(first));
        for k in 1..=corners.len() {
            let q = corners.get(k).copied().unwrap_or(first);
            let dq = beyond(q);
            if dp >= 0.0 {
                kept.push(p);
            }
            if (dp > 0.0 && dq < 0.0) || (dp < 0.0 && dq > 0.0) {
                let mut crossing = p + (q - p) * (dp / (dp - dq));
                crossing[AXIS] = plane;
                kept.push(crossing);
            }
            (p, dp) = (q, dq);
        }
    }
}

/// A polygon, and room for the next: what is copied to and fro costs as much as the cuts.
struct Clipper<'a> {
    polygon: &'a mut Polygon,
    spare: &'a mut Polygon,
    /// The box around it at first.
    around: Aabb,
}

impl Clipper<'_> {
    /// Keeps the part between both sides of the cell along an axis.
    #[inline(always)]
    fn clip<const AXIS: usize>(&mut self, cell: Aabb) {
        if self.around.min[AXIS] < cell.min[AXIS] {
            self.polygon.cut::<AXIS>(f64::from(cell.min[AXIS]), 1.0, self.spare);
            std::mem::swap(&mut self.polygon, &mut self.spare);
        }
        if self.around.max[AXIS] > cell.max[AXIS] {
            self.polygon.cut::<AXIS>(f64::from(cell.max[AXIS]), -1.0, self.spare);
            std::mem::swap(&mut self.polygon, &mut self.spare);
        }
    }
}

/// The box around the part of the triangle inside `cell`, rounded outward and cut at the cell; empty when they
/// do not meet.
pub(crate) fn clipped_triangle_bounds(corners: [Vec3; 3], cell: Aabb) -> Aabb {
    let around = Aabb::of_points(corners);
    let overlap = around.intersect(cell);
    if overlap.is_empty() || cell.contains_box(around) {
        return overlap;
    }

    let (mut triangle, mut spare) = (Polygon::EMPTY, Polygon::EMPTY);
    corners.iter().for_each(|corner| triangle.push(corner.as_dvec3()));
    let mut clipper = Clipper { polygon: &mut triangle, spare: &mut spare, around };
    clipper.clip::<0>(cell);
    clipper.clip::<1>(cell);
    clipper.clip::<2>(cell);

    let corners = &clipper.polygon.corners[..clipper.polygon.len];
    let low = corners.iter().fold(DVec3::INFINITY, |low, &p| low.min(p));
    let high = corners.iter().fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
    Aabb { min: round_down(low), max: round_up(high) }.intersect(overlap)
}

/// The largest `f32` corner not above.
fn round_down(p: DVec3) -> Vec3 {
    let nearest = p.as_vec3();
    let one =
        |rounded: f32, exact: f64| if f64::from(rounded) > exact { rounded.next_down() } else { rounded };
    Vec3::new(one(nearest.x, p.x), one(nearest.y, p.y), one(nearest.z, p.z))
}

/// The smallest `f32` corner not below.
fn round_up(p: DVec3) -> Vec3 {
    -round_down(-p)
}
