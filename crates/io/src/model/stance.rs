//! How a model stands: which way is up, and which side it shows.
//!
//! OBJ has no word for either. Most files are y up with their front to +z, but many scanners and printers write z up. A
//! model that would topple on its y side and stands firmly on its z side is taken to be one of these.

use super::doubled_areas;
use glam::{DVec2, DVec3};
use heliostat_geometry::{Aabb, TriMesh};
use std::sync::Arc;

/// A model thinner than this part of its longest side is flat.
const FLAT: f32 = 0.05;

/// What lies lower than this part of the height touches the ground.
const CONTACT: f64 = 0.04;

/// Feet that span less than this part of the footprint hold nothing.
const FOOTING: f64 = 0.05;

/// Which way a model stands and looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stance {
    /// Unit vector.
    pub(super) up: DVec3,
    /// Unit vector at a right angle to `up`, from the model to whoever looks at its face.
    pub(super) front: DVec3,
    /// Angle in radians to walk around from the front, counter-clockwise seen from above.
    pub(super) azimuth: f64,
    /// Angle in radians from which to look down.
    pub(super) elevation: f64,
}

impl Stance {
    /// That of a glTF model: y is up and its front faces z, as the format says.
    pub(super) fn of_gltf(bounds: Aabb) -> Self {
        /// Depth over width or height below which all there is to see is in front.
        const SHALLOW: f32 = 0.3;
        let size = bounds.size();
        let is_shallow = size.z < SHALLOW * size.x.max(size.y);
        let is_floor = size.y < FLAT * size.max_element();
        let (azimuth, elevation): (f64, f64) = match (is_floor, is_shallow) {
            (true, _) => (30.0, 40.0),
            (false, true) => (0.0, 0.0),
            (false, false) => (25.0, 15.0),
        };
        let (azimuth, elevation) = (azimuth.to_radians(), elevation.to_radians());
        Self { up: DVec3::Y, front: DVec3::Z, azimuth, elevation }
    }

    /// Long models are seen more from their side.
    fn turned_to_the_long_side(self, size: DVec3) -> Self {
        /// Depth over width from which a model is long.
        const LONG: f64 = 1.3;
        let width = size.dot(self.up.cross(self.front).abs());
        let is_long = size.dot(self.front.abs()) > LONG * width;
        Self { azimuth: if is_long { 60_f64.to_radians() } else { self.azimuth }, ..self }
    }
}

/// The stance of a model in `bounds`.
pub(super) fn stance(meshes: &[Arc<TriMesh>], bounds: Aabb) -> Stance {
    let size = bounds.size();
    let is_flat = |axis: usize| size[axis] < FLAT * size.max_element();
    let facing = |axis: usize| if mean_normal(meshes)[axis] < 0.0 { -1.0 } else { 1.0 };
    let usual = Stance {
        up: DVec3::Y,
        front: DVec3::Z,
        azimuth: 30_f64.to_radians(),
        elevation: 20_f64.to_radians(),
    };
    if is_flat(1) {
        // A floor: look down on it.
        Stance { elevation: 40_f64.to_radians(), ..usual }
    } else if is_flat(0) {
        Stance { front: facing(0) * DVec3::X, ..usual }
    } else if is_flat(2) {
        Stance { front: facing(2) * DVec3::Z, ..usual }
    } else if !stands(meshes, bounds, 1) && stands(meshes, bounds, 2) {
        Stance { up: DVec3::Z, front: DVec3::NEG_Y, ..usual }.turned_to_the_long_side(size.as_dvec3())
    } else {
        usual.turned_to_the_long_side(size.as_dvec3())
    }
}

/// Sum over all triangles of twice their area times their normal.
fn mean_normal(meshes: &[Arc<TriMesh>]) -> DVec3 {
    meshes.iter().flat_map(|mesh| doubled_areas(mesh)).map(|(_, normal)| normal).sum()
}

/// Whether the model stands firmly when `axis` points up: its centre of area is above the hull of what touches the ground.
fn stands(meshes: &[Arc<TriMesh>], bounds: Aabb, axis: usize) -> bool {
    let flat = |p: DVec3| DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    let low = f64::from(bounds.min[axis]) + CONTACT * f64::from(bounds.size()[axis]);
    let points = meshes.iter().flat_map(|mesh| &mesh.positions).map(|p| p.as_dvec3());
    let hull = convex_hull(points.filter(|p| p[axis] <= low).map(flat).collect());
    let size = flat(bounds.size().as_dvec3());
    let edges = || hull.iter().zip(hull.iter().cycle().skip(1));
    let area: f64 = edges().map(|(a, b)| 0.5 * (*a - hull[0]).perp_dot(*b - hull[0])).sum();
    let centre = flat(centre_of_area(meshes));
    area >= FOOTING * size.x * size.y && edges().all(|(a, b)| (*b - *a).perp_dot(centre - *a) >= 0.0)
}

