//! What values mean, and that files survive being written and read.

use crate::flips::flips;
use crate::keys;
use crate::support::shot;
use glam::{DVec3, Vec3};
use heliostat_io::scene_file::SceneFile;
use heliostat_io::scene_file::render::RenderTable;
use heliostat_scene::camera::Projection;
use heliostat_scene::light::LightKind;
use heliostat_scene::settings::{
    Caustics, DepthLimits, Filter, Guiding, IntegratorKind, Layers, LightChoice, PixelRect, SamplerKind,
};
use heliostat_scene::{RenderSettings, Scene};
use std::collections::BTreeMap;

fn scene(text: &str) -> Scene {
    shot(text).unwrap_or_else(|e| panic!("{e}\n{text}")).scene
}

fn placed(keys: &str) -> glam::DAffine3 {
    scene(&format!("camera = {{}}\n[[object]]\nplane = {{}}\n{keys}\n")).objects[0].motion.first().matrix()
}

fn near(a: DVec3, b: [f64; 3]) {
    assert!((a - DVec3::from_array(b)).length() < 1e-6, "{a} is not {b:?}");
}

#[test]
fn the_smallest_scene_of_the_repository_is_what_it_says() {
    let text = include_str!("../../../../scenes/minimal.toml");
    let shot = shot(text).unwrap();
    assert_eq!(shot.settings, RenderSettings::default());
    assert_eq!(shot.scene.validate(), Ok(()));
    let names: Vec<_> = shot.scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["ground", "ball"]);
    let lights: Vec<_> = shot.scene.lights.iter().map(|light| light.name.as_str()).collect();
    assert_eq!(lights, ["light", "light2"]);
}

#[test]
fn things_are_scaled_then_turned_then_shifted() {
    let point = DVec3::new(1.0, 2.0, 3.0);
    near(placed("scale = 2").transform_point3(point), [2.0, 4.0, 6.0]);
    near(placed("scale = [1, -1, 2]").transform_point3(point), [1.0, -2.0, 6.0]);
    // About x: y to z. Then about y: z to x. Then about z: x to y.
    near(placed("rotate = [90, 0, 0]").transform_point3(point), [1.0, -3.0, 2.0]);
    near(placed("rotate = [90, 90, 0]").transform_point3(point), [2.0, -3.0, -1.0]);
    near(placed("rotate = [90, 90, 90]").transform_point3(point), [3.0, 2.0, -1.0]);
    near(
        placed("scale = [2, 1, 1]\nrotate = [0, 0, 90]\ntranslate = [10, 20, 30]").transform_point3(point),
        [8.0, 22.0, 33.0],
    );
    near(
        placed("matrix = [[1, 1, 0, 10], [0, 1, 0, 20], [0, 0, 2, 30]]").transform_point3(point),
        [13.0, 22.0, 36.0],
    );
}

#[test]
fn quarter_turns_are_exact() {
    for quarters in -8..=8 {
        let matrix = placed(&format!("rotate = [0, {}, 0]", 90 * quarters)).matrix3;
        for value in matrix.to_cols_array() {
            assert!([-1.0, 0.0, 1.0].contains(&value), "{quarters} quarters: {matrix}");
        }
    }
}

#[test]
fn cameras_look_where_they_are_told() {
    let pose = |keys: &str| scene(&format!("[camera]\n{keys}\n")).cameras[0].motion.first().matrix3;
    near(pose("").z_axis, [0.0, 0.0, 1.0]);
    let level = pose("position = [3, 1, 0]\nlook_at = [1, 1, 0]");
    near(-level.z_axis, [-1.0, 0.0, 0.0]);
    near(level.y_axis, [0.0, 1.0, 0.0]);
    near(level.x_axis, [0.0, 0.0, -1.0]);
    let down = pose("position = [0, 9, 0]\nlook_at = [0, 0, 0]");
    near(-down.z_axis, [0.0, -1.0, 0.0]);
    near(down.y_axis, [0.0, 0.0, -1.0]);
    let rolled = pose("look_at = [0, 0, -1]\nup = [5, 0, 0]");
    near(rolled.y_axis, [1.0, 0.0, 0.0]);
}

#[test]
fn lenses_follow_the_laws_of_photography() {
    let camera = |keys: &str| scene(&format!("[camera]\n{keys}\n")).cameras[0].clone();
    let fov = |keys: &str| match camera(keys).projection {
        Projection::Perspective { fov_y } => f64::from(fov_y),
        other => panic!("{other:?}"),
    };
    // A sensor twice as high as the focal length is long sees a right angle.
    assert!((fov("focal_length = 12") - std::f64::consts::FRAC_PI_2).abs() < 1e-6);
    assert!((fov("focal_length = 5\nsensor_height = 10") - std::f64::consts::FRAC_PI_2).abs() < 1e-6);
    let radius = |keys: &str| camera(keys).focus.unwrap().lens_radius;
    // 50 mm at f/2 opens 25 mm wide.
    assert!((radius("focal_length = 50\nfocus = { distance = 1, f_number = 2 }") - 0.0125).abs() < 1e-8);
    // 90 degrees on 24 mm is 12 mm.
    assert!((radius("fov = 90\nfocus = { distance = 1, f_number = 1 }") - 0.006).abs() < 1e-8);
    // The distance counts along the view: a ball 3 to the side and 4 ahead is at 4.
    let aside = "object = [{ name = 'o', sphere = { radius = 1 }, translate = [3, 0, -4] }]\n[camera]\nfocus = { at = 'o', lens_radius = 1 }";
    assert_eq!(scene(aside).cameras[0].focus.unwrap().distance, 4.0);
}

