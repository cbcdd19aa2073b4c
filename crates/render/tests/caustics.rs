//! Caustics by photons: closed forms, what paths find by chance, and the promises that all pictures keep.

#![expect(clippy::unwrap_used, reason = "a picture that is not made fails its test")]

mod common;

use common::{Stage, at, ball_mesh, black, cuboid, mirror, plane, rectangle, sphere, tilted, torus, white};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use heliostat_geometry::Transform;
use heliostat_render::{Control, Prepared, RenderError, render};
use heliostat_scene::camera::Projection;
use heliostat_scene::frame::Meta;
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::{ColorInput, FloatInput, FresnelMode, Phong, Standard, Surface};
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::{Caustics, DepthLimits, Filter, IntegratorKind, PixelRect};
use heliostat_scene::{Camera, Frame, Motion, RenderSettings, Rgb};
use std::f32::consts::PI;
use std::sync::atomic::AtomicBool;

/// Glass by Fresnel's equations.
fn glass(ior: f32) -> Phong {
    Phong { fresnel: FresnelMode::Dielectric, ..common::glass(ior) }
}

fn standard(stage: &mut Stage, geometry: Geometry, standard: Standard, place: Transform) {
    stage.add(geometry, black(), place);
    stage.last_material().surface = Surface::Standard(Box::new(standard));
}

/// A white floor without end, seen from above within `half` metres of `x`, from 5 cm above.
fn floor(x: f32, half: f32) -> Stage {
    ground(plane(), x, half)
}

fn ground(geometry: Geometry, x: f32, half: f32) -> Stage {
    let mut stage = Stage::new().with(geometry, white(), Transform::IDENTITY);
    let height = 0.05;
    let down = DMat3::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    let place = DVec3::new(x.into(), height.into(), 0.0);
    stage.scene.cameras.push(Camera {
        name: "down".into(),
        motion: Motion::still(DAffine3::from_mat3_translation(down, place)),
        projection: Projection::Perspective { fov_y: 2.0 * (half / height).atan() },
        focus: None,
    });
    stage.settings = RenderSettings {
        width: 12,
        height: 12,
        samples: 8,
        integrator: IntegratorKind::Path,
        filter: Filter::Box,
        filter_radius: 0.5,
        caustics: Caustics::Photons,
        caustic_photons: 50_000,
        ..RenderSettings::default()
    };
    stage
}

fn lamp(size: f32, y: f64) -> LightKind {
    LightKind::Area {
        geometry: rectangle(size, size),
        transform: tilted(180.0, 0.0, y, 0.0),
        two_sided: false,
        visible: true,
        falloff: Falloff::InverseSquare,
    }
}

/// The mean of the picture.
fn mean(frame: &Frame) -> Rgb {
    let channel = |name: &str| {
        let values = &frame.channel(name).unwrap().values;
        values.iter().sum::<f32>() / values.len() as f32
    };
    Rgb::new(channel("R"), channel("G"), channel("B"))
}

fn photons(stage: &Stage) -> Rgb {
    mean(&render(&stage.scene, &stage.settings).unwrap())
}

fn paths(stage: &Stage, samples: u32) -> Rgb {
    let settings = RenderSettings { caustics: Caustics::Paths, samples, ..stage.settings.clone() };
    mean(&render(&stage.scene, &settings).unwrap())
}

#[track_caller]
fn assert_within(got: Rgb, expected: Rgb, share: f32, what: &str) {
    let error = ((got - expected) / expected).abs().max_element();
    assert!(error < share, "{what}: {got} for {expected}, off by {error}");
}

/// Without light that the floor itself sends back to it.
fn once() -> DepthLimits {
    DepthLimits { diffuse: 1, ..DepthLimits::default() }
}

#[test]
fn a_pane_lets_through_what_fresnel_says() {
    for degrees in [0.0_f32, 40.0, 65.0] {
        let angle = degrees.to_radians();
        let direction = Vec3::new(0.0, -angle.cos(), angle.sin());
        // What comes through lies beside the pane; what its far end mirrors lies beyond the floor.
        let pane = cuboid(3.4, 0.1, 3.4);
        // What it sends back to the pane, nothing else sees.
        let mut stage = ground(rectangle(0.7, 0.7), 0.0, 0.3)
            .with(pane, glass(1.5), at(0.0, 0.3, -0.3 * angle.tan()))
            .with_light(2.0, 1, LightKind::Directional { direction, angle: 0.0 });
        stage.settings.depth_limits = once();
        stage.settings.caustic_radius = Some(0.03);
        stage.settings.caustic_photons = 150_000;
        assert_eq!(paths(&stage, 8), Rgb::ZERO);
        // Fresnel's equations without polarization, and all reflections between both faces.
        let (cos, cos_in) = (angle.cos(), (1.0 - (angle.sin() / 1.5).powi(2)).sqrt());
        let amplitudes =
            [(cos - 1.5 * cos_in) / (cos + 1.5 * cos_in), (1.5 * cos - cos_in) / (1.5 * cos + cos_in)];
        let face = 0.5 * (amplitudes[0].powi(2) + amplitudes[1].powi(2));
        let expected = 2.0 * cos * (1.0 - face) / (1.0 + face) / PI;
        assert_within(photons(&stage), Rgb::splat(expected), 0.01, &format!("{degrees} degrees"));
    }
}