fn centre_of_area(meshes: &[Arc<TriMesh>]) -> DVec3 {
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for (corners, doubled) in meshes.iter().flat_map(|mesh| doubled_areas(mesh)) {
        let area = doubled.length();
        sum += area * corners.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / 3.0;
        total += area;
    }
    if total > 0.0 { sum / total } else { sum }
}

/// The corners of the convex hull, counter-clockwise.
///
/// # Source
/// Andrew, "Another Efficient Algorithm for Convex Hulls in Two Dimensions", Information Processing Letters 1979.
fn convex_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let mut hull: Vec<DVec2> = Vec::new();
    let mut half = |points: &mut dyn Iterator<Item = &DVec2>| {
        let start = hull.len();
        for &p in points {
            while let [.., a, b] = hull[start..] {
                if (b - a).perp_dot(p - a) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
    };
    half(&mut points.iter());
    half(&mut points.iter().rev());
    hull
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// A box around `centre` with the given half sides.
    fn block(centre: Vec3, half: Vec3) -> TriMesh {
        let positions = Aabb { min: centre - half, max: centre + half }.corners().to_vec();
        // Corners are numbered by bits: x 1, y 2, z 4.
        let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let triangles = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
        TriMesh { positions, triangles, ..TriMesh::default() }
    }

    /// A table whose legs point down along `down`, with a thing on it that would pull it over sideways.
    fn table(turn: impl Fn(Vec3) -> Vec3, scale: f32) -> Vec<Arc<TriMesh>> {
        let mut parts = vec![block(Vec3::ZERO, Vec3::new(1.0, 0.1, 1.0))];
        for (x, z) in [(-0.8, -0.8), (-0.8, 0.8), (0.8, -0.8), (0.8, 0.8)] {
            parts.push(block(Vec3::new(x, -0.7, z), Vec3::new(0.05, 0.6, 0.05)));
        }
        // On one edge alone: on its side the table would stand on this corner.
        parts.push(block(Vec3::new(0.0, 0.3, 1.3), Vec3::new(0.1, 0.05, 0.1)));
        parts.push(block(Vec3::new(0.0, 0.3, -1.3), Vec3::new(0.1, 0.05, 0.1)));
        for part in &mut parts {
            part.positions.iter_mut().for_each(|p| *p = scale * (turn(*p) + Vec3::new(3.0, 5.0, 7.0)));
        }
        parts.into_iter().map(Arc::new).collect()
    }

    fn stance_of(meshes: &[Arc<TriMesh>]) -> Stance {
        stance(meshes, meshes.iter().fold(Aabb::EMPTY, |all, mesh| all.union(mesh.bounds())))
    }

    #[test]
    fn what_stands_on_its_legs_along_z_has_z_up() {
        for scale in [1e-3, 1.0, 1e5] {
            assert_eq!(stance_of(&table(|p| p, scale)).up, DVec3::Y, "{scale}");
            let z_up = stance_of(&table(|p| Vec3::new(p.x, -p.z, p.y), scale));
            assert_eq!((z_up.up, z_up.front), (DVec3::Z, DVec3::NEG_Y), "{scale}");
        }
    }

    #[test]
    fn what_stands_every_way_or_none_has_y_up() {
        let cube = [Arc::new(block(Vec3::ONE, Vec3::ONE))];
        assert_eq!(stance_of(&cube).up, DVec3::Y);
    }

    #[test]
    fn long_models_are_seen_from_their_side() {
        let of = |half: Vec3| stance_of(&[Arc::new(block(Vec3::ONE, half))]).azimuth.to_degrees().round();
        assert_eq!(of(Vec3::new(1.0, 1.0, 2.0)), 60.0);
        assert_eq!(of(Vec3::new(2.0, 1.0, 1.0)), 30.0);
        assert_eq!(of(Vec3::new(1.0, 5.0, 1.0)), 30.0);
    }

    #[test]
    fn flat_models_show_their_face() {
        let sheet = |axis: usize| {
            let half = Vec3::ONE.with_x(1.0) - 0.999 * Vec3::AXES[axis];
            stance_of(&[Arc::new(block(Vec3::ZERO, half))])
        };
        assert_eq!(sheet(0).front, DVec3::X);
        assert!(sheet(1).elevation > sheet(2).elevation);
        let facing_back = TriMesh {
            positions: vec![Vec3::ZERO, Vec3::Y, Vec3::X],
            triangles: vec![[0, 1, 2]],
            ..TriMesh::default()
        };
        assert_eq!(stance_of(&[Arc::new(facing_back)]).front, DVec3::NEG_Z);
    }

    #[test]
    fn the_hull_of_a_grid_is_its_border() {
        let grid = (0..25).map(|i| DVec2::new(f64::from(i % 5), f64::from(i / 5))).collect();
        let hull = convex_hull(grid);
        assert_eq!(hull, [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(DVec2::from));
        assert!(convex_hull(vec![DVec2::ONE; 3]).len() < 3);
    }
}
