//! `--set PATH=VALUE` and `--camera NAME`.

use crate::support::{Folder, set, shot_with};
use heliostat_io::OpenOptions;
use heliostat_scene::camera::Projection;
use heliostat_scene::settings::IntegratorKind;

const SCENE: &str = "[camera]\nname = 'main'\nfov = 40\n[[object]]\nname = 'a.b'\nsphere = { radius = 1 }\n\
                     [[material]]\nname = 'm'\n";

fn fov(options: &OpenOptions) -> f32 {
    match shot_with(SCENE, options).unwrap().scene.cameras[0].projection {
        Projection::Perspective { fov_y } => fov_y.to_degrees(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn values_of_the_file_are_replaced() {
    assert!((fov(&set(&[])) - 40.0).abs() < 1e-4);
    assert!((fov(&set(&[("camera.fov", "20")])) - 20.0).abs() < 1e-4);
    assert!((fov(&set(&[("camera.main.fov", "20")])) - 20.0).abs() < 1e-4, "by its name");
    assert!((fov(&set(&[("camera.fov", "20"), ("camera.fov", "30")])) - 30.0).abs() < 1e-4, "the last wins");
}

#[test]
fn values_that_the_file_leaves_out_are_set() {
    let options = set(&[
        ("render.integrator", "ambient_occlusion"),
        ("render.samples", "3"),
        ("render.transparent_background", "true"),
        ("object.\"a.b\".translate.1", "7"),
        ("object.'a.b'.scale", "[1, 2, 3]"),
        ("material.m.phong.ior", "2"),
        ("object.0.sphere.radius", "5"),
    ]);
    let shot = shot_with(SCENE, &options).unwrap();
    assert_eq!(shot.settings.integrator, IntegratorKind::AmbientOcclusion);
    assert_eq!(shot.settings.samples, 3);
    assert!(shot.settings.transparent_background);
    let matrix = shot.scene.objects[0].motion.first().matrix();
    assert_eq!(matrix.translation.to_array(), [0.0, 7.0, 0.0]);
    assert_eq!(matrix.matrix3.y_axis.y, 2.0);
    let bounds = match &shot.scene.objects[0].geometry {
        heliostat_scene::object::Geometry::Shape(shape) => shape.geometry().bounds(),
        other => panic!("{other:?}"),
    };
    assert_eq!(bounds.max.x, 5.0);
}

#[test]
fn a_component_of_a_number_makes_it_an_array() {
    let scene = "[camera]\n[[object]]\nname = 'o'\nplane = {}\nscale = 2\n";
    let shot = shot_with(scene, &set(&[("object.o.scale.1", "5")])).unwrap();
    let matrix = shot.scene.objects[0].motion.first().matrix().matrix3;
    assert_eq!((matrix.x_axis.x, matrix.y_axis.y, matrix.z_axis.z), (2.0, 5.0, 2.0));
}

#[test]
fn a_camera_is_chosen_by_name() {
    let scene = "[[camera]]\nname = 'front'\n[[camera]]\nname = 'side'\n[render]\ncamera = 'front'\n";
    let side = OpenOptions { camera: Some("side".to_owned()), ..OpenOptions::default() };
    assert_eq!(shot_with(scene, &OpenOptions::default()).unwrap().settings.camera, 0);
    assert_eq!(shot_with(scene, &side).unwrap().settings.camera, 1);
    let slip = OpenOptions { camera: Some("sied".to_owned()), ..OpenOptions::default() };
    let error = shot_with(scene, &slip).unwrap_err();
    assert_eq!(error.to_string(), "--camera:1:1: unknown camera `sied`; did you mean `side`?");
}

#[test]
fn wrong_overrides_name_the_flag_and_the_place() {
    let error = |path: &str, value: &str| {
        Folder::new().open(SCENE, &set(&[(path, value)])).and_then(|s| s.shot(1)).unwrap_err().to_string()
    };
    let cases = [
        ("camera.fvo", "3", "--set:1:8: unknown key `fvo`; did you mean `fov`?"),
        ("camera.fov", "nan", "--set:1:12: expected an angle above 0 and up to 360 degrees, found nan"),
        ("render.samples", "0", "--set:1:16: expected a whole number of at least 1, found 0"),
        ("render.integrator", "normal", "--set:1:19: unknown value `normal`; did you mean `normals`?"),
        ("object.a.c.scale", "3", "--set:1:8: unknown object `a`; known: `a.b`"),
        ("object.'a.b'.sphere", "3", "--set:1:21: expected a table, found 3"),
        (
            "object.'a.b'",
            "3",
            "--set:1:8: `a.b` is a table, not a value; go on with a dot and one of its keys",
        ),
        ("light.key.intensity", "3", "--set:1:1: there is no [[light]] to set a value in; add a [[light]]"),
        ("camera", "3", "--set:1:1: `camera` is a table, not a value; go on with a dot and one of its keys"),
        ("camera.fov.w", "3", "--set:1:12: `fov` is a number, it has no parts; end the path at `fov`"),
        (
            "camera.fov.1.2",
            "3",
            "--set:1:12: expected an angle above 0 and up to 360 degrees, found an array",
        ),
        ("camera.up.3", "3", "--set:1:11: there is no component `3`; choose 0 to 2"),
        (
            "camera..fov",
            "3",
            "--set:1:8: the path has an empty part; write names between the dots, as in `object.ball.translate`",
        ),
        (
            "",
            "3",
            "--set:1:1: the path has an empty part; write names between the dots, as in `object.ball.translate`",
        ),
        ("camera.\"fov", "3", "--set:1:8: the quote \" is not closed"),
        (
            "camera.look_at.1",
            "3",
            "--set:1:8: `look_at` is not in the file, so it has no components; write `look_at` there, or set all of it",
        ),
        (
            "zzz.a",
            "3",
            "--set:1:1: unknown key `zzz`; known: `render`, `output`, `time`, `camera`, `environment`, `texture`, `medium`, `material`, `mesh`, `model`, `object`, `group`, `light`, `animation`",
        ),
    ];
    for (path, value, expected) in cases {
        assert_eq!(error(path, value), expected, "{path}={value}");
    }
    let broken = error("camera.fov", "[1,");
    assert!(broken.starts_with("--set:1:") && broken.ends_with("true or \"text\""), "{broken}");
}

#[test]
fn an_override_holds_an_animated_value() {
    let scene = "[camera]\n[[object]]\nname = 'o'\nplane = {}\n[[animation]]\ntarget = 'object.o.translate'\n\
                 keys = [[0, [1, 2, 3]], [1, [4, 5, 6]]]\n";
    let translation = |options: &OpenOptions| {
        let source = Folder::new().open(scene, options).unwrap();
        source.shot(25).unwrap().scene.objects[0].motion.first().matrix().translation.to_array()
    };
    assert_eq!(translation(&set(&[])), [4.0, 5.0, 6.0]);
    assert_eq!(translation(&set(&[("object.o.translate", "[9, 9, 9]")])), [9.0, 9.0, 9.0]);
    assert_eq!(translation(&set(&[("object.o.translate.1", "9")])), [4.0, 9.0, 6.0]);
}
