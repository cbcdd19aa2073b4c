//! Whole pictures: groups against the flattened scene, and one thread against two.

use crate::common::{Stage, at, ball_mesh, cuboid, glass, grey, plane, sphere, white};
use crate::flat::{flatten, shiny};
use glam::{DAffine3, DVec3, Vec3};
use heliostat_geometry::Transform;
use heliostat_render::render;
use heliostat_scene::camera::{Camera, Projection};
use heliostat_scene::light::LightKind;
use heliostat_scene::material::Phong;
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::Layers;
use heliostat_scene::{Frame, Group, GroupId, Motion, Object, RenderSettings};

/// Glass that stands on a shelf, shares a face with it, and holds a ball; beside a lamp and a mirroring mesh; three times,
/// mirrored and stretched, over a floor.
fn stage() -> Stage {
    let mut stage = Stage::new().with_sky(0.2);
    let mesh = stage.mesh(ball_mesh(0.4, 8, true));
    let lamp = Phong { emission: grey(4.0), ..white() };
    let mut members = Vec::new();
    let mut member = |geometry, phong, place| members.push(stage.add(geometry, phong, place).clone());
    member(cuboid(4.0, 0.2, 2.0), white(), at(0.0, -0.1, 0.0));
    member(cuboid(0.8, 0.8, 0.8), glass(1.5), at(-1.0, 0.4, 0.0));
    member(sphere(0.2), white(), at(-1.0, 0.4, 0.0));
    member(mesh, shiny(), at(0.2, 0.4, 0.0));
    member(sphere(0.15), lamp, at(1.2, 1.0, 0.3));
    stage.scene.objects.clear();
    stage.scene.groups.push(Group::once("shelf", members));
    let placed = |name: &str, id, place| Object {
        name: name.into(),
        geometry: Geometry::Group(GroupId(id)),
        materials: vec![],
        motion: Motion::still(place),
        visible: true,
        casts_shadow: true,
    };
    let places = [0.0, 1.6, 3.2].map(|y| DAffine3::from_translation(DVec3::new(0.0, y, 0.0)));
    let stretch = Transform::scaling(Vec3::new(-1.0, 1.2, 0.8)).unwrap();
    let shelves = vec![placed("shelf", 0, stretch)];
    stage.scene.groups.push(Group { name: "shelves".into(), objects: shelves, places: places.to_vec() });
    stage.add(plane(), white(), at(0.0, -0.5, 0.0));
    stage.scene.objects.push(placed("shelves", 1, Transform::rotation_xyz(Vec3::new(0.0, 0.4, 0.0))));
    let front = Transform::look_at(Vec3::new(1.0, 4.0, 9.0), Vec3::new(0.0, 1.8, 0.0), Vec3::Y).unwrap();
    stage.scene.cameras.push(Camera {
        name: "front".into(),
        motion: Motion::still(front.matrix()),
        projection: Projection::Perspective { fov_y: 0.7 },
        focus: None,
    });
    stage.settings = RenderSettings {
        width: 48,
        height: 48,
        samples: 2,
        transparent_shadows: true,
        layers: Layers::ALL,
        ..RenderSettings::default()
    };
    stage.with_light(0.2, 1, LightKind::Ambient)
}

fn values(frame: &Frame) -> Vec<(String, Vec<u32>)> {
    let channels = frame.channels.iter();
    channels.map(|c| (c.name.clone(), c.values.iter().map(|v| v.to_bits()).collect())).collect()
}

#[test]
fn a_picture_of_groups_is_that_of_the_flattened_scene() {
    let stage = stage();
    let grouped = render(&stage.scene, &stage.settings).unwrap();
    let flat = flatten(&stage.scene, 0.0).unwrap();
    let flattened = render(&flat.stage.scene, &stage.settings).unwrap();
    let ids = |frame: &Frame| frame.channel("object_id.Y").unwrap().values.clone();
    // All of the shelves bears the name of the object that places them.
    for (got, expected) in ids(&grouped).into_iter().zip(ids(&flattened)) {
        let origin = if expected == 0.0 { 0.0 } else { (flat.origins[expected as usize - 1].0 + 1) as f32 };
        assert_eq!(got, origin);
    }
    for name in ["Z", "N.X", "N.Y", "N.Z", "P.X", "UV.U", "material_id.Y", "albedo.R"] {
        assert_eq!(grouped.channel(name).unwrap().values, flattened.channel(name).unwrap().values, "{name}");
    }
    for name in ["R", "G", "B", "A"] {
        let (got, expected) = (grouped.channel(name).unwrap(), flattened.channel(name).unwrap());
        for (i, (got, expected)) in got.values.iter().zip(&expected.values).enumerate() {
            // Light through several panes is multiplied in another order.
            let near = (got - expected).abs() <= 1e-4 * expected.abs();
            assert!(near, "{name} of pixel {i}: {got} for {expected}");
        }
    }
}

#[test]
fn threads_leave_no_trace_in_groups() {
    let mut stage = stage();
    stage.scene.objects[1].motion = Motion::through(vec![at(0.0, 0.0, 0.0), at(0.3, 0.1, 0.0)]).unwrap();
    stage.scene.groups[0].objects[3].motion =
        Motion::through(vec![at(0.2, 0.4, 0.0), at(0.2, 0.9, 0.0)]).unwrap();
    let with = |threads| render(&stage.scene, &RenderSettings { threads, ..stage.settings.clone() }).unwrap();
    assert_eq!(values(&with(1)), values(&with(2)));
}
