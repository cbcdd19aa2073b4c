//! Movement while the shutter is open.

use crate::support::Folder;
use glam::{DAffine3, DVec3};
use heliostat_geometry::Transform;
use heliostat_io::{OpenOptions, Shot};
use heliostat_scene::Motion;

/// One frame per second, the shutter always open: frame 5 sees seconds 4.5 to 5.5.
fn shot(scene: &str, keys: &str) -> Shot {
    let text = format!(
        "time = {{ frame_rate = 1, first_frame = 0, shutter = 1 }}\n{scene}\n[[animation]]\n{keys}\n"
    );
    let source = Folder::new().open(&text, &OpenOptions::default()).unwrap_or_else(|e| panic!("{e}\n{text}"));
    source.shot(5).unwrap()
}

const BALLS: &str = "camera = { position = [0, 0, 20] }
    object = [{ name = 'a', cuboid = { size = [2, 1, 3] } }, { name = 'b', sphere = { radius = 1 } }]";

fn poses(motion: &Motion<Transform>) -> Vec<DAffine3> {
    motion.poses().iter().map(Transform::matrix).collect()
}

#[test]
fn a_straight_way_needs_two_poses_around_the_moment_of_the_frame() {
    let shot =
        shot(BALLS, "target = 'object.a.translate.0'\ninterpolation = 'linear'\nkeys = [[0, 0], [10, 100]]");
    let moving = poses(&shot.scene.objects[0].motion);
    assert_eq!(moving.len(), 2);
    assert!((moving[0].translation - DVec3::new(45.0, 0.0, 0.0)).length() < 1e-12);
    assert!((moving[1].translation - DVec3::new(55.0, 0.0, 0.0)).length() < 1e-12);
    assert_eq!(shot.scene.objects[1].motion.poses().len(), 1, "the other one stands still");
    assert_eq!(shot.scene.cameras[0].motion.poses().len(), 1);
}

#[test]
fn a_closed_shutter_sees_one_pose() {
    let text = "camera = {}\nobject = [{ name = 'a', plane = {} }]
        animation = [{ target = 'object.a.translate.0', interpolation = 'linear', keys = [[0, 0], [10, 100]] }]";
    let source = Folder::new().open(text, &OpenOptions::default()).unwrap();
    let moving = source.shot(25).unwrap().scene.objects[0].motion.clone();
    assert_eq!(poses(&moving)[0].translation.x, 10.0);
    assert!(!moving.is_moving());
}

/// How far a corner of the box strays from its circle about the y axis at most, in metres, over the shutter.
fn strays(motion: &Motion<Transform>, degrees_at: impl Fn(f64) -> f64, corner: DVec3) -> f64 {
    (0..=1000)
        .map(|i| {
            let time = f64::from(i) / 1000.0;
            let (a, b, weight) = motion.around(time as f32);
            let weight = f64::from(weight);
            let straight = a.matrix().transform_point3(corner) * (1.0 - weight)
                + b.matrix().transform_point3(corner) * weight;
            let exact = DAffine3::from_rotation_y(degrees_at(time).to_radians()).transform_point3(corner);
            straight.distance(exact)
        })
        .fold(0.0, f64::max)
}

#[test]
fn a_turn_has_as_many_poses_as_keep_it_within_half_a_pixel() {
    for (degrees_per_second, fewest, most) in [(1.0, 2, 2), (30.0, 5, 33), (360.0, 17, 65)] {
        let keys = format!(
            "target = 'object.a.rotate.1'\ninterpolation = 'linear'\nkeys = [[0, 0], [10, {}]]",
            10.0 * degrees_per_second
        );
        let shot = shot(BALLS, &keys);
        let motion = &shot.scene.objects[0].motion;
        let count = motion.poses().len();
        assert!((fewest..=most).contains(&count), "{count} poses at {degrees_per_second} degrees");
        // A pixel at the near side of the box, 540 rows over 40 degrees: the box has a radius of 1.87 m, 20 m away.
        let pixel = 40_f64.to_radians() / 540.0 * (20.0 - 14_f64.sqrt() / 2.0);
        let corner = DVec3::new(1.0, 0.5, 1.5);
        let worst = strays(motion, |time| degrees_per_second * (4.5 + time), corner);
        // Between the sampled moments the arc may rise a little above them.
        assert!(worst <= 0.6 * pixel, "{worst} of {pixel} at {degrees_per_second} degrees");
    }
}

#[test]
fn a_way_there_and_back_is_not_taken_for_rest() {
    // Four swings within the shutter: the ends and the middle are the same.
    let swings: Vec<_> = (0..=8).map(|i| format!("[{}, {}]", 4.5 + f64::from(i) / 8.0, i % 2)).collect();
    let keys =
        format!("target = 'object.b.translate.1'\ninterpolation = 'linear'\nkeys = [{}]", swings.join(", "));
    let shot = shot(BALLS, &keys);
    let heights: Vec<_> =
        poses(&shot.scene.objects[1].motion).iter().map(|pose| pose.translation.y).collect();
    assert_eq!(heights, [0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0]);
}

#[test]
fn cameras_move_and_follow() {
    let scene = "camera = { look_at = 'b' }\nobject = [{ name = 'b', sphere = { radius = 1 }, translate = [0, 0, -10] }]";
    let shot = shot(
        scene,
        "target = 'object.b.translate.0'\ninterpolation = 'linear'\nkeys = [[0, -100], [10, 100]]",
    );
    // From 10 to the left to 10 to the right, 10 metres away: a quarter turn.
    let camera = shot.scene.cameras[0].motion.poses();
    assert!(camera.len() > 2);
    let forward = |pose: &DAffine3| -pose.matrix3.z_axis;
    let (first, last) = (forward(&camera[0]), forward(&camera[camera.len() - 1]));
    assert!((first - DVec3::new(-1.0, 0.0, -1.0).normalize()).length() < 1e-12);
    assert!((last - DVec3::new(1.0, 0.0, -1.0).normalize()).length() < 1e-12);
}

#[test]
fn models_move_as_one() {
    let folder = Folder::new();
    folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng a\nf 1 2 3\ng b\nf 3 2 1\n");
    let text = "camera = {}\ntime = { shutter = 0.5 }\nmodel = [{ file = 'm.obj' }]
        animation = [{ target = 'model.m.translate.0', interpolation = 'linear', keys = [[0, 0], [10, 240]] }]";
    let shot = folder.open(text, &OpenOptions::default()).unwrap().shot(25).unwrap();
    // 1 metre per frame, half a frame open, around 24 metres at frame 25.
    for object in &shot.scene.objects {
        let x: Vec<_> = poses(&object.motion).iter().map(|pose| pose.translation.x).collect();
        assert_eq!(x.len(), 2);
        assert!((x[0] - 23.75).abs() < 1e-9 && (x[1] - 24.25).abs() < 1e-9, "{x:?}");
    }
}
