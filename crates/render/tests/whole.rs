//! Whole renders with the integrators of the crate: the same promises with real surfaces, lights and recursion.

mod common;
#[path = "formula/mod.rs"]
mod formula;

use common::{Stage, at, ball_mesh, cuboid, glass, grey, mirror, plane, rectangle, sphere, tilted, white};
use formula::{assert_same_channels, crop, pass, value};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use heliostat_geometry::Transform;
use heliostat_render::{Prepared, TreeCache, render};
use heliostat_scene::camera::{Camera, Focus, FocusMethod, Projection};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::Phong;
use heliostat_scene::settings::{Filter, IntegratorKind, Layers, PixelRect};
use heliostat_scene::{Frame, Motion, RenderSettings, Scene};

fn looking(from: DVec3, to: DVec3) -> Motion<DAffine3> {
    let z = (from - to).normalize();
    let x = DVec3::Y.cross(z).normalize();
    Motion::still(DAffine3::from_mat3_translation(DMat3::from_cols(x, z.cross(x), z), from))
}

/// Glass, mirror, a mesh, a moving ball and a soft light over a floor, through a lens.
fn room() -> Stage {
    let light = LightKind::Area {
        geometry: rectangle(1.0, 1.0),
        transform: tilted(180.0, 0.0, 4.0, 0.0),
        two_sided: false,
        visible: true,
        falloff: Falloff::InverseSquare,
    };
    let mut stage = Stage::new()
        .with(plane(), white(), Transform::IDENTITY)
        .with(sphere(0.7), glass(1.5), at(-0.8, 0.7, 0.5))
        .with(cuboid(1.0, 1.5, 0.2), Phong { mirror: grey(0.8), ..white() }, at(1.0, 0.75, -1.0))
        .with_light(8.0, 4, light)
        .with_sky(0.3);
    let mesh = stage.mesh(ball_mesh(0.4, 8, true));
    stage.add(mesh, white(), at(0.6, 0.4, 0.9));
    let poses = vec![at(-0.2, 1.6, -0.5), at(0.3, 1.7, -0.5)];
    stage.add(sphere(0.3), white(), at(0.0, 0.0, 0.0)).motion = Motion::through(poses).expect("two poses");
    let focus =
        Focus { distance: 5.0, lens_radius: 0.05, blades: 6, blade_rotation: 0.0, method: FocusMethod::Lens };
    stage.scene.cameras.push(Camera {
        name: "main".into(),
        motion: looking(DVec3::new(0.5, 1.5, 5.0), DVec3::new(0.0, 0.8, 0.0)),
        projection: Projection::Perspective { fov_y: 0.7 },
        focus: Some(focus),
    });
    stage
}

fn settings() -> RenderSettings {
    RenderSettings {
        width: 48,
        height: 32,
        samples: 4,
        layers: Layers::ALL,
        threads: 2,
        ..RenderSettings::default()
    }
}

const INTEGRATORS: [IntegratorKind; 6] = [
    IntegratorKind::Whitted,
    IntegratorKind::Normals,
    IntegratorKind::Depth,
    IntegratorKind::Uv,
    IntegratorKind::AmbientOcclusion,
    IntegratorKind::Cost,
];

#[test]
fn every_integrator_keeps_the_promise() {
    let scene = room().scene;
    for integrator in INTEGRATORS {
        for (filter, filter_radius) in [(Filter::BlackmanHarris, 1.5), (Filter::Mitchell, 2.0)] {
            let settings = RenderSettings { integrator, filter, filter_radius, ..settings() };
            let whole = render(&scene, &settings).unwrap();
            let what = format!("{integrator:?} {filter:?}");
            for threads in [1, 2, 8] {
                let other = render(&scene, &RenderSettings { threads, ..settings.clone() }).unwrap();
                assert_same_channels(&other, &whole, &what);
            }
            let window = PixelRect { x0: 11, y0: 5, x1: 37, y1: 23 };
            let part = render(&scene, &RenderSettings { region: Some(window), ..settings.clone() }).unwrap();
            assert_same_channels(&part, &crop(&whole, window), &what);
            let prepared = Prepared::with_cache(&scene, &settings, &mut TreeCache::default()).unwrap();
            let mut film = prepared.film();
            for sample in 0..4 {
                assert!(pass(&prepared, &mut film, sample..sample + 1).finished);
            }
            assert_same_channels(&prepared.frame(&film), &whole, &what);
        }
    }
}

#[test]
fn rays_are_counted_the_same_on_any_number_of_threads() {
    let scene = room().scene;
    let count = |threads| {
        let settings = RenderSettings { threads, ..settings() };
        let prepared = Prepared::new(&scene, &settings).unwrap();
        pass(&prepared, &mut prepared.film(), 0..4);
        prepared.stats()
    };
    let one = count(1);
    let many = count(5);
    assert_eq!(one.rays, many.rays);
    assert_eq!(one.rays.camera, 4 * 48 * 32);
    assert!(one.rays.shadow > one.rays.camera && one.rays.reflection > 0 && one.rays.refraction > 0);
    assert_eq!(one.non_finite_samples, 0);
    // The mesh has a tree; five objects may be too few for one of their own.
    let mesh = one.indices.iter().find(|index| index.name == "mesh 0").unwrap();
    assert_eq!(mesh.tree.primitives, 2 * 16 * 7);
    let totals = one.index_totals();
    assert_eq!(totals.trees, one.indices.len());
    assert!(totals.nodes >= mesh.tree.nodes && totals.bytes > 0);
}

