//! Whole pictures by paths: the same bits for any number of threads and passes, nothing that is not a number, and settings
//! that do what they say.

mod common;

use common::{Stage, at, black, cuboid, grey, plane, rectangle, sphere, tilted, white};
use glam::{DAffine3, DVec3, Vec3};
use heliostat_geometry::Transform;
use heliostat_render::{Control, Prepared, render};
use heliostat_scene::camera::Projection;
use heliostat_scene::frame::Meta;
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::{ColorInput, FloatInput, FresnelMode, Phong, Surface};
use heliostat_scene::scene::Background;
use heliostat_scene::settings::{DepthLimits, IntegratorKind, Layers};
use heliostat_scene::{Camera, Frame, Motion, RenderSettings, Rgb, Scene};
use std::sync::atomic::AtomicBool;

/// Matte, glossy, clear and perforated things under a lamp, a sun and a gradient.
fn scene() -> Scene {
    let glass = Phong { transparency: grey(0.9), fresnel: FresnelMode::Dielectric, ..black() };
    let glossy =
        Phong { specular: grey(0.6), diffuse: grey(0.2), shininess: FloatInput::constant(90.0), ..white() };
    let lamp = LightKind::Area {
        geometry: rectangle(0.7, 0.7),
        transform: tilted(180.0, 0.3, 2.0, 0.0),
        two_sided: false,
        visible: true,
        falloff: Falloff::InverseSquare,
    };
    let mut stage = Stage::new()
        .with(plane(), Phong { diffuse: grey(0.5), ..white() }, Transform::IDENTITY)
        .with(sphere(0.4), glass, at(-0.6, 0.4, 0.3))
        .with(cuboid(0.6, 0.8, 0.5), glossy, at(0.7, 0.4, -0.3))
        .with(sphere(0.2), Phong { emission: grey(1.5), ..black() }, at(0.0, 0.2, 0.6))
        .with(rectangle(1.0, 1.0), white(), tilted(60.0, 0.0, 0.8, -0.8))
        .with_opacity(0.5)
        .with_light(5.0, 1, lamp)
        .with_light(0.7, 1, LightKind::Directional { direction: Vec3::new(0.6, -0.8, 0.0), angle: 0.1 });
    let [top, horizon, bottom] = [Rgb::new(0.2, 0.3, 0.6), Rgb::splat(0.4), Rgb::ZERO];
    stage.scene.background = Background::Gradient { top, horizon, bottom };
    stage.scene.cameras.push(Camera {
        name: "front".into(),
        motion: Motion::still(DAffine3::from_translation(DVec3::new(0.0, 0.7, 3.5))),
        projection: Projection::Perspective { fov_y: 0.7 },
        focus: None,
    });
    stage.scene
}

fn settings(integrator: IntegratorKind) -> RenderSettings {
    RenderSettings {
        width: 24,
        height: 18,
        samples: 8,
        integrator,
        layers: Layers::ALL,
        ..RenderSettings::default()
    }
}

const KINDS: [IntegratorKind; 3] = [IntegratorKind::Direct, IntegratorKind::PathSimple, IntegratorKind::Path];

fn sum(frame: &Frame) -> f64 {
    let colors = frame.channels.iter().filter(|channel| "RGB".contains(&channel.name));
    colors.flat_map(|channel| &channel.values).map(|&value| f64::from(value)).sum()
}

#[test]
fn threads_and_passes_leave_no_trace() {
    let scene = scene();
    for kind in KINDS {
        let whole = render(&scene, &RenderSettings { threads: 1, ..settings(kind) }).unwrap();
        for threads in [2, 5] {
            assert_eq!(render(&scene, &RenderSettings { threads, ..settings(kind) }).unwrap(), whole);
        }
        let prepared = Prepared::new(&scene, &settings(kind)).unwrap();
        let mut film = prepared.film();
        for range in [0..3, 3..4, 4..8] {
            prepared.pass(&mut film, range, &Control { cancel: &AtomicBool::new(false), on_tile: &|_| () });
        }
        assert_eq!(prepared.frame(&film), whole);
        let stats = prepared.stats();
        assert_eq!(stats.non_finite_samples, 0);
        assert!(stats.rays.scatter > 0 && stats.rays.refraction > 0);
    }
}

