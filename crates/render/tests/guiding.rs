//! Guided paths: the same picture as without guiding, less noise where light comes by narrow ways, and the promises that all
//! pictures keep.

#![expect(clippy::unwrap_used, reason = "a picture that is not made fails its test")]

mod common;

use common::{Stage, at, black, cuboid, grey, mirror, plane, rectangle, sphere, tilted, white};
use glam::{DAffine3, DMat3, DVec3};
use heliostat_geometry::Transform;
use heliostat_render::{Control, Prepared, RenderError, render};
use heliostat_scene::camera::Projection;
use heliostat_scene::frame::Meta;
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::{ColorInput, FloatInput, Phong, Standard, Surface};
use heliostat_scene::settings::{Caustics, DepthLimits, Filter, Guiding, IntegratorKind, PixelRect};
use heliostat_scene::{Camera, Frame, Motion, RenderSettings, Rgb};
use std::sync::atomic::AtomicBool;

const SIDE: u32 = 6;

/// A floor that is lit by nothing but a small plate above it, which a lamp below the plate shines at.
fn bounce() -> Stage {
    let matte = |albedo| Phong { diffuse: grey(albedo), ..white() };
    seen(Stage::new())
        .with(plane(), matte(0.6), Transform::IDENTITY)
        .with(rectangle(0.5, 0.5), matte(0.9), tilted(180.0, 0.0, 2.0, 0.0))
        .with_light(40.0, 1, lamp(0.2, tilted(0.0, 0.0, 1.7, 0.0)))
}

/// The same with a glossy, a mirrored and a glass thing, a hole and a standard surface, under a dim sky.
fn crowd() -> Stage {
    let mut stage = bounce().with_sky(0.02);
    let shiny = Phong {
        diffuse: grey(0.3),
        specular: grey(0.4),
        mirror: grey(0.2),
        shininess: FloatInput::constant(30.0),
        ..white()
    };
    stage.add(sphere(0.3), shiny, at(0.5, 0.3, 0.2));
    stage.add(
        cuboid(0.3, 0.3, 0.3),
        Phong { transparency: grey(0.8), ior: 1.4, ..black() },
        at(-0.4, 0.3, 0.4),
    );
    stage.add(rectangle(0.6, 0.6), mirror(), tilted(80.0, 0.0, 0.4, -0.6));
    stage.add(rectangle(0.8, 0.8), white(), tilted(20.0, 0.2, 0.8, 0.1));
    let stage_with_hole = stage.with_opacity(0.5);
    let mut stage = stage_with_hole;
    stage.add(sphere(0.3), black(), at(-0.5, 0.3, -0.3));
    stage.last_material().surface = Surface::Standard(Box::new(Standard {
        base_color: ColorInput::constant(Rgb::new(0.8, 0.4, 0.2)),
        roughness: FloatInput::constant(0.4),
        coat: FloatInput::constant(1.0),
        coat_roughness: FloatInput::constant(0.0),
        ..Standard::default()
    }));
    stage
}

/// Looks at the floor from a slant.
fn seen(mut stage: Stage) -> Stage {
    let place = DVec3::new(0.2, 1.4, 2.6);
    let turn = DMat3::from_rotation_x(-0.55);
    stage.scene.cameras.push(Camera {
        name: "slant".into(),
        motion: Motion::still(DAffine3::from_mat3_translation(turn, place)),
        projection: Projection::Perspective { fov_y: 0.6 },
        focus: None,
    });
    stage.settings = RenderSettings {
        width: SIDE,
        height: SIDE,
        samples: 32,
        integrator: IntegratorKind::Path,
        filter: Filter::Box,
        filter_radius: 0.5,
        guiding: Guiding::Learn,
        guiding_paths: Some(20_000),
        ..RenderSettings::default()
    };
    stage
}

fn lamp(size: f32, transform: Transform) -> LightKind {
    LightKind::Area {
        geometry: rectangle(size, size),
        transform,
        two_sided: false,
        visible: true,
        falloff: Falloff::InverseSquare,
    }
}