#[test]
fn a_point_light_in_a_mirror_is_one_behind_it() {
    // The mirror stands at x = -1 and faces +x; the light stands at x = 0.
    let turn = DMat3::from_rotation_z(-std::f64::consts::FRAC_PI_2);
    let place = DAffine3::from_mat3_translation(turn, DVec3::new(-1.0, 0.6, 0.0));
    let light = Vec3::new(0.0, 1.0, 0.0);
    let mut stage = floor(0.5, 0.2)
        .with(rectangle(1.0, 1.0), mirror(), Transform::new(place).unwrap())
        .with_point_light(3.0, light);
    stage.settings.depth_limits = once();
    stage.settings.caustic_radius = Some(0.04);
    stage.settings.caustic_photons = 150_000;
    // The mean over the square that is seen, from a light one metre above at x.
    let seen_from = |x: f32| {
        let steps = 64;
        let at = |i: i32| 0.4 * ((i as f32 + 0.5) / steps as f32 - 0.5);
        let answer = |i: i32| {
            let (x, z) = (0.5 + at(i % steps) - x, at(i / steps));
            3.0 / PI / (x * x + z * z + 1.0).powf(1.5)
        };
        (0..steps * steps).map(answer).sum::<f32>() / (steps * steps) as f32
    };
    let direct = paths(&stage, 8);
    assert_within(direct, Rgb::splat(seen_from(0.0)), 0.01, "direct");
    assert_within(photons(&stage) - direct, Rgb::splat(seen_from(-2.0)), 0.01, "mirrored");
}

#[test]
fn a_ball_gathers_what_paths_find() {
    let mut stage =
        floor(0.0, 0.25).with(sphere(0.3), glass(1.5), at(0.0, 0.5, 0.0)).with_light(9.0, 1, lamp(0.8, 2.0));
    stage.settings.caustic_radius = Some(0.01);
    stage.settings.samples = 16;
    assert_within(photons(&stage), paths(&stage, 1024), 0.02, "ball");
}

#[test]
fn a_ring_gathers_what_paths_find() {
    let mut stage = floor(0.0, 0.3).with(torus(0.4, 0.08), mirror(), at(0.0, 0.1, 0.0)).with_light(
        9.0,
        1,
        LightKind::Directional { direction: Vec3::new(0.6, -0.8, 0.0), angle: 0.5 },
    );
    stage.settings.caustic_radius = Some(0.01);
    stage.settings.samples = 16;
    assert_within(photons(&stage), paths(&stage, 1024), 0.02, "ring");
}

/// Glass with colours, a mesh with bent normals, a coated box, a sheet and a mirror under a lamp and a sun.
fn crowd() -> Stage {
    let prism = Standard {
        base_color: ColorInput::constant(Rgb::new(0.9, 0.7, 0.5)),
        transmission: FloatInput::constant(1.0),
        roughness: FloatInput::constant(0.0),
        absorption: Rgb::new(0.1, 1.0, 2.0),
        dispersion: 2.0,
        ..Standard::default()
    };
    let coated = Standard {
        base_color: ColorInput::constant(Rgb::new(0.3, 0.5, 0.2)),
        coat: FloatInput::constant(1.0),
        coat_roughness: FloatInput::constant(0.0),
        ..Standard::default()
    };
    let sheet = Standard { thin_walled: true, absorption: Rgb::ZERO, dispersion: 0.0, ..prism.clone() };
    let mut stage = floor(0.0, 0.5)
        .with_light(6.0, 1, lamp(1.5, 2.5))
        .with_light(2.0, 1, LightKind::Directional { direction: Vec3::new(0.5, -0.8, 0.1), angle: 0.6 })
        .with_sky(0.1);
    let mesh = stage.mesh(ball_mesh(0.25, 8, true));
    stage.add(mesh, glass(1.5), at(-0.35, 0.45, 0.1));
    standard(&mut stage, sphere(0.2), prism, at(0.3, 0.4, -0.2));
    standard(&mut stage, cuboid(0.3, 0.3, 0.3), coated, at(0.1, 0.3, 0.5));
    standard(&mut stage, rectangle(1.0, 1.0), sheet, tilted(60.0, 0.0, 0.9, -0.4));
    stage.add(rectangle(0.8, 0.8), mirror(), tilted(80.0, 0.0, 0.4, -0.6));
    stage.with_opacity(0.7)
}