#[test]
fn a_hall_of_mirrors_as_deep_as_allowed_does_not_exhaust_the_stack() {
    let pane = || rectangle(100.0, 100.0);
    let mut stage = Stage::new().with(pane(), mirror(), tilted(90.0, 0.0, 0.0, -1.0)).with(
        pane(),
        mirror(),
        tilted(-90.0, 0.0, 0.0, 1.0),
    );
    stage.scene.cameras.push(Camera {
        name: "main".into(),
        motion: Motion::still(DAffine3::IDENTITY),
        projection: Projection::Perspective { fov_y: 0.01 },
        focus: None,
    });
    let settings = RenderSettings { max_depth: 4096, min_weight: 0.0, width: 4, height: 4, ..settings() };
    let prepared = Prepared::new(&stage.scene, &settings).unwrap();
    pass(&prepared, &mut prepared.film(), 0..4);
    assert!(prepared.stats().rays.reflection >= 4096 * 16);
}

/// The centre of what is brighter than half in a row of pixels.
fn centre_of_light(frame: &Frame, y: u32) -> f32 {
    let lit: Vec<f32> =
        (0..frame.width).filter(|&x| value(frame, "A", x, y) > 0.5).map(|x| x as f32).collect();
    lit.iter().sum::<f32>() / lit.len() as f32
}

#[test]
fn a_ball_that_moves_while_the_shutter_is_open_is_a_ramp_at_both_ends() {
    // A bar from x = -0.5 to 0.5 moves 1 metre to the right: coverage rises over its way, and falls again.
    let poses = vec![at(-0.5, 0.0, 0.0), at(0.5, 0.0, 0.0)];
    let mut stage = Stage::new().with(cuboid(1.0, 10.0, 0.1), white(), at(0.0, 0.0, 0.0));
    stage.scene.objects[0].motion = Motion::through(poses).unwrap();
    stage.scene.cameras.push(Camera {
        name: "main".into(),
        motion: Motion::still(DAffine3::from_translation(DVec3::new(0.0, 0.0, 5.0))),
        projection: Projection::Orthographic { height: 2.0 },
        focus: None,
    });
    let settings = RenderSettings {
        width: 96,
        height: 32,
        samples: 64,
        filter: Filter::Box,
        filter_radius: 0.5,
        transparent_background: true,
        ..settings()
    };
    let frame = render(&stage.scene, &settings).unwrap();
    for x in 0..96 {
        let alpha = (0..32).map(|y| value(&frame, "A", x, y)).sum::<f32>() / 32.0;
        // The share of the time in which the bar, 1 wide, covers the place: a tent of half width 1.
        let place = (x as f32 + 0.5 - 48.0) / 16.0;
        let want = (1.0 - place.abs()).max(0.0);
        assert!((alpha - want).abs() < 0.01, "column {x}: {alpha} for {want}");
    }
    assert!((centre_of_light(&frame, 10) - 47.5).abs() <= 1.0);
}

#[test]
fn a_ball_covers_what_geometry_says_in_every_projection() {
    let radius = 0.5_f32;
    let distance = 4.0_f32;
    let angle = (radius / distance).asin();
    let cases = [
        (Projection::Perspective { fov_y: 0.6 }, angle.tan() / 0.3_f32.tan()),
        (Projection::Orthographic { height: 3.0 }, radius / 1.5),
        (Projection::Fisheye { fov: 2.0 }, angle),
    ];
    for (projection, half_heights) in cases {
        let mut stage = Stage::new().with(sphere(radius), white(), at(3.0, 1.0, -2.0));
        let eye = DVec3::new(3.0, 1.0, -2.0) + f64::from(distance) * DVec3::new(0.48, 0.6, 0.64);
        let motion = looking(eye, DVec3::new(3.0, 1.0, -2.0));
        stage.scene.cameras.push(Camera { name: "main".into(), motion, projection, focus: None });
        let settings =
            RenderSettings { width: 64, height: 64, samples: 16, transparent_background: true, ..settings() };
        let frame = render(&stage.scene, &settings).unwrap();
        let area: f32 = frame.channel("A").unwrap().values.iter().sum();
        let want = std::f32::consts::PI * (32.0 * half_heights).powi(2);
        assert!((area / want - 1.0).abs() < 5e-3, "{projection:?}: {area} for {want}");
    }
}

#[test]
fn the_blur_after_rendering_keeps_a_transparent_background_premultiplied() {
    let mut stage = room();
    stage.scene.objects.remove(0);
    stage.scene.cameras[0].focus = stage.scene.cameras[0].focus.map(|focus| Focus {
        method: FocusMethod::Post,
        lens_radius: 0.3,
        distance: 2.0,
        ..focus
    });
    let settings = RenderSettings { transparent_background: true, ..settings() };
    let frame = render(&stage.scene, &settings).unwrap();
    let alpha = &frame.channel("A").unwrap().values;
    assert!(alpha.iter().all(|&a| (0.0..=1.0).contains(&a)));
    assert!(alpha.iter().any(|&a| a > 0.1 && a < 0.9));
    for name in ["R", "G", "B"] {
        let values = &frame.channel(name).unwrap().values;
        assert!(
            values.iter().zip(alpha).all(|(&v, &a)| a > 0.0 || v == 0.0),
            "light where nothing is: {name}"
        );
    }
}

#[test]
fn an_empty_scene_is_its_background() {
    let scene = Scene {
        cameras: vec![Camera {
            name: "main".into(),
            motion: Motion::still(DAffine3::IDENTITY),
            projection: Projection::Panorama,
            focus: None,
        }],
        background: heliostat_scene::scene::Background::Constant(Vec3::new(0.1, 0.2, 0.3)),
        ..Scene::default()
    };
    let frame = render(&scene, &settings()).unwrap();
    for (name, want) in [("R", 0.1), ("G", 0.2), ("B", 0.3), ("A", 1.0), ("Z", 1e10)] {
        assert!(frame.channel(name).unwrap().values.iter().all(|v| *v == want), "{name}");
    }
}
