//! The exact distances of many triangles along as many rays, one operation after the other for all of them.
//!
//! These are plain loops over columns, of which the compiler makes vector instructions. Each operation is that of
//! [`triangle`](crate::triangle), none is fused with another, so the numbers are the same, to the bit.

use crate::error_bound::least_area;

/// So many at a time.
pub const PAIRS: usize = 64;

/// So many are worked out as there are lanes at most; what is too much is thrown away.
const LANES: usize = 16;

type Column = [f32; PAIRS];

/// Pairs of a ray and a triangle, with coordinates in the order of [`TriangleRay::origin`](crate::triangle::TriangleRay::origin).
#[derive(Clone, Debug)]
pub struct Pairs {
    /// The origins of the rays, by axis.
    pub origin: [Column; 3],
    /// Their directions, by axis.
    pub dir: [Column; 3],
    /// The corners of the triangles, by axis and corner.
    pub corners: [[Column; 3]; 3],
}

/// Where the ray of each pair meets the triangle.
#[derive(Clone, Debug)]
pub struct PairHits {
    /// Ray parameters.
    pub t: Column,
    /// Weights of the corners a, b, c.
    pub barycentric: [Column; 3],
    /// Not 0 where this is what [`intersect`](crate::triangle::intersect) says, but for the range and where `t` is not above 0;
    /// elsewhere only that can tell.
    pub is_sure: [u32; PAIRS],
}

impl Pairs {
    /// Room for pairs.
    pub const EMPTY: Self =
        Self { origin: [[0.0; PAIRS]; 3], dir: [[0.0; PAIRS]; 3], corners: [[[0.0; PAIRS]; 3]; 3] };
}

impl PairHits {
    /// Room for hits.
    pub const EMPTY: Self = Self { t: [0.0; PAIRS], barycentric: [[0.0; PAIRS]; 3], is_sure: [0; PAIRS] };

    /// Intersects the first `count` pairs; of triangles that have an area, and that the test in `f32` sees the ray inside of.
    #[inline(always)]
    pub fn intersect(&mut self, pairs: &Pairs, count: usize) {
        let count = count.next_multiple_of(LANES).min(PAIRS);
        self.intersect_inside(pairs, count);
        self.doubt_edges(pairs, count);
    }

    /// What [`intersect_inside`](crate::triangle::intersect_inside) does.
    #[inline(always)]
    fn intersect_inside(&mut self, pairs: &Pairs, count: usize) {
        let [[ax, bx, cx], [ay, by, cy], [az, bz, cz]] = &pairs.corners;
        let ([ox, oy, oz], [dx, dy, dz]) = (&pairs.origin, &pairs.dir);
        for i in 0..count {
            let from = |corner: &Column, origin: &Column| f64::from(corner[i]) - f64::from(origin[i]);
            let (az, bz, cz) = (from(az, oz), from(bz, oz), from(cz, oz));
            let inverse = 1.0 / f64::from(dz[i]);
            let slope = f64::from(dx[i]) * inverse;
            let (ax, bx, cx) =
                (from(ax, ox) - slope * az, from(bx, ox) - slope * bz, from(cx, ox) - slope * cz);
            let slope = f64::from(dy[i]) * inverse;
            let (ay, by, cy) =
                (from(ay, oy) - slope * az, from(by, oy) - slope * bz, from(cy, oy) - slope * cz);
            let [p, q, r] = [cx * by, ax * cy, bx * ay];
            let [u, v, w] = [p - cy * bx, q - ay * cx, r - by * ax];
            let differ = (u.to_bits() ^ v.to_bits()) | (u.to_bits() ^ w.to_bits());
            let is_inside = differ >> (u64::BITS - 1) == 0;
            let area = u + v + w;
            let is_sharp = area.abs() > least_area(p.abs() + q.abs() + r.abs());
            let scale = 1.0 / area;
            let [u, v, w] = [u * scale, v * scale, w * scale];
            let t = ((u * az + v * bz + w * cz) * inverse) as f32;
            self.t[i] = t;
            self.barycentric[0][i] = u as f32;
            self.barycentric[1][i] = v as f32;
            self.barycentric[2][i] = w as f32;
            self.is_sure[i] = u32::from(is_inside & is_sharp & (t.abs() < f32::INFINITY));
        }
    }

    /// Is not sure where the test in `f32` sees an edge on the ray: then the ray may miss by what it is rounded.
    #[inline(always)]
    fn doubt_edges(&mut self, pairs: &Pairs, count: usize) {
        let [[ax, bx, cx], [ay, by, cy], [az, bz, cz]] = &pairs.corners;
        let ([ox, oy, oz], [dx, dy, dz]) = (&pairs.origin, &pairs.dir);
        for i in 0..count {
            let from = |corner: &Column, origin: &Column| corner[i] - origin[i];
            let (az, bz, cz) = (from(az, oz), from(bz, oz), from(cz, oz));
            let slope = dx[i] / dz[i];
            let (ax, bx, cx) =
                (from(ax, ox) - slope * az, from(bx, ox) - slope * bz, from(cx, ox) - slope * cz);
            let slope = dy[i] / dz[i];
            let (ay, by, cy) =
                (from(ay, oy) - slope * az, from(by, oy) - slope * bz, from(cy, oy) - slope * cz);
            let [u, v, w] = [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax];
            self.is_sure[i] &= u32::from((u != 0.0) & (v != 0.0) & (w != 0.0));
        }
    }
}
