//! Groups are shared: what there is of them does not grow with what they show.

use crate::common::{Looker, Stage, ball_mesh, white};
use glam::{DAffine3, DVec3, Vec3};
use heliostat_geometry::{Ray, Transform};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Census, Group, GroupId, Motion};

/// Ten levels of ten copies each: ten thousand million balls.
#[test]
fn ten_thousand_million_meshes_take_no_room() {
    let mut stage = Stage::new();
    let mesh = stage.mesh(ball_mesh(0.4, 6, true));
    let mut inner = stage.add(mesh, white(), Transform::IDENTITY).clone();
    let mut pitch = 1.0;
    for level in 0..10_u32 {
        let axis = DVec3::AXES[level as usize % 3];
        let places = (0..10).map(|i| DAffine3::from_translation(pitch * f64::from(i) * axis)).collect();
        stage.scene.groups.push(Group {
            name: format!("level {level}"),
            objects: vec![inner.clone()],
            places,
        });
        inner.geometry = Geometry::Group(GroupId(level));
        inner.materials.clear();
        inner.motion = Motion::still(Transform::IDENTITY);
        if level % 3 == 2 {
            pitch *= 10.0;
        }
    }
    stage.scene.objects = vec![inner];
    let census = Census::new(&stage.scene).unwrap();
    let tally = census.group(GroupId(9));
    assert_eq!((tally.parts, tally.triangles), (10_000_000_000, 1_200_000_000_000));
    let looker = Looker::new(&stage);
    // The ball at (4321, 210, 987): its number follows from how the levels lie in one another.
    let ball = Vec3::new(4321.0, 210.0, 987.0);
    let hit = looker.world.closest_hit(&Ray::new(ball + Vec3::new(0.0, 0.0, 0.5), Vec3::NEG_Z), 0.0).unwrap();
    let digits = [4, 9, 2, 3, 8, 1, 2, 7, 0, 1_u64];
    let part = digits.iter().fold(0, |number, digit| 10 * number + digit);
    assert_eq!(hit.part, part);
    assert!((hit.hit.t - 0.1).abs() < 0.01);
}