fn changed(stage: &Stage, change: impl Fn(&mut RenderSettings)) -> RenderSettings {
    let mut settings = stage.settings.clone();
    change(&mut settings);
    settings
}

fn unguided(settings: &mut RenderSettings) {
    (settings.guiding, settings.guiding_paths) = (Guiding::None, None);
}

/// The mean of the picture, and the square of its error, from pictures with random numbers of their own.
fn mean(stage: &Stage, settings: &RenderSettings) -> (f64, f64) {
    const SEEDS: u64 = 16;
    let one = |seed| {
        let frame = render(&stage.scene, &RenderSettings { seed, ..settings.clone() }).unwrap();
        let sum = |name: &str| frame.channel(name).unwrap().values.iter().map(|&v| f64::from(v)).sum::<f64>();
        (sum("R") + sum("G") + sum("B")) / f64::from(3 * SIDE * SIDE)
    };
    let means: Vec<f64> = (0..SEEDS).map(one).collect();
    let n = SEEDS as f64;
    let mean = means.iter().sum::<f64>() / n;
    let squares = means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, squares / n)
}

/// Asserts that two means are of the same number, within four and a half deviations.
#[track_caller]
fn assert_same((a, a_square): (f64, f64), (b, b_square): (f64, f64), what: &str) {
    let allowed = 4.5 * (a_square + b_square).sqrt();
    assert!(a > 0.0 && (a - b).abs() <= allowed, "{what}: {a} and {b}, {allowed} allowed");
}

#[test]
fn guided_paths_find_what_others_find() {
    for (name, stage) in [("bounce", bounce()), ("crowd", crowd())] {
        let guided = mean(&stage, &stage.settings);
        let path = mean(&stage, &changed(&stage, |s| (unguided(s), s.samples = 128).0));
        assert_same(guided, path, name);
        let simple = changed(&stage, |settings| {
            unguided(settings);
            (settings.samples, settings.integrator) = (512, IntegratorKind::PathSimple);
        });
        assert_same(guided, mean(&stage, &simple), name);
    }
}

#[test]
fn limits_of_depth_mean_the_same() {
    let stage = crowd();
    for limits in [
        DepthLimits { total: 2, ..DepthLimits::default() },
        DepthLimits { diffuse: 1, ..DepthLimits::default() },
        DepthLimits { glossy: 0, transmission: 1, ..DepthLimits::default() },
    ] {
        let guided = changed(&stage, |settings| settings.depth_limits = limits);
        let path = changed(&stage, |s| (unguided(s), s.samples = 128, s.depth_limits = limits).0);
        assert_same(mean(&stage, &guided), mean(&stage, &path), &format!("{limits:?}"));
    }
}

#[test]
fn photons_and_guiding_share_out_the_light() {
    let stage = crowd();
    let photons = |settings: &mut RenderSettings| {
        (settings.caustics, settings.caustic_photons, settings.samples) = (Caustics::Photons, 2000, 64);
    };
    let guided = changed(&stage, photons);
    let path = changed(&stage, |settings| (photons(settings), unguided(settings)).0);
    assert_same(mean(&stage, &guided), mean(&stage, &path), "photons");
}

#[test]
fn light_by_narrow_ways_has_less_noise() {
    let stage = bounce();
    // The noise of single pixels, by pairs of pictures.
    let noise = |settings: &RenderSettings| {
        let frame = |seed| render(&stage.scene, &RenderSettings { seed, ..settings.clone() }).unwrap();
        let pair = |seed: u64| {
            let (a, b) = (frame(2 * seed), frame(2 * seed + 1));
            let values = |frame: &Frame| frame.channel("G").unwrap().values.clone();
            values(&a).iter().zip(values(&b)).map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>()
        };
        (0..3).map(pair).sum::<f64>()
    };
    let guided = noise(&changed(&stage, |settings| settings.guiding_paths = Some(150_000)));
    let path = noise(&changed(&stage, unguided));
    assert!(guided < 0.4 * path, "{guided} of {path}");
}

