//! A cut stone: the round brilliant of jewellers, with the proportions that Tolkowsky worked out for diamond.
//!
//! # Source
//! Tolkowsky, "Diamond Design", 1919: table 53 %, crown 16.2 % and pavilion 43.1 % of the diameter.

use super::obj::Mesh;
use glam::DVec3;
use std::f64::consts::TAU;

/// The radius of the girdle is 1, its upper edge lies at y = 0.
const TABLE: f64 = 0.53;
const CROWN: f64 = 0.324;
const PAVILION: f64 = 0.862;
const GIRDLE: f64 = 0.04;
/// Radii at which the facets beside the main ones end.
const STAR: f64 = 0.76;
const LOWER: f64 = 0.24;

/// The stone with its table up: 8 main facets on both sides and those between them.
pub(super) fn brilliant() -> Mesh {
    let mut mesh = Mesh::default();
    // Main facets are planes through the table or the tip and the girdle; where others end on them follows.
    let along = |radius: f64| radius * (TAU / 16.0).cos();
    let crown = |r: f64| CROWN * (1.0 - r) / (1.0 - TABLE);
    let table = mesh.ring(8, 0.0, TABLE, CROWN);
    let star = mesh.ring(8, 0.5, STAR, crown(along(STAR)));
    let upper = mesh.ring(16, 0.0, 1.0, 0.0);
    let under = mesh.ring(16, 0.0, 1.0, -GIRDLE);
    let lower = mesh.ring(8, 0.5, LOWER, -GIRDLE - PAVILION * (1.0 - along(LOWER)));
    let tip = mesh.positions.len();
    mesh.positions.push(DVec3::new(0.0, -GIRDLE - PAVILION, 0.0));
    let mut face = |corners: &[usize]| {
        let fan = corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]);
        mesh.triangles.extend(fan);
    };
    face(&(0..8).map(&table).collect::<Vec<_>>());
    for k in 0..8 {
        let (main, next) = (2 * k, 2 * k + 1);
        face(&[table(k), star(k + 7), upper(main), star(k)]);
        face(&[table(k), star(k), table(k + 1)]);
        face(&[star(k), upper(main), upper(next)]);
        face(&[star(k), upper(next), upper(next + 1)]);
        face(&[lower(k), under(next), under(main)]);
        face(&[lower(k), under(next + 1), under(next)]);
        face(&[tip, lower(k), under(main), lower(k + 7)]);
    }
    for k in 0..16 {
        face(&[upper(k), under(k), under(k + 1), upper(k + 1)]);
    }
    mesh
}

impl Mesh {
    /// Adds corners around y, counterclockwise seen from above, turned by a part of a step; the index of each, around and around.
    fn ring(&mut self, count: usize, turned: f64, radius: f64, y: f64) -> impl Fn(usize) -> usize + use<> {
        let first = self.positions.len();
        self.positions.extend((0..count).map(|k| {
            let (sin, cos) = (TAU * (k as f64 + turned) / count as f64).sin_cos();
            DVec3::new(radius * sin, y, radius * cos)
        }));
        move |k| first + k % count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stone_is_closed_convex_and_faces_outward() {
        let Mesh { positions, triangles } = brilliant();
        for &[a, b, c] in &triangles {
            let [p, q, r] = [a, b, c].map(|i| positions[i]);
            let normal = (q - p).cross(r - p).normalize();
            assert!(positions.iter().all(|&other| normal.dot(other - p) < 1e-9), "{a} {b} {c}");
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let turned = |t: &&[usize; 3]| (0..3).any(|i| (t[i], t[(i + 1) % 3]) == (to, from));
                assert_eq!(triangles.iter().filter(turned).count(), 1, "{from} {to}");
            }
        }
    }
}
