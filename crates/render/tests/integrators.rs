//! The integrators beside Whitted's, against planted answers and closed forms.

mod common;

use common::{Stage, assert_close, at, black, cuboid, grey, plane, rectangle, sphere, tilted, white};
use glam::Vec3;
use heliostat_geometry::shape::Disk;
use heliostat_geometry::{Shape, Transform};
use heliostat_scene::Rgb;
use heliostat_scene::material::Phong;
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::IntegratorKind;

fn stage(kind: IntegratorKind) -> Stage {
    let mut stage = Stage::new();
    stage.settings.integrator = kind;
    stage
}

const ALL: [IntegratorKind; 6] = [
    IntegratorKind::Whitted,
    IntegratorKind::Normals,
    IntegratorKind::Depth,
    IntegratorKind::Uv,
    IntegratorKind::AmbientOcclusion,
    IntegratorKind::Cost,
];

#[test]
fn all_agree_on_the_first_hit() {
    let firsts = ALL.map(|kind| {
        let stage = stage(kind)
            .with(plane(), white(), Transform::IDENTITY)
            .with(rectangle(9.0, 9.0), white(), at(0.0, 3.0, 0.0))
            .with_opacity(0.0)
            .with(cuboid(1.0, 1.0, 1.0), white(), tilted(30.0, 0.2, 0.7, 0.1));
        stage.look(Vec3::new(1.0, 5.0, 4.0), Vec3::new(0.2, 0.8, 0.1)).first.unwrap()
    });
    assert_eq!(firsts[0].object, Some(2));
    assert!(firsts.iter().all(|first| *first == firsts[0]));
}

#[test]
fn nothing_is_seen_as_nothing() {
    for kind in ALL {
        let mut stage = stage(kind);
        stage.settings.transparent_background = true;
        let seen = stage.look(Vec3::ZERO, Vec3::X);
        assert_eq!(seen.first, None);
        if kind != IntegratorKind::Cost {
            assert_eq!((seen.radiance, seen.alpha), (Rgb::ZERO, 0.0));
        }
    }
}

#[test]
fn normals_are_shown_from_minus_one_to_one() {
    let stage = stage(IntegratorKind::Normals).with(cuboid(2.0, 2.0, 2.0), white(), Transform::IDENTITY);
    for n in [Vec3::X, Vec3::NEG_Y, Vec3::Z] {
        assert_eq!(stage.look(5.0 * n, Vec3::ZERO).radiance, 0.5 * (n + Vec3::ONE));
    }
    // From inside the normals point inside.
    assert_eq!(stage.look(Vec3::ZERO, Vec3::X).radiance, Vec3::new(0.0, 0.5, 0.5));
}

#[test]
fn uv_is_shown_as_red_and_green() {
    let stage = stage(IntegratorKind::Uv).with(rectangle(4.0, 2.0), white(), Transform::IDENTITY);
    let seen = stage.look(Vec3::new(-1.0, 1.0, 0.6), Vec3::new(-1.0, 0.0, 0.6)).radiance;
    assert!((seen - Vec3::new(0.25, 0.2, 0.0)).abs().max_element() < 1e-6, "{seen}");
}

#[test]
fn depth_runs_from_white_to_black_over_the_scene() {
    let stage = stage(IntegratorKind::Depth).with(cuboid(1.0, 1.0, 1.0), white(), at(-2.0, 0.0, 0.0)).with(
        cuboid(1.0, 1.0, 1.0),
        white(),
        at(2.0, 0.0, -8.0),
    );
    // The box of the scene spans z from 0.5 to -8.5.
    let seen = |x: f32| stage.grey(Vec3::new(x, 0.0, 10.0), Vec3::new(x, 0.0, 0.0));
    assert_close(seen(-2.0), 1.0, 1e-6);
    assert_close(seen(2.0), 1.0 / 9.0, 1e-5);
}

/// Mean over the samples of a pixel.
fn mean(stage: &Stage, from: Vec3, to: Vec3) -> f32 {
    (0..64).map(|i| stage.look_sample(from, to, i).radiance.y).sum::<f32>() / 64.0
}

#[test]
fn openness_is_one_minus_the_form_factor() {
    let disk = Geometry::Shape(Shape::Disk(Disk { radius: 1.5, inner_radius: 0.0 }));
    let covered = stage(IntegratorKind::AmbientOcclusion).with(plane(), white(), Transform::IDENTITY).with(
        disk,
        black(),
        at(0.0, 2.0, 0.0),
    );
    // A parallel disk covers r^2 / (r^2 + h^2) of the cosine-weighted hemisphere.
    let seen = mean(&covered, Vec3::new(0.5, 1.0, 0.0), Vec3::ZERO);
    assert_close(seen, 1.0 - 2.25 / 6.25, 2e-3);
    // A wall beside it covers half.
    let wall = stage(IntegratorKind::AmbientOcclusion).with(plane(), white(), Transform::IDENTITY).with(
        plane(),
        white(),
        tilted(90.0, 0.0, 0.0, -1e-3),
    );
    assert_close(mean(&wall, Vec3::new(0.5, 1.0, 1.0), Vec3::ZERO), 0.5, 2e-3);
    // An open plane is open.
    let open = stage(IntegratorKind::AmbientOcclusion).with(plane(), white(), Transform::IDENTITY);
    assert_eq!(mean(&open, Vec3::ONE, Vec3::ZERO), 1.0);
}

#[test]
fn occlusion_ends_at_its_distance() {
    let mut stage = stage(IntegratorKind::AmbientOcclusion)
        .with(sphere(1.0), white(), Transform::IDENTITY)
        .with(sphere(3.0), white(), Transform::IDENTITY);
    let seen = |stage: &Stage| stage.grey(Vec3::new(0.0, 2.0, 0.0), Vec3::ZERO);
    assert_eq!(seen(&stage), 0.0);
    // From radius 1 to radius 3 it is 2 straight up and 8^(1/2) along the horizon.
    stage.settings.ao_distance = 1.99;
    assert_eq!(seen(&stage), 1.0);
    stage.settings.ao_distance = 8.01_f32.sqrt();
    assert_eq!(seen(&stage), 0.0);
}

#[test]
fn cost_grows_with_what_lies_on_the_way() {
    let mut stage = stage(IntegratorKind::Cost);
    for i in 0..64 {
        stage.add(
            sphere(0.3),
            Phong { ambient: grey(0.0), ..white() },
            at((i % 8) as f32, (i / 8) as f32, 0.0),
        );
    }
    // Through the corners of the boxes of one row, past its balls.
    let along = stage.look(Vec3::new(-5.0, 3.25, 0.25), Vec3::new(0.0, 3.25, 0.25)).radiance;
    let beside = stage.look(Vec3::new(-5.0, 50.0, 0.0), Vec3::new(0.0, 50.0, 0.0)).radiance;
    // The scale begins nearly black; what passes 8 balls is some colour of the middle.
    assert!(beside.max_element() < 0.05 && along.max_element() > 0.5, "{along} {beside}");
}