#[test]
fn lights_aim_where_they_are_told() {
    let light = |keys: &str| {
        let text = format!(
            "camera = {{}}\nobject = [{{ name = 'o', plane = {{}}, translate = [4, 0, 0] }}]\n[[light]]\n{keys}\n"
        );
        scene(&text).lights[0].clone()
    };
    let LightKind::Spot { direction, inner, outer, .. } =
        light("spot = { position = [4, 9, 0], look_at = 'o', outer = 45 }").kind
    else {
        panic!()
    };
    assert_eq!(direction, Vec3::NEG_Y);
    assert!((outer.to_degrees() - 45.0).abs() < 1e-4 && (inner.to_degrees() - 36.0).abs() < 1e-4);
    let LightKind::Directional { direction, .. } = light("directional = { direction = [0, 0, -7] }").kind
    else {
        panic!()
    };
    assert_eq!(direction, Vec3::NEG_Z);
    for (target, normal) in
        [("[4, 0, 0]", [1.0, 0.0, 0.0]), ("[0, -4, 0]", [0.0, -1.0, 0.0]), ("'o'", [1.0, 0.0, 0.0])]
    {
        let area = format!("area = {{ disk = {{ radius = 1 }}, scale = 2, look_at = {target} }}");
        let LightKind::Area { transform, .. } = light(&area).kind else { panic!() };
        near(transform.matrix().matrix3.y_axis, normal.map(|v| 2.0 * v));
        assert!(!transform.is_mirror(), "towards {target}");
    }
    let key = light("ambient = {}\nintensity = [1, 2, 3]\ncolor = [2, 0.5, 0]");
    assert_eq!(key.intensity.to_array(), [2.0, 1.0, 0.0]);
}

#[test]
fn filters_have_their_own_radius() {
    for (name, radius) in [
        ("box", 0.5),
        ("tent", 1.0),
        ("gaussian", 1.5),
        ("mitchell", 2.0),
        ("blackman_harris", 1.5),
        ("lanczos", 3.0),
    ] {
        let settings = shot(&format!("camera = {{}}\nrender.filter = '{name}'")).unwrap().settings;
        assert_eq!(settings.filter_radius, radius, "{name}");
    }
}

#[test]
fn settings_survive_being_written_and_read() {
    let settings = RenderSettings {
        width: 1,
        height: 65_535,
        region: Some(PixelRect { x0: 0, y0: 7, x1: 1, y1: 9 }),
        samples: u32::MAX,
        noise: Some(0.125),
        noise_floor: RenderSettings::NOISE_FLOOR,
        time: Some(90.5),
        max_samples: Some(u32::MAX),
        sampler: SamplerKind::White,
        integrator: IntegratorKind::AmbientOcclusion,
        filter: Filter::Lanczos,
        filter_radius: 0.1,
        seed: i64::MAX as u64,
        max_depth: 0,
        min_weight: 1.0e-7,
        transparent_shadows: true,
        depth_limits: DepthLimits { total: 9, diffuse: 0, glossy: 3, ..DepthLimits::default() },
        clamp_indirect: Some(7.5),
        caustics: Caustics::Photons,
        caustic_photons: 77,
        caustic_radius: Some(0.25),
        mip_maps: false,
        guiding: Guiding::Learn,
        guiding_paths: Some(12_345),
        light_choice: LightChoice::Uniform,
        ao_samples: 5,
        ao_distance: 1.0e5,
        layers: Layers { uv: true, depth: true, variance: true, sample_count: true, ..Layers::default() },
        transparent_background: true,
        camera: 1,
        threads: 0,
    };
    for settings in [settings, RenderSettings { camera: 1, ..RenderSettings::default() }] {
        let table = RenderTable::from_settings(&settings, Some("b"));
        let text = toml::to_string(&BTreeMap::from([("render", table)])).unwrap();
        let whole = format!("camera = [{{ name = 'a' }}, {{ name = 'b' }}]\n{text}");
        assert_eq!(shot(&whole).unwrap().settings, settings, "{text}");
    }
}

#[test]
fn every_table_survives_being_written_and_read() {
    for (table, _, one, other) in flips() {
        for lines in [one, other] {
            let text = keys::file(table, lines);
            let first: SceneFile = toml::from_str(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
            let written = toml::to_string(&first).unwrap();
            let second: SceneFile = toml::from_str(&written).unwrap_or_else(|e| panic!("{e}\n{written}"));
            assert_eq!(first, second, "{text}\n---\n{written}");
        }
    }
}
