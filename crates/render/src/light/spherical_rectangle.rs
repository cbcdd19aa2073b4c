//! Points on a rectangle, uniform by the solid angle under which it is seen.
//!
//! # Source
//! Ureña, Fajardo, King, "An Area-Preserving Parametrization for Spherical Rectangles", EGSR 2013.

use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// Where the rectangle is seen under less than this, in steradians, points uniform by area do as well, and rounding would
/// show in a solid angle that is the difference of large angles.
const LEAST_ANGLE: f32 = 0.02;

/// A rectangle in world space.
#[derive(Clone, Copy, Debug)]
pub(super) struct WorldRectangle {
    corner: Vec3,
    /// Unit vectors along the sides, and their lengths.
    sides: [Vec3; 2],
    lengths: Vec2,
    normal: Vec3,
}

/// A rectangle as seen from a point: its corners in the frame of the sides, and the angles of its spherical image.
#[derive(Clone, Copy, Debug)]
pub(super) struct SphericalRectangle<'a> {
    rectangle: &'a WorldRectangle,
    from: Vec3,
    /// Nearest and farthest along the sides.
    low: Vec2,
    high: Vec2,
    /// Distance of the plane, below 0, and 1 or -1 by the side of the normal.
    z: f32,
    side: f32,
    /// Heights of the normals of the first and the third side.
    b: [f32; 2],
    /// Sums of the first two and the last two inner angles.
    angles: [f32; 2],
    /// Solid angle in steradians.
    pub(super) solid_angle: f32,
}

impl WorldRectangle {
    /// A rectangle around `centre` by half its sides `x` and `z`, which are at right angles.
    pub(super) fn new(centre: Vec3, x: Vec3, z: Vec3) -> Self {
        let sides = [x.normalize(), z.normalize()];
        Self {
            corner: centre - x - z,
            sides,
            lengths: 2.0 * Vec2::new(x.length(), z.length()),
            normal: sides[0].cross(sides[1]),
        }
    }

    /// The rectangle as seen from `p`; `None` where that does not pay.
    #[inline]
    pub(super) fn seen_from(&self, p: Vec3) -> Option<SphericalRectangle<'_>> {
        let way = self.corner - p;
        let height = way.dot(self.normal);
        let side = if height > 0.0 { -1.0 } else { 1.0 };
        let z = side * height;
        let low = Vec2::new(way.dot(self.sides[0]), way.dot(self.sides[1]));
        let high = low + self.lengths;
        // Far away it is small without a closer look: the nearest distance is that to the plane or to the box of the sides.
        let beside = low.max(-high).max(Vec2::ZERO);
        let nearest_squared = beside.length_squared() + z * z;
        if self.lengths.x * self.lengths.y < LEAST_ANGLE * nearest_squared {
            return None;
        }
        // Normals of the planes through p and each side, which have only two components.
        let normal = |edge: f32, along: f32| Vec2::new(along, edge) / Vec2::new(along, edge).length();
        let n = [normal(-low.y, z), normal(high.x, -z), normal(high.y, -z), normal(-low.x, z)];
        // Inner angles by their cosines and sines, two at a time: their sum is that of a product of complex numbers.
        let turn = |a: Vec2, b: Vec2| {
            let cos = -a.y * b.y;
            Vec2::new(cos, ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt())
        };
        let angle = |a: Vec2, b: Vec2, c: Vec2| {
            let sum = turn(a, b).rotate(turn(b, c)).to_angle();
            if sum < 0.0 { sum + TAU } else { sum }
        };
        let angles = [angle(n[0], n[1], n[2]), angle(n[2], n[3], n[0])];
        let solid_angle = angles[0] + angles[1] - TAU;
        (solid_angle >= LEAST_ANGLE).then_some(SphericalRectangle {
            rectangle: self,
            from: p,
            low,
            high,
            z,
            side,
            b: [n[0].y, n[2].y],
            angles,
            solid_angle,
        })
    }
}

impl SphericalRectangle<'_> {
    /// A point uniform by solid angle.
    #[inline]
    pub(super) fn sample(&self, u: Vec2) -> Vec3 {
        let [b0, b1] = self.b;
        // The column, by the share of the solid angle to its left.
        let turn = u.x * (self.angles[0] - TAU) + (u.x - 1.0) * self.angles[1];
        let f = (turn.cos() * b0 - b1) / turn.sin();
        let cos = (1.0 / (f * f + b0 * b0).sqrt()).copysign(f).clamp(-1.0, 1.0);
        let x = -(cos * self.z) / (1.0 - cos * cos).max(f32::MIN_POSITIVE).sqrt();
        let x = x.clamp(self.low.x, self.high.x);
        // The place in the column, uniform by height on the sphere.
        let d2 = x * x + self.z * self.z;
        let height = |y: f32| y / (d2 + y * y).sqrt();
        let h = height(self.low.y) + u.y * (height(self.high.y) - height(self.low.y));
        let y = h * (d2 / (1.0 - h * h).max(f32::MIN_POSITIVE)).sqrt();
        let y = y.clamp(self.low.y, self.high.y);
        let WorldRectangle { sides, normal, .. } = self.rectangle;
        self.from + x * sides[0] + y * sides[1] + self.side * self.z * *normal
    }
}
