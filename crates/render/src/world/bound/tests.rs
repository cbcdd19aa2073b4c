//! A bound never says of a ray that meets a thing that it does not.

use super::Bound;
use crate::world::place::Place;
use crate::world::solid::{Solid, Stock};
use glam::{DAffine3, DMat3, DQuat, DVec3, Vec2, Vec3};
use heliostat_geometry::shape::{Cone, Cuboid, Cylinder, Disk, Rectangle, Shape, Sphere, Torus};
use heliostat_geometry::{Ray, Transform};
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
        }
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
