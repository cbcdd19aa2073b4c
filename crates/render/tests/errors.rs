//! Settings and cameras that cannot be rendered are refused with a message that says what is allowed.

mod formula;

use formula::{camera, ground, perspective, scene, small};
use glam::{DAffine3, DMat3, DVec3};
use heliostat_render::{Prepared, RenderError};
use heliostat_scene::camera::{Focus, FocusMethod, Projection};
use heliostat_scene::settings::{Layers, PixelRect};
use heliostat_scene::{Camera, Motion, RenderSettings, Scene};

fn refusal(scene: &Scene, settings: &RenderSettings) -> String {
    match Prepared::with_integrator(scene, settings, Box::new(formula::Formula(ground))) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("accepted {settings:?}"),
    }
}

#[test]
fn settings_out_of_range_are_named_with_their_range() {
    let rect = |x0, y0, x1, y1| Some(PixelRect { x0, y0, x1, y1 });
    let cases: &[(RenderSettings, &[&str])] = &[
        (RenderSettings { width: 0, ..small() }, &["0 x 37", "at least 1"]),
        (RenderSettings { height: 0, ..small() }, &["53 x 0", "at least 1"]),
        (
            RenderSettings { width: 1 << 16, height: 1 << 16, ..small() },
            &["65536 x 65536", "at most 2147483648"],
        ),
        (RenderSettings { width: u32::MAX, height: u32::MAX, ..small() }, &["at most"]),
        (RenderSettings { region: rect(5, 5, 5, 9), ..small() }, &["5,5 to 5,9", "53 x 37"]),
        (RenderSettings { region: rect(9, 5, 5, 9), ..small() }, &["9,5 to 5,9"]),
        (RenderSettings { region: rect(60, 0, 90, 9), ..small() }, &["holds no pixel", "inside"]),
        (RenderSettings { samples: 0, ..small() }, &["0 samples", "at least 1"]),
        (RenderSettings { filter_radius: 0.0, ..small() }, &["filter radius is 0", "above 0"]),
        (RenderSettings { filter_radius: f32::NAN, ..small() }, &["filter radius is NaN"]),
        (RenderSettings { filter_radius: 1e9, ..small() }, &["at most 64"]),
        (RenderSettings { max_depth: u32::MAX, ..small() }, &["max_depth is 4294967295", "at most"]),
        (RenderSettings { min_weight: f32::NAN, ..small() }, &["min_weight is NaN", "0 to 1"]),
        (RenderSettings { min_weight: -0.1, ..small() }, &["min_weight is -0.1"]),
        (RenderSettings { ao_distance: 0.0, ..small() }, &["ao_distance is 0", "above 0"]),
        (RenderSettings { camera: 3, ..small() }, &["camera 3", "the scene has 1"]),
    ];
    for (settings, wanted) in cases {
        let message = refusal(&scene(perspective()), settings);
        for part in *wanted {
            assert!(message.contains(part), "`{message}` lacks `{part}`");
        }
        assert!(!message.contains('\n'));
    }
    assert!(refusal(&Scene::default(), &small()).contains("the scene has 0"));
}

#[test]
fn cameras_out_of_range_are_named_with_their_range() {
    let focus =
        Focus { distance: 1.0, lens_radius: 0.1, blades: 0, blade_rotation: 0.0, method: FocusMethod::Lens };
    let focused = |focus| Camera { focus: Some(focus), ..perspective() };
    let posed = |pose| Camera { motion: Motion::still(pose), ..perspective() };
    let flat = DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(1.0, 1.0, 0.0)));
    let lost = DAffine3::from_translation(DVec3::new(0.0, f64::NAN, 0.0));
    let cases = [
        (camera(Projection::Perspective { fov_y: 0.0 }), "between 0 and pi"),
        (camera(Projection::Perspective { fov_y: 3.2 }), "between 0 and pi"),
        (camera(Projection::Perspective { fov_y: f32::NAN }), "fov_y is not finite"),
        (camera(Projection::Orthographic { height: -1.0 }), "height must be above 0, is -1"),
        (camera(Projection::Orthographic { height: f32::INFINITY }), "height is not finite"),
        (camera(Projection::Fisheye { fov: 7.0 }), "up to 2 pi, is 7"),
        (camera(Projection::Cylindrical { fov_x: 0.0, fov_y: 1.0 }), "fov_x must be"),
        (camera(Projection::Cylindrical { fov_x: 1.0, fov_y: 4.0 }), "fov_y must be"),
        (focused(Focus { distance: 0.0, ..focus }), "focus distance must be above 0, is 0"),
        (focused(Focus { distance: f32::INFINITY, ..focus }), "focus distance is not finite"),
        (focused(Focus { lens_radius: -0.1, ..focus }), "lens radius must be at least 0"),
        (focused(Focus { blades: 2, ..focus }), "blades must be 0 or at least 3, is 2"),
        (focused(Focus { blade_rotation: f32::NAN, ..focus }), "blade rotation"),
        (posed(flat), "the determinant of the pose must be above 0"),
        (posed(lost), "the pose is not finite"),
    ];
    for (camera, wanted) in cases {
        let message = refusal(&scene(camera), &small());
        assert!(
            message.contains("camera `main`") && message.contains(wanted),
            "`{message}` lacks `{wanted}`"
        );
    }
}

#[test]
fn a_scene_with_several_faults_names_the_first_and_counts_the_rest() {
    let mut broken = scene(camera(Projection::Perspective { fov_y: 9.0 }));
    broken.cameras.push(camera(Projection::Orthographic { height: 0.0 }));
    let message = refusal(&broken, &small());
    assert_eq!(message, "camera `main`: fov_y must be between 0 and pi, is 9 (and 2 more)");
}

#[test]
fn a_film_larger_than_memory_is_refused_before_it_is_allocated() {
    // Half a terabyte. A system that promises more than it has accepts it; then nothing was touched either.
    let settings = RenderSettings { width: 1 << 16, height: 1 << 15, layers: Layers::ALL, ..small() };
    let scene = scene(perspective());
    match Prepared::with_integrator(&scene, &settings, Box::new(formula::Formula(ground))) {
        Err(RenderError::OutOfMemory { bytes }) => assert!(bytes > 1 << 38, "{bytes}"),
        Err(other) => panic!("{other}"),
        Ok(prepared) => drop(prepared),
    }
}
