//! A bound never says of a ray that meets a thing that it does not.

use super::{Bound, BoxRay, FEW, FewBoxes};
use crate::world::place::Place;
use crate::world::solid::{Solid, Stock};
use glam::{DAffine3, DMat3, DQuat, DVec3, Vec2, Vec3};
use heliostat_geometry::shape::{Cone, Cuboid, Cylinder, Disk, Rectangle, Shape, Sphere, Torus};
use heliostat_geometry::{Aabb, Ray, Transform};
use heliostat_scene::Scene;
use heliostat_scene::object::Geometry;
use proptest::prelude::*;
use std::collections::HashMap;

fn vec3(range: f32) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-range..range).prop_map(Vec3::from_array)
}

fn shape() -> impl Strategy<Value = Shape> {
    prop::sample::select(vec![
        Shape::Sphere(Sphere { radius: 0.7 }),
        Shape::Cuboid(Cuboid { size: Vec3::new(0.2, 3.0, 1.0) }),
        Shape::Rectangle(Rectangle { size: Vec2::new(4.0, 0.1) }),
        Shape::Disk(Disk { radius: 1.0, inner_radius: 0.5 }),
        Shape::Cylinder(Cylinder { radius: 0.5, height: 2.0, capped: true }),
        Shape::Cone(Cone { radius: 0.5, top_radius: 0.1, height: 2.0, capped: true }),
        Shape::Torus(Torus { major: 1.0, minor: 0.2 }),
    ])
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_met_is_asked(
        shape in shape(),
        to in vec3(100.0),
        axis in vec3(1.0),
        even in any::<bool>(),
        scale in prop::array::uniform3(0.01_f64..10.0),
        u in prop::array::uniform2(0.0_f32..1.0),
        from in vec3(200.0),
        near in any::<bool>(),
        beyond in 0.5_f32..3.0,
    ) {
        let turn = DQuat::from_axis_angle(axis.as_dvec3().normalize_or(DVec3::Y), f64::from(axis.x) * 3.0);
        let scale = if even { DVec3::splat(scale[0]) } else { DVec3::from_array(scale) };
        let matrix3 = DMat3::from_quat(turn) * DMat3::from_diagonal(scale);
        let transform = Transform::new(DAffine3 { matrix3, translation: to.as_dvec3() }).unwrap();
        let geometry = Geometry::Shape(shape);
        let scene = Scene::default();
        let solid = Solid::new(&Stock { scene: &scene, trees: &[], groups: &HashMap::new() }, &geometry, Place::Still(&transform));

        // Through a point of its surface.
        let sample = shape.geometry().sample(Vec2::from_array(u)).unwrap();
        let target = transform.point(sample.p.as_vec3());
        let origin = if near { to + 0.01 * from } else { from };
        let ray = Ray::new(origin, target - origin).until(beyond);
        prop_assume!(ray.is_valid());
        if solid.blocks(&ray, 0.0) {
            prop_assert!(Bound::new(&solid).may_meet(&ray));
            prop_assert_eq!(FewBoxes::new(&[solid.bounds]).entries(&ray).may_meet, 1);
        }
    }

    /// All at once they say what each says alone.
    #[test]
    fn few_boxes_are_boxes(
        corners in prop::collection::vec((vec3(10.0), vec3(3.0)), 0..=FEW),
        from in vec3(20.0),
        dir in vec3(1.0),
        flat in 0..4_usize,
        end in prop_oneof![Just(f32::INFINITY), 0.0_f32..40.0],
    ) {
        // Some rays run along an axis, or in a plane.
        let dir = if flat < 3 { dir.with_x(0.0) } else { dir };
        let ray = Ray::new(from, dir).until(end);
        prop_assume!(ray.is_valid());
        let boxes: Vec<_> = corners.iter().map(|&(a, size)| Aabb { min: a, max: a + size.abs() }).collect();
        let entries = FewBoxes::new(&boxes).entries(&ray);
        for (i, bounds) in boxes.iter().enumerate() {
            let alone = BoxRay::new(&ray);
            prop_assert_eq!(entries.may_meet >> i & 1 == 1, alone.may_meet(bounds, end));
            for nearer in [0.25 * end, 0.5 * end] {
                let both = entries.may_meet >> i & 1 == 1 && entries.before(i, nearer);
                prop_assert!(both || !alone.may_meet(bounds, nearer));
            }
        }
        prop_assert_eq!(u32::from(entries.may_meet) >> boxes.len(), 0);
    }
}

#[test]
fn far_things_are_not_asked() {
    let geometry = Geometry::Shape(Shape::Cuboid(Cuboid { size: Vec3::ONE }));
    let scene = Scene::default();
    let solid = Solid::new(
        &Stock { scene: &scene, trees: &[], groups: &HashMap::new() },
        &geometry,
        Place::Still(&Transform::IDENTITY),
    );
    let bound = Bound::new(&solid);
    let from = Vec3::new(0.0, 0.0, 5.0);
    assert!(bound.may_meet(&Ray::new(from, Vec3::NEG_Z)));
    assert!(!bound.may_meet(&Ray::new(from, Vec3::Z)));
    // Through the ball, but past the box.
    assert!(!bound.may_meet(&Ray::new(Vec3::new(0.7, 0.0, 5.0), Vec3::NEG_Z)));
}