#[test]
fn layers_are_those_of_whitted() {
    let scene = scene();
    let frame = |kind| render(&scene, &RenderSettings { samples: 1, ..settings(kind) }).unwrap();
    let (whitted, path) = (frame(IntegratorKind::Whitted), frame(IntegratorKind::Path));
    for name in ["Z", "P.X", "N.Y", "object_id.Y", "material_id.Y"] {
        let values = |frame: &Frame| frame.channel(name).unwrap().values.clone();
        let same = values(&whitted).iter().zip(values(&path)).filter(|(a, b)| **a == *b).count();
        // Half of the rays pass the perforated wall by chance.
        assert!(same > 24 * 18 * 9 / 10, "{name}: {same}");
    }
}

#[test]
fn limits_and_clamps_take_light_away_and_are_recorded() {
    let scene = scene();
    let with = |depth_limits, clamp_indirect| {
        let settings = RenderSettings { depth_limits, clamp_indirect, ..settings(IntegratorKind::Path) };
        render(&scene, &settings).unwrap()
    };
    let none = DepthLimits::default();
    let whole = with(none, None);
    let text = |frame: &Frame, key: &str| match frame.meta.get(key) {
        Some(Meta::Text(text)) => text.clone(),
        other => format!("{other:?}"),
    };
    assert_eq!(text(&whole, "heliostat/integrator"), "path");
    assert_eq!(whole.meta.get("heliostat/depthLimits"), None);
    for (limits, written) in [
        (DepthLimits { total: 1, ..none }, "1,1024,1024,1024,1048576"),
        (DepthLimits { diffuse: 0, ..none }, "1024,0,1024,1024,1048576"),
        (DepthLimits { transmission: 0, ..none }, "1024,1024,1024,0,1048576"),
        (DepthLimits { glossy: 0, ..none }, "1024,1024,0,1024,1048576"),
    ] {
        let less = with(limits, None);
        assert!(sum(&less) < 0.999 * sum(&whole), "{limits:?}");
        assert_eq!(text(&less, "heliostat/depthLimits"), written);
    }
    let clamped = with(none, Some(0.05));
    assert!(sum(&clamped) < 0.99 * sum(&whole));
    assert_eq!(clamped.meta.get("heliostat/clampIndirect"), Some(&Meta::Float(0.05)));
    let direct = render(&scene, &settings(IntegratorKind::Direct)).unwrap();
    let shallow = with(DepthLimits { total: 0, ..none }, None);
    assert_eq!(direct.channels, shallow.channels);
}

#[test]
fn what_is_unlit_is_seen_and_lights_nothing() {
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY);
    stage.add(sphere(0.5), black(), at(0.0, 0.5, 0.0));
    stage.last_material().surface = Surface::Unlit(ColorInput::constant(Rgb::new(0.1, 0.5, 0.9)));
    stage.settings.integrator = IntegratorKind::Path;
    let seen = stage.look(Vec3::new(0.0, 0.5, 3.0), Vec3::new(0.0, 0.5, 0.0));
    assert_eq!(seen.radiance, Rgb::new(0.1, 0.5, 0.9));
    let beside =
        |sample| stage.look_sample(Vec3::new(1.0, 1.0, 0.0), Vec3::new(0.6, 0.0, 0.0), sample).radiance;
    assert!((0..64).all(|sample| beside(sample) == Rgb::ZERO));
}

#[test]
fn a_transparent_background_is_left_out_behind_glass_and_cut_outs() {
    let mut stage =
        Stage::new().with(rectangle(2.0, 2.0), white(), tilted(90.0, 0.0, 0.0, 0.0)).with_opacity(0.25);
    stage.settings.integrator = IntegratorKind::Path;
    stage.settings.transparent_background = true;
    let stage = stage.with_sky(1.0);
    let alpha: f32 = (0..256).map(|i| stage.look_sample(Vec3::Z, Vec3::ZERO, i).alpha).sum();
    assert!((alpha / 256.0 - 0.25).abs() < 0.02, "{alpha}");
}
