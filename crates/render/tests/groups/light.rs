//! What shines in groups lights the scene.

use crate::common::{Looker, Stage, assert_close, at, black, grey, plane, rectangle, sphere, white};
use glam::{DAffine3, DVec3, Vec3};
use heliostat_geometry::Transform;
use heliostat_render::{World, WorldError};
use heliostat_scene::material::Phong;
use heliostat_scene::object::Geometry;
use heliostat_scene::{Group, GroupId, Motion, RenderSettings};

/// A floor under a group of a lamp in a group, `copies` times; and the same flattened.
fn stages(lamp: &Geometry, copies: u32) -> [Stage; 2] {
    let shine = || Phong { emission: grey(3.0), ..black() };
    let floor = || Stage::new().with(plane(), white(), Transform::IDENTITY);
    let (inner, outer) = (at(0.5, 1.0, 0.0), Transform::scaling(Vec3::new(1.0, 2.0, -1.0)).unwrap());
    let places: Vec<_> =
        (0..copies).map(|i| DAffine3::from_translation(DVec3::new(f64::from(i), 0.0, 0.5))).collect();
    let (mut grouped, mut flat) = (floor(), floor());
    let mut object = grouped.add(lamp.clone(), shine(), inner).clone();
    grouped.scene.groups.push(Group {
        name: "lamps".into(),
        objects: vec![object.clone()],
        places: places.clone(),
    });
    (object.geometry, object.motion) = (Geometry::Group(GroupId(0)), Motion::still(outer));
    object.materials.clear();
    grouped.scene.objects[1] = object;
    for place in places {
        let place = inner.then(&Transform::new(place).unwrap()).and_then(|place| place.then(&outer)).unwrap();
        flat.add(lamp.clone(), shine(), place);
    }
    [grouped, flat]
}

#[test]
fn lamps_in_groups_give_the_light_of_lamps() {
    for (lamp, copies) in [(sphere(0.2), 1), (rectangle(0.5, 0.5), 3), (sphere(0.3), 2)] {
        let [grouped, flat] = stages(&lamp, copies);
        for x in [-2.0_f32, 0.0, 0.5, 3.0] {
            let look = |stage: &Stage| stage.grey(Vec3::new(x, 0.5, 3.0), Vec3::new(x, 0.0, 0.2));
            assert!(look(&flat) > 0.01);
            assert_close(look(&grouped), look(&flat), 1e-4);
        }
    }
}

#[test]
fn a_lamp_that_moves_with_its_group_lights_from_where_it_is() {
    let [mut stage, _] = stages(&sphere(0.2), 1);
    stage.scene.objects[1].motion = Motion::through(vec![at(-5.0, 1.0, 0.0), at(5.0, 1.0, 0.0)]).unwrap();
    let looker = Looker::new(&stage);
    let lit = |time: f32, x: f32| {
        let dir = Vec3::new(0.0, -0.5, -0.2);
        let ray = heliostat_geometry::Ray::new(Vec3::new(x, 0.5, 0.2), dir);
        let ray = heliostat_render::CameraRay {
            ray,
            time,
            eye: ray.origin,
            forward: dir,
            cone: heliostat_render::RayCone::POINT,
        };
        let mut sampler = heliostat_render::Sampler::new(0, [0, 0], 0);
        let integrator = heliostat_render::integrator::create(&stage.settings);
        integrator.radiance(&looker.world, &ray, &mut sampler, &mut Default::default()).radiance.y
    };
    assert!(lit(0.0, -4.5) > 10.0 * lit(0.0, 5.5));
    assert!(lit(1.0, 5.5) > 10.0 * lit(1.0, -4.5));
}

#[test]
fn more_lamps_than_can_be_asked_are_refused() {
    let [stage, _] = stages(&sphere(0.2), 1025);
    let error = World::new(&stage.scene, &RenderSettings::default()).unwrap_err();
    let WorldError::Scene(issues) = error else { panic!("{error}") };
    assert!(issues[0].to_string().starts_with("object `object 1`: groups bring 1025 things that shine"));
}
