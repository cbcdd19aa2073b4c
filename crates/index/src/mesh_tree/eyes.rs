//! Many rays as blocks see them.

use super::block::{AXES, Axis, Rows};
use super::seen::Eye;
use crate::simd::{LANES, Lanes};
use crate::wide::rays::{Coordinates, NO_COORDINATES, PerRay, Rays, TOGETHER};
use heliostat_geometry::triangle_columns::Pairs;

/// Rays with the axes in cyclic order, the one along which each runs fastest last; as many
/// [`TriangleRay`](heliostat_geometry::triangle::TriangleRay)s.
pub(super) struct Eyes {
    axes: PerRay<[Axis; 3]>,
    /// The last axis.
    along: PerRay<u32>,
    origin: Coordinates,
    dir: Coordinates,
    /// Slopes of the direction along the first two axes over the last one.
    slope: [PerRay<f32>; 2],
}

impl Eyes {
    pub(super) const NONE: Self = Self {
        axes: [AXES[0]; TOGETHER],
        along: [0; TOGETHER],
        origin: NO_COORDINATES,
        dir: NO_COORDINATES,
        slope: [[0.0; TOGETHER]; 2],
    };

    /// Works them out as `TriangleRay::new` does.
    #[inline(always)]
    pub(super) fn set_up(&mut self, rays: &Rays) {
        for i in 0..rays.padded() {
            let [x, y, z] = [rays.dir[0][i], rays.dir[1][i], rays.dir[2][i]];
            let is_x = (x.abs() >= y.abs()) & (x.abs() >= z.abs());
            let is_y = !is_x & (y.abs() >= z.abs()) & (y.abs() >= x.abs());
            let turned = |x: f32, y: f32, z: f32| {
                let of_y = if is_y { [z, x, y] } else { [x, y, z] };
                if is_x { [y, z, x] } else { of_y }
            };
            let [x, y, z] = turned(x, y, z);
            (self.dir[0][i], self.dir[1][i], self.dir[2][i]) = (x, y, z);
            (self.slope[0][i], self.slope[1][i]) = (x / z, y / z);
            let [x, y, z] = turned(rays.origin[0][i], rays.origin[1][i], rays.origin[2][i]);
            (self.origin[0][i], self.origin[1][i], self.origin[2][i]) = (x, y, z);
            self.along[i] = if is_x { 0 } else { 2 - u32::from(is_y) };
        }
        for (axes, along) in self.axes.iter_mut().zip(&self.along) {
            *axes = AXES[*along as usize % 3];
        }
    }

    /// A ray in all lanes.
    #[inline(always)]
    pub(super) fn eye<L: Lanes>(&self, lanes: L, ray: usize) -> Eye<L> {
        let ([ox, oy, oz], [sx, sy]) = (&self.origin, &self.slope);
        Eye {
            axes: self.axes[ray],
            origin: [lanes.splat(ox[ray]), lanes.splat(oy[ray]), lanes.splat(oz[ray])],
            slope: [lanes.splat(sx[ray]), lanes.splat(sy[ray])],
        }
    }

    /// The direction of a ray along its last axis.
    #[inline(always)]
    pub(super) fn dir(&self, ray: usize) -> f32 {
        self.dir[2][ray]
    }

    /// Writes a ray, and the triangle in a lane of some rows, to the place of a pair.
    #[inline(always)]
    pub(super) fn pair(&self, pairs: &mut Pairs, place: usize, ray: usize, rows: &Rows, lane: usize) {
        for axis in 0..3 {
            pairs.origin[axis][place] = self.origin[axis][ray];
            pairs.dir[axis][place] = self.dir[axis][ray];
            let corners = self.axes[ray][axis].of(rows);
            for (to, corner) in pairs.corners[axis].iter_mut().zip(corners) {
                to[place] = corner.0[lane % LANES];
            }
        }
    }
}
