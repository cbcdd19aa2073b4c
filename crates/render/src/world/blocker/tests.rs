//! Verdicts in lanes against the exact test of the shape, ray by ray.

use crate::lanes::{LANES, Vec3Lanes, holds, lanes_of};
use crate::world::place::Place;
use crate::world::shadow_rays::ShadowRays;
use crate::world::solid::{Solid, Stock};
use glam::{DAffine3, DMat3, DQuat, Vec3};
use heliostat_geometry::shape::{Cuboid, Shape, Sphere};
use heliostat_geometry::{SurfacePoint, Transform};
use heliostat_scene::Scene;
use heliostat_scene::object::Geometry;
use proptest::prelude::*;
use std::collections::HashMap;

fn vec3(range: f32) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-range..range).prop_map(Vec3::from_array)
}

/// Turned, moved and scaled, alike in all directions or not.
fn place(even: bool) -> impl Strategy<Value = Transform> {
    let scale = prop::array::uniform3(prop_oneof![0.01_f64..0.1, 0.2..3.0, 10.0..1000.0]);
    (vec3(10.0), vec3(1.0), scale, any::<bool>()).prop_map(move |(to, axis, [x, y, z], mirrored)| {
        let turn =
            DQuat::from_axis_angle(axis.as_dvec3().normalize_or(glam::DVec3::Y), f64::from(axis.x) * 3.0);
        let sign = if mirrored { -1.0 } else { 1.0 };
        let scale = if even { glam::DVec3::splat(x) } else { glam::DVec3::new(sign * x, y, z) };
        let matrix3 = DMat3::from_quat(turn) * DMat3::from_diagonal(scale);
        Transform::new(DAffine3 { matrix3, translation: to.as_dvec3() }).unwrap()
    })
}

/// Points in the space of the shape: anywhere, near the surface of the unit sphere or box, or inside.
fn local_point() -> impl Strategy<Value = Vec3> {
    let near = || (vec3(1.0), prop::sample::select(vec![1.0_f32, 1.0 + 1e-6, 1.0 - 1e-6, 1.01, 0.99]));
    prop_oneof![
        3 => vec3(6.0),
        1 => vec3(1.0),
        1 => near().prop_map(|(v, r)| r * v.normalize_or(Vec3::Y)),
        1 => near().prop_map(|(v, r)| r * v / v.abs().max_element().max(1e-3)),
    ]
}

/// Lanes in doubt of how many, and an error where a verdict is wrong.
fn check(shape: Shape, transform: &Transform, start: Vec3, targets: &[Vec3]) -> Result<usize, TestCaseError> {
    let geometry = Geometry::Shape(shape);
    let scene = Scene::default();
    let solid = Solid::new(
        &Stock { scene: &scene, trees: &[], groups: &HashMap::new() },
        &geometry,
        Place::Still(transform),
    );
    let ng = (transform.point(targets[0]) - transform.point(start)).normalize_or(Vec3::Y);
    let start = SurfacePoint { p: transform.point(start), p_err: Vec3::ZERO, ng }.departure();
    let mut lanes = Vec3Lanes::splat(Vec3::ZERO);
    (0..LANES).for_each(|lane| lanes.set(lane, transform.point(targets[lane % targets.len()])));
    let reach =
        (0..LANES).fold(Vec3::ZERO, |reach, lane| reach.max((lanes.get(lane) - start.origin()).abs()));
    let rays = ShadowRays { start, targets: &lanes, reach, wanted: u16::MAX };
    let verdict = solid.verdict(&rays);
    prop_assert_eq!(verdict.hit & verdict.doubt, 0);
    for lane in lanes_of(!verdict.doubt) {
        let expected = solid.blocks(&rays.ray(lane), 0.0);
        prop_assert_eq!(holds(verdict.hit, lane), expected, "lane {}: {:?}", lane, rays.ray(lane));
    }
    Ok(verdict.doubt.count_ones() as usize)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn spheres_are_as_the_exact_test_says(
        transform in place(true),
        start in local_point(),
        targets in prop::collection::vec(local_point(), LANES),
    ) {
        check(Shape::Sphere(Sphere { radius: 1.0 }), &transform, start, &targets)?;
    }

    #[test]
    fn boxes_are_as_the_exact_test_says(
        transform in place(false),
        start in local_point(),
        targets in prop::collection::vec(local_point(), LANES),
    ) {
        check(Shape::Cuboid(Cuboid { size: Vec3::splat(2.0) }), &transform, start, &targets)?;
    }
}

#[test]
fn few_rays_are_in_doubt() {
    // From far above, past and through the shape, to a grid of points below.
    let start = Vec3::new(0.3, 7.0, 0.2);
    let grid = |row: usize| {
        (0..LANES)
            .map(move |i| Vec3::new(i as f32 * 0.31 - 2.3, -4.0, row as f32 * 0.037 - 2.3))
            .collect::<Vec<_>>()
    };
    for shape in [Shape::Sphere(Sphere { radius: 1.0 }), Shape::Cuboid(Cuboid { size: Vec3::splat(2.0) })] {
        let doubts = |row| check(shape, &Transform::IDENTITY, start, &grid(row)).unwrap();
        let doubts: usize = (0..125).map(doubts).sum();
        assert!(doubts < 5, "{shape:?}: {doubts} of 2000");
    }
}

#[test]
fn a_start_inside_a_sphere_meets_it_once() {
    let targets = [Vec3::new(0.0, 9.0, 0.0), Vec3::new(0.5, -3.0, 2.0), Vec3::new(0.1, 0.2, 0.3)];
    let shape = Shape::Sphere(Sphere { radius: 1.0 });
    // The last target lies inside as well and is left to the exact test.
    assert_eq!(check(shape, &Transform::IDENTITY, Vec3::new(0.2, 0.1, 0.0), &targets).unwrap(), 5);
}
