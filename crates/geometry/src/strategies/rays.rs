//! Rays: random ones, and those that find weak spots.

use super::numbers::{direction, point};
use crate::aabb::Aabb;
use crate::mesh::TriMesh;
use crate::ray::Ray;
use glam::Vec3;
use proptest::prelude::*;

/// A ray of everyday size in any direction, axis-parallel ones often.
pub fn ray() -> impl Strategy<Value = Ray> {
    (point(), direction()).prop_map(|(origin, dir)| Ray::new(origin, dir))
}

/// A ray around a box: towards it from outside, from inside, along its middle planes and faces, through its corners.
pub fn ray_in_box(bounds: Aabb) -> impl Strategy<Value = Ray> {
    let place = [-0.5_f32..1.5, -0.5_f32..1.5, -0.5_f32..1.5].prop_map(Vec3::from_array);
    // Fractions of the box at which a tree likes to split.
    let split = prop_oneof![Just(0.0_f32), Just(1.0), Just(0.5), Just(0.25), Just(0.75), Just(0.125)];
    let at = move |f: Vec3| bounds.min + f * bounds.size();
    let to_inside = (place.clone(), [0.0_f32..1.0, 0.0_f32..1.0, 0.0_f32..1.0])
        .prop_map(move |(from, to)| (at(from), at(Vec3::from_array(to)) - at(from)));
    let anywhere = (place.clone(), direction()).prop_map(move |(from, dir)| (at(from), dir));
    let in_plane =
        (place, direction(), 0_usize..3, split.clone()).prop_map(move |(from, mut dir, axis, split)| {
            let mut from = at(from);
            from[axis] = at(Vec3::splat(split))[axis];
            dir[axis] = 0.0;
            (from, dir)
        });
    let through_lattice =
        ([split.clone(), split.clone(), split.clone()], [split.clone(), split.clone(), split]).prop_map(
            move |(a, b)| {
                let (a, b) = (at(Vec3::from_array(a)), at(Vec3::from_array(b)));
                (2.0 * a - b, b - a)
            },
        );
    prop_oneof![3 => to_inside, 2 => anywhere, 2 => in_plane, 1 => through_lattice]
        .prop_filter("a direction must not be zero", |(_, dir)| *dir != Vec3::ZERO)
        .prop_map(|(origin, dir)| Ray::new(origin, dir))
}

/// A ray at a mesh: as [`ray_in_box`], at a vertex, at a point of an edge, along an edge, or starting on a vertex.
pub fn ray_at_mesh(mesh: &TriMesh) -> impl Strategy<Value = Ray> + use<> {
    let (mesh, bounds) = (mesh.clone(), mesh.bounds());
    let index = any::<proptest::sample::Index>();
    let aimed = (index, 0_usize..3, 0.0_f32..1.0, point(), 0_u8..5).prop_filter_map(
        "a direction must not be zero",
        move |(index, side, along, from, kind)| {
            let corners = mesh.corners(index.index(mesh.triangles.len()) as u32);
            let (a, b) = (corners[side], corners[(side + 1) % 3]);
            let origin = bounds.centre() + from * bounds.radius().max(f32::MIN_POSITIVE);
            let (origin, dir) = match kind {
                0 => (origin, a - origin),
                1 => (origin, a.lerp(b, along) - origin),
                2 => (2.0 * a - b, b - a),
                3 => (a, from),
                _ => (bounds.centre(), a - bounds.centre()),
            };
            let ray = Ray::new(origin, dir);
            ray.is_valid().then_some(ray)
        },
    );
    prop_oneof![1 => ray_in_box(bounds), 1 => aimed]
}