#[test]
fn nothing_is_counted_twice_and_nothing_left_out() {
    let mut stage = crowd();
    stage.settings.caustic_radius = Some(0.02);
    stage.settings.samples = 32;
    assert_within(photons(&stage), paths(&stage, 2048), 0.02, "all");
    // Limits mean the same, whoever finds the light.
    for limits in [
        DepthLimits { total: 2, ..DepthLimits::default() },
        DepthLimits { transmission: 1, diffuse: 1, ..DepthLimits::default() },
        DepthLimits { glossy: 0, ..DepthLimits::default() },
    ] {
        stage.settings.depth_limits = limits;
        assert_within(photons(&stage), paths(&stage, 1024), 0.025, &format!("{limits:?}"));
    }
}

#[test]
fn a_lamp_in_solid_glass_keeps_its_light() {
    let bulb = LightKind::Area {
        geometry: sphere(0.15),
        transform: at(0.0, 0.6, 0.0),
        two_sided: false,
        visible: true,
        falloff: Falloff::InverseSquare,
    };
    let mut stage = floor(0.0, 0.5).with(sphere(0.3), glass(1.5), at(0.0, 0.6, 0.0)).with_light(9.0, 1, bulb);
    stage.settings.caustic_radius = Some(0.02);
    stage.settings.caustic_photons = 200_000;
    assert_within(photons(&stage), paths(&stage, 4096), 0.02, "bulb");
}

#[test]
fn threads_passes_and_regions_leave_no_trace() {
    let mut stage = crowd();
    let settings = RenderSettings { samples: 11, caustic_photons: 3000, ..stage.settings.clone() };
    let whole = render(&stage.scene, &RenderSettings { threads: 1, ..settings.clone() }).unwrap();
    assert_eq!(render(&stage.scene, &RenderSettings { threads: 3, ..settings.clone() }).unwrap(), whole);
    let prepared = Prepared::new(&stage.scene, &settings).unwrap();
    let mut film = prepared.film();
    for range in [0..1, 1..4, 4..11] {
        let control =
            Control { cancel: &AtomicBool::new(false), on_tile: &|tile| assert!(tile.done <= tile.total) };
        assert!(prepared.pass(&mut film, range, &control).finished);
    }
    assert_eq!(prepared.frame(&film), whole);
    let region = PixelRect { x0: 3, y0: 2, x1: 9, y1: 8 };
    let part = render(&stage.scene, &RenderSettings { region: Some(region), ..settings.clone() }).unwrap();
    for channel in ["R", "G", "B"] {
        let (whole, part) = (whole.channel(channel).unwrap(), part.channel(channel).unwrap());
        for (i, value) in part.values.iter().enumerate() {
            assert_eq!(*value, whole.values[(2 + i / 6) * 12 + 3 + i % 6]);
        }
    }
    // The bias is told, with the radius that was taken.
    let told = whole.meta.get("heliostat/causticRadius");
    assert!(matches!(told, Some(Meta::Float(radius)) if *radius > 0.0), "{told:?}");
    assert_eq!(whole.meta.get("heliostat/causticPhotons"), Some(&Meta::Int(3000)));
    stage.settings.caustics = Caustics::Paths;
    assert_eq!(render(&stage.scene, &stage.settings).unwrap().meta.get("heliostat/caustics"), None);
}

#[test]
fn where_nothing_is_smooth_photons_change_nothing() {
    let stage = floor(0.0, 0.3).with_light(3.0, 1, lamp(0.5, 1.0));
    assert_eq!(photons(&stage), paths(&stage, 8));
}

#[test]
fn what_cannot_be_is_refused() {
    let stage = floor(0.0, 0.3);
    let with = |change: fn(&mut RenderSettings)| {
        let mut settings = stage.settings.clone();
        change(&mut settings);
        Prepared::new(&stage.scene, &settings).err()
    };
    assert!(matches!(
        with(|settings| settings.integrator = IntegratorKind::VolPath),
        Some(RenderError::PhotonsNeedPath)
    ));
    let names = [
        (with(|settings| settings.caustic_photons = 0), "caustic_photons"),
        (with(|settings| settings.caustic_photons = u32::MAX), "caustic_photons"),
        (with(|settings| settings.caustic_radius = Some(0.0)), "caustic_radius"),
    ];
    for (error, expected) in names {
        assert!(matches!(error, Some(RenderError::Setting { name, .. }) if name == expected));
    }
    let whitted = with(|settings| settings.integrator = IntegratorKind::Whitted);
    assert!(whitted.is_none(), "{whitted:?}");
}
