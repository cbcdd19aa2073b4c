//! Keyframes: values between them by mathematics, targets of every section, and what is refused.

use crate::support::{Folder, refused, shot};
use heliostat_io::{OpenOptions, Shot, Source};
use heliostat_scene::camera::Projection;
use heliostat_scene::light::LightKind;
use heliostat_scene::material::Surface;

/// 10 frames per second, frame 0 at 0 seconds.
fn animated(scene: &str, animation: &str) -> Source {
    let text =
        format!("time = {{ frame_rate = 10, first_frame = 0 }}\n{scene}\n[[animation]]\n{animation}\n");
    Folder::new().open(&text, &OpenOptions::default()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

const BALL: &str = "camera = { name = 'main' }\nobject = [{ name = 'ball', sphere = { radius = 1 } }]";

fn height(source: &Source, frame: i32) -> f64 {
    source.shot(frame).unwrap().scene.objects[0].motion.first().matrix().translation.y
}

#[test]
fn linear_runs_straight_and_rests_outside() {
    let source = animated(
        BALL,
        "target = 'object.ball.translate.1'\ninterpolation = 'linear'\nkeys = [[1, 2], [2, 4], [4, 0]]",
    );
    for (frame, expected) in [(0, 2.0), (10, 2.0), (15, 3.0), (20, 4.0), (25, 3.0), (40, 0.0), (99, 0.0)] {
        assert!((height(&source, frame) - expected).abs() < 1e-12, "frame {frame}");
    }
}

#[test]
fn smooth_eases_and_passes_between() {
    // Two keys: smoothstep. At a quarter of the way 3/16 - 2/64 = 0.15625.
    let two = animated(BALL, "target = 'object.ball.translate.y'\nkeys = [[0, 0], [4, 8]]");
    for (frame, expected) in [(0, 0.0), (10, 8.0 * 0.15625), (20, 4.0), (30, 8.0 * 0.84375), (40, 8.0)] {
        assert!((height(&two, frame) - expected).abs() < 1e-12, "frame {frame}");
    }
    // The middle key of an even climb has the slope of the climb, 1: between the first two keys the cubic with slopes 0 and 1
    // is 2 s^2 - s^3, at half the way 0.375.
    let three = animated(BALL, "target = 'object.ball.translate.1'\nkeys = [[0, 0], [1, 1], [2, 2]]");
    assert!((height(&three, 5) - 0.375).abs() < 1e-12);
    assert!((height(&three, 15) - 1.625).abs() < 1e-12);
}

#[test]
fn step_keeps_the_last_key_and_serves_truth_values() {
    let source = animated(
        BALL,
        "target = 'object.ball.visible'\ninterpolation = 'step'\nkeys = [[0, true], [1, false], [2, true]]",
    );
    let visible: Vec<_> = [0, 9, 10, 19, 20].map(|f| source.shot(f).unwrap().scene.objects[0].visible).into();
    assert_eq!(visible, [true, true, false, false, true]);
    let word = animated(
        BALL,
        "target = 'render.integrator'\ninterpolation = 'step'\nkeys = [[0, 'uv'], [1, 'normals']]",
    );
    assert_ne!(word.shot(0).unwrap().settings.integrator, word.shot(10).unwrap().settings.integrator);
}

#[test]
fn whole_numbers_are_rounded_between_keys() {
    let source =
        animated(BALL, "target = 'render.samples'\ninterpolation = 'linear'\nkeys = [[0, 4], [1, 8]]");
    let samples: Vec<_> = [0, 1, 2, 5, 10].map(|f| source.shot(f).unwrap().settings.samples).into();
    assert_eq!(samples, [4, 4, 5, 6, 8]);
}

#[test]
fn numbers_of_every_section_move() {
    fn fov(shot: &Shot) -> f32 {
        match shot.scene.cameras[0].projection {
            Projection::Perspective { fov_y } => fov_y.to_degrees(),
            other => panic!("{other:?}"),
        }
    }
    let scene = format!(
        "{BALL}\nmaterial = [{{ name = 'glass' }}]\nlight = [{{ name = 'key', point = {{ position = [0, 0, 0] }} }}]"
    );
    // Every value goes from 1 to 3 in 2 seconds; frame 10 shows 2.
    let middle = |target: &str, keys: &str| {
        animated(&scene, &format!("target = \"{target}\"\nkeys = {keys}")).shot(10).unwrap()
    };
    let number = "[[0, 1], [2, 3]]";
    assert!((fov(&middle("camera.fov", number)) - 2.0).abs() < 1e-5);
    assert!((fov(&middle("camera.main.fov", number)) - 2.0).abs() < 1e-5);
    let eye = middle("camera.main.position", "[[0, [1, 1, 1]], [2, [3, 3, 3]]]");
    assert_eq!(eye.scene.cameras[0].motion.first().translation.to_array(), [2.0; 3]);
    let glass = middle("material.glass.phong.ior", number);
    let Surface::Phong(phong) = &glass.scene.materials[0].surface else {
        panic!("not the report\'s surface")
    };
    assert_eq!(phong.ior, 2.0);
    let light = middle("light.key.point.position.2", number);
    let LightKind::Point { position, .. } = light.scene.lights[0].kind else { panic!() };
    assert_eq!(position.to_array(), [0.0, 0.0, 2.0]);
    assert_eq!(middle("light.key.intensity", number).scene.lights[0].intensity.to_array(), [2.0; 3]);
    assert_eq!(middle("output.exposure", number).view.exposure, 2.0);
    assert_eq!(middle("object.0.sphere.radius", number).scene.validate(), Ok(()));
    let world = middle("environment.color", "[[0, [1, 0, 1]], [2, [3, 0, 3]]]");
    assert_eq!(format!("{:?}", world.scene.background), "Constant(Vec3(2.0, 0.0, 2.0))");
}

#[test]
fn a_camera_looks_after_a_moving_object() {
    // The box of the cylinder has its middle at height 1; at frame 10 it stands at x = 10, 10 before the camera.
    let source = animated(
        "camera = { look_at = 'post' }\nobject = [{ name = 'post', translate = [0, -1, -10], cylinder = { radius = 1, height = 2 } }]",
        "target = 'object.post.translate.0'\ninterpolation = 'linear'\nkeys = [[0, 0], [1, 10]]",
    );
    let forward = |frame: i32| -source.shot(frame).unwrap().scene.cameras[0].motion.first().matrix3.z_axis;
    assert!((forward(0) - glam::DVec3::NEG_Z).length() < 1e-12);
    let diagonal = glam::DVec3::new(1.0, 0.0, -1.0).normalize();
    assert!((forward(10) - diagonal).length() < 1e-12);
}

#[test]
fn frames_come_from_the_table_or_from_the_last_key() {
    let open = |text: &str| Folder::new().open(text, &OpenOptions::default()).unwrap();
    assert_eq!(open("camera = {}").frames(), None);
    assert_eq!(open("camera = {}\ntime.last_frame = 96").frames(), Some(1..=96));
    let keys = "animation = [{ target = 'camera.fov', keys = [[0, 20], [2.01, 30]] }]";
    let source = open(&format!("camera = {{}}\n{keys}"));
    assert_eq!((source.frames(), source.frame_rate(), source.first_frame()), (Some(1..=50), 24.0, 1));
    let other = open(&format!("camera = {{}}\n{keys}\ntime = {{ frame_rate = 10, first_frame = -5 }}"));
    assert_eq!(other.frames(), Some(-5..=16));
}

fn refused_animation(marked: &str, message: &str, help: &str) {
    refused(&format!("{BALL}\n[[animation]]\n{marked}\n"), message, help);
}

#[test]
fn wrong_targets_are_marked_inside_their_quotes() {
    let keys = "keys = [[0, 1]]\n";
    refused_animation(
        &format!("{keys}target = 'object.«boll».translate.1'"),
        "unknown object `boll`",
        "did you mean `ball`?",
    );
    refused_animation(
        &format!("{keys}target = 'object.ball.«translat».x'"),
        "unknown key `translat`",
        "did you mean `translate`?",
    );
    refused_animation(
        &format!("{keys}target = \"object.ball.translate.«w»\""),
        "there is no component `w`",
        "choose 0 to 2",
    );
    refused_animation(
        &format!("{keys}target = '«objects».ball.scale'"),
        "unknown key `objects`",
        "did you mean `object`?",
    );
    refused_animation(
        &format!("{keys}target = '«time».frame_rate'"),
        "`time` cannot be animated",
        "animate a number of another section",
    );
    refused_animation(
        &format!("{keys}target = 'camera.«»'"),
        "the path has an empty part",
        "write names between the dots, as in `object.ball.translate`",
    );
    // With an escape in it the string as a whole is marked.
    refused_animation(
        &format!("{keys}target = «\"object.b\\u006fll.scale\"»"),
        "unknown object `boll`",
        "did you mean `ball`?",
    );
}

#[test]
fn wrong_keys_are_marked() {
    let target = "target = 'object.ball.translate.1'\n";
    refused_animation(
        &format!("{target}keys = «[]»"),
        "the animation has no keys",
        "write keys = [[seconds, value], ...]",
    );
    refused_animation(
        &format!("{target}keys = [[0, 1], [«0», 2]]"),
        "the times of the keys do not grow",
        "sort the keys by time, one for each",
    );
    refused_animation(&format!("{target}keys = [«[0]»]"), "expected a key [seconds, value]", "");
    refused_animation(&format!("{target}keys = [«[0, 1, 2]»]"), "expected an array of 2 values, found 3", "");
    refused_animation(&format!("{target}keys = [«3»]"), "expected a key [seconds, value], found 3", "");
    refused_animation(&format!("{target}keys = [[0, «nan»]]"), "expected a finite number, found nan", "");
    refused_animation(&format!("{target}keys = [[«inf», 1]]"), "expected a finite number, found inf", "");
    refused_animation(
        &format!("{target}keys = [[0, 1], [1, «[1, 2]»]]"),
        "the value has another form than that of the first key",
        "write a number in every key, or an array of the same length",
    );
    refused_animation(
        &format!("{target}keys = [[0, «'up'»], [1, 'down']]"),
        "only numbers have values in between",
        "use interpolation = \"step\" here",
    );
    refused_animation(
        "target = 'object.ball.scale'\nkeys = [[0, «0»], [1, 2]]",
        "expected a number other than 0, found 0",
        "",
    );
    refused_animation(
        "target = 'object.ball.material'\nkeys = [[0, «3»]]",
        "expected text in quotes, found 3",
        "put it in quotes",
    );
    refused_animation(
        &format!(
            "{target}keys = [[0, 1]]\n[[animation]]\ntarget = «'object.ball.translate'»\nkeys = [[0, [0, 0, 0]]]"
        ),
        "`object.ball.translate` is animated twice",
        "put all keys into one [[animation]]",
    );
    refused_animation(
        &format!("{target}interpolation = «'smoth'»\nkeys = [[0, 1]]"),
        "unknown value `smoth`",
        "did you mean `smooth`?",
    );
}

#[test]
fn a_value_that_goes_wrong_later_is_told_at_its_key() {
    let scene = "[camera]\nfov = 40\n[[animation]]\ntarget = 'camera.fov'\nkeys = [[0, 40], [1, 200]]\n";
    let folder = Folder::new();
    let source = folder.open(scene, &OpenOptions::default()).unwrap();
    assert!(source.shot(1).is_ok());
    let error = source.shot(25).unwrap_err();
    let place = error.report().place.as_ref().unwrap();
    assert_eq!((place.line, &place.excerpt[place.span.clone()]), (5, "200"), "{error}");
    assert!(shot(scene).is_ok());
}
