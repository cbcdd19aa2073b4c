//! Boxes that are open to one side and meant to be looked into, as the Cornell box is.

use super::parts::each_part;
use glam::{DVec3, Vec3};
use heliostat_geometry::Aabb;
use heliostat_scene::{Material, Scene};

/// A triangle lies in a side of the box when its corners are at most this part of the box away from it.
const DEPTH: f32 = 0.06;

/// A side with at least this share covered is a wall.
const WALL: f64 = 0.5;

/// A side with at most this share covered is open.
const OPEN: f64 = 0.1;

/// The outward direction of the one open side, when the other five of the model's box are walls; front before back before
/// right before left. A box open to the top is a vessel, to be seen from outside.
pub(super) fn open_side(scene: &Scene, bounds: Aabb) -> Option<DVec3> {
    let covered = covered_shares(scene, bounds);
    let sides = [(2, 1), (2, 0), (0, 1), (0, 0)];
    sides.into_iter().find_map(|(axis, end)| {
        let is_open = covered[axis][end] <= OPEN;
        let walls = covered.iter().flatten().filter(|&&share| share >= WALL).count();
        let mut out = DVec3::ZERO;
        out[axis] = if end == 1 { 1.0 } else { -1.0 };
        (is_open && walls == 5).then_some(out)
    })
}

/// The share of each side of the box, by axis and end, that opaque triangles in it cover.
fn covered_shares(scene: &Scene, bounds: Aabb) -> [[f64; 2]; 3] {
    let mut covered = [[0.0; 2]; 3];
    let size = bounds.size();
    let sides = [size.y * size.z, size.z * size.x, size.x * size.y].map(f64::from);
    if size.min_element() <= 0.0 {
        return covered;
    }
    let mut cover = |corners: [Vec3; 3], area: DVec3| {
        let inward = |end: Vec3, axis: usize, p: Vec3| (p[axis] - end[axis]).abs() / size[axis];
        for axis in 0..3 {
            for (end, corner) in [bounds.min, bounds.max].into_iter().enumerate() {
                if corners.iter().all(|&p| inward(corner, axis, p) <= DEPTH) {
                    covered[axis][end] += 0.5 * area[axis].abs() / sides[axis];
                }
            }
        }
    };
    each_part(scene, &mut |part| {
        // Nobody builds walls of a thousand copies.
        let walls = part.triangles(scene).filter(|(material, ..)| !part.is_copy && is_opaque(material));
        walls.for_each(|(_, corners, area)| cover(corners, area));
    });
    covered
}

/// Glass and water are no walls.
fn is_opaque(material: &Material) -> bool {
    !material.surface.refracts() && material.opacity.factor >= 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_geometry::{Transform, TriMesh};
    use heliostat_scene::material::Phong;
    use heliostat_scene::object::Geometry;
    use heliostat_scene::{MaterialId, MeshId, Motion, Object};
    use std::sync::Arc;

    /// The sides of a box as a mesh, without those whose outward direction is in `open`.
    fn room(open: &[Vec3], size: Vec3, at: Vec3) -> Scene {
        let mut mesh = TriMesh::default();
        for axis in 0..3 {
            for end in [-0.5, 0.5] {
                let out = Vec3::AXES[axis] * end;
                if open.contains(&(2.0 * out)) {
                    continue;
                }
                let (u, v) = (0.5 * Vec3::AXES[(axis + 1) % 3], 0.5 * Vec3::AXES[(axis + 2) % 3]);
                let first = mesh.positions.len() as u32;
                mesh.positions
                    .extend([out - u - v, out + u - v, out + u + v, out - u + v].map(|p| p * size + at));
                mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            }
        }
        let material = Material::new("wall", Phong::default());
        let object = Object {
            name: "room".to_owned(),
            geometry: Geometry::Mesh(MeshId(0)),
            materials: vec![MaterialId(0)],
            motion: Motion::still(Transform::IDENTITY),
            visible: true,
            casts_shadow: true,
        };
        let meshes = vec![Arc::new(mesh)];
        Scene { meshes, materials: vec![material], objects: vec![object], ..Scene::default() }
    }

    fn open_side_of(scene: &Scene) -> Option<DVec3> {
        open_side(scene, scene.meshes[0].bounds())
    }

    #[test]
    fn the_open_side_is_found_at_any_size() {
        for out in [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::NEG_X] {
            for scale in [1e-3, 1.0, 1e5] {
                let meshes =
                    room(&[out], scale * Vec3::new(4.0, 2.0, 3.0), scale * Vec3::new(50.0, -7.0, 9.0));
                assert_eq!(open_side_of(&meshes), Some(out.as_dvec3()), "{out} {scale}");
            }
        }
    }

    #[test]
    fn closed_boxes_vessels_and_flat_models_are_seen_from_outside() {
        assert_eq!(open_side_of(&room(&[], Vec3::ONE, Vec3::ZERO)), None);
        assert_eq!(open_side_of(&room(&[Vec3::Y], Vec3::ONE, Vec3::ZERO)), None);
        assert_eq!(open_side_of(&room(&[Vec3::Z, Vec3::X], Vec3::ONE, Vec3::ZERO)), None);
        assert_eq!(open_side_of(&room(&[], Vec3::new(1.0, 0.0, 1.0), Vec3::ZERO)), None);
    }
}