#[test]
fn threads_passes_and_regions_leave_no_trace() {
    let stage = crowd();
    let settings = RenderSettings { samples: 11, ..stage.settings.clone() };
    let whole = render(&stage.scene, &RenderSettings { threads: 1, ..settings.clone() }).unwrap();
    for threads in [2, 7] {
        let other = render(&stage.scene, &RenderSettings { threads, ..settings.clone() }).unwrap();
        assert_eq!(other, whole, "{threads} threads");
    }
    let prepared = Prepared::new(&stage.scene, &settings).unwrap();
    let mut film = prepared.film();
    // A pass that is cancelled at once learns nothing, and hurts nobody.
    let control = |cancel| Control { cancel, on_tile: &|tile| assert!(tile.done <= tile.total) };
    let (no, yes) = (AtomicBool::new(false), AtomicBool::new(true));
    let outcome = prepared.pass(&mut film, 0..11, &control(&yes));
    assert_eq!((outcome.finished, outcome.samples), (false, 0));
    for range in [0..1, 1..4, 4..11] {
        assert!(prepared.pass(&mut film, range, &control(&no)).finished);
    }
    assert_eq!(prepared.frame(&film), whole);
    // Practice is counted.
    assert!(prepared.stats().rays.camera > 11 * u64::from(SIDE * SIDE) + 15_000);
    let region = PixelRect { x0: 2, y0: 1, x1: 5, y1: 4 };
    let part = render(&stage.scene, &RenderSettings { region: Some(region), ..settings }).unwrap();
    for channel in ["R", "G", "B"] {
        let (whole, part) = (whole.channel(channel).unwrap(), part.channel(channel).unwrap());
        for (i, value) in part.values.iter().enumerate() {
            assert_eq!(*value, whole.values[(1 + i / 3) * SIDE as usize + 2 + i % 3]);
        }
    }
}

#[test]
fn the_file_says_how_much_was_learnt_from() {
    let stage = bounce();
    let told = |settings: &RenderSettings| {
        render(&stage.scene, settings).unwrap().meta.remove("heliostat/guidingPaths")
    };
    assert_eq!(told(&stage.settings), Some(Meta::Int(20_000)));
    // The least, where the picture is small.
    assert_eq!(told(&changed(&stage, |settings| settings.guiding_paths = None)), Some(Meta::Int(16_384)));
    assert_eq!(told(&changed(&stage, unguided)), None);
}

#[test]
fn what_cannot_be_is_refused() {
    let stage = bounce();
    let error = |change: fn(&mut RenderSettings)| Prepared::new(&stage.scene, &changed(&stage, change)).err();
    for error in [
        error(|settings| settings.integrator = IntegratorKind::VolPath),
        error(|settings| settings.integrator = IntegratorKind::PathSimple),
    ] {
        assert!(matches!(error, Some(RenderError::GuidingNeedsPath)), "{error:?}");
    }
    for error in [
        error(|settings| settings.guiding_paths = Some(0)),
        error(|settings| settings.guiding_paths = Some(u32::MAX)),
    ] {
        assert!(matches!(error, Some(RenderError::Setting { name: "guiding_paths", .. })), "{error:?}");
    }
    assert!(error(|settings| settings.integrator = IntegratorKind::Normals).is_none());
}

#[test]
fn darkness_and_few_paths_are_no_trouble() {
    let dark = seen(Stage::new()).with(plane(), white(), Transform::IDENTITY);
    let frame = render(&dark.scene, &dark.settings).unwrap();
    assert!(frame.channel("G").unwrap().values.iter().all(|&v| v == 0.0));
    let stage = bounce();
    let few = changed(&stage, |settings| settings.guiding_paths = Some(1));
    let path = changed(&stage, unguided);
    assert_same(mean(&stage, &few), mean(&stage, &path), "one path");
    let empty = seen(Stage::new().with_sky(1.0));
    assert_eq!(render(&empty.scene, &empty.settings).unwrap().channel("G").unwrap().values[0], 1.0);
}
