//! Lights and surfaces under paths, against closed forms.

mod common;

use common::{
    Estimate, Stage, assert_close, at, ball_mesh, glass, grey, plane, rectangle, sphere, tilted, torus, white,
};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use heliostat_geometry::shape::Disk;
use heliostat_geometry::{Shape, Transform};
use heliostat_scene::Rgb;
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::{FloatInput, FresnelMode, Phong};
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::settings::IntegratorKind;
use std::f32::consts::PI;

fn stage(kind: IntegratorKind) -> Stage {
    let mut stage = Stage::new();
    stage.settings.integrator = kind;
    stage
}

/// A white floor under direct light.
fn floor() -> Stage {
    stage(IntegratorKind::Direct).with(plane(), white(), Transform::IDENTITY)
}

fn area(geometry: Geometry, transform: Transform) -> LightKind {
    LightKind::Area { geometry, transform, two_sided: false, visible: true, falloff: Falloff::InverseSquare }
}

/// Irradiance at the point `x, 0, z` of the floor: pi times the radiance of a white one.
#[track_caller]
fn assert_irradiance(stage: &Stage, [x, z]: [f32; 2], expected: f32, what: &str) {
    let seen = Estimate::new(stage, Vec3::new(x, 0.05, z), Vec3::new(x, 0.0, z), 32);
    seen.assert_is(Rgb::splat(expected / PI), what);
}

/// Irradiance below a corner of a parallel rectangle `a` by `b` at the height `h`.
///
/// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3.
fn under_corner(a: f32, b: f32, h: f32) -> f32 {
    let (x, y) = (a / h, b / h);
    let (u, v) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    0.5 * (x / u * (y / u).atan() + y / v * (x / v).atan())
}

#[test]
fn rectangles_at_any_distance() {
    for h in [0.1_f32, 0.6, 3.0, 40.0] {
        let stage =
            floor().with_light(2.0, 1, area(rectangle(1.0, 0.6), tilted(180.0, 0.0, f64::from(h), 0.0)));
        assert_irradiance(&stage, [0.0, 0.0], 8.0 * under_corner(0.5, 0.3, h), &format!("centre, {h}"));
        // Beside it, as a difference of two pairs of corners.
        let beside = 4.0 * (under_corner(1.5, 0.3, h) - under_corner(0.5, 0.3, h));
        assert_irradiance(&stage, [1.0, 0.0], beside, &format!("beside, {h}"));
    }
}

#[test]
fn disks_and_spheres_and_meshes() {
    for h in [0.5_f32, 2.0, 30.0] {
        let disk = Geometry::Shape(Shape::Disk(Disk { radius: 0.4, inner_radius: 0.0 }));
        let stage = floor().with_light(3.0, 1, area(disk, tilted(180.0, 0.0, f64::from(h), 0.0)));
        assert_irradiance(&stage, [0.0, 0.0], 3.0 * PI * 0.16 / (0.16 + h * h), "disk");

        let expected = |x: f32| 3.0 * PI * 0.16 * h / (x * x + h * h).powf(1.5);
        let ball = floor().with_light(3.0, 1, area(sphere(0.4), at(0.0, h, 0.0)));
        assert_irradiance(&ball, [0.0, 0.0], expected(0.0), "sphere");
        assert_irradiance(&ball, [1.0, 0.0], expected(1.0), "sphere beside");

        let mut stage = floor();
        let mesh = stage.mesh(ball_mesh(0.4, 48, false));
        let stage = stage.with_light(3.0, 1, area(mesh, at(0.0, h, 0.0)));
        // Facets lie inside the sphere: a thousandth of its area is missing.
        let seen = Estimate::new(&stage, Vec3::new(1.0, 0.05, 0.0), Vec3::X, 256);
        assert_close(seen.mean.x, expected(1.0) / PI, 0.002 + 4.5 * seen.deviation.x / seen.mean.x);
    }
}

#[test]
fn a_squeezed_sphere_that_shines_on_both_sides() {
    // A sphere scaled to a flat disk sends what the disk sends.
    let flat = DMat3::from_diagonal(DVec3::new(1.0, 1e-3, 1.0));
    let place = Transform::new(DAffine3::from_mat3_translation(flat, DVec3::new(0.0, 2.0, 0.0))).unwrap();
    let stage = floor().with(sphere(0.5), Phong { emission: grey(4.0), ..common::black() }, place);
    assert_irradiance(&stage, [0.0, 0.0], 4.0 * PI * 0.25 / 4.25, "squeezed sphere");
}

#[test]
fn a_sun_throws_its_intensity() {
    for angle in [0.0_f32, 0.01, 0.5, 2.0] {
        let sun = LightKind::Directional { direction: Vec3::NEG_Y, angle };
        assert_irradiance(&floor().with_light(3.0, 1, sun), [0.0, 0.0], 3.0, &format!("sun of {angle}"));
    }
}

#[test]
fn ambient_light_is_irradiance_and_is_not_seen() {
    let stage = floor().with_light(3.0, 1, LightKind::Ambient);
    assert_irradiance(&stage, [0.0, 0.0], 3.0, "ambient");
    assert_eq!(stage.look(Vec3::Y, 2.0 * Vec3::Y).radiance, Rgb::ZERO);
}

#[test]
fn a_gradient_throws_the_integral_of_its_upper_half() {
    let mut stage = floor();
    let [top, horizon, bottom] = [Rgb::new(1.0, 2.0, 4.0), Rgb::new(3.0, 1.0, 0.0), Rgb::splat(50.0)];
    stage.scene.background = Background::Gradient { top, horizon, bottom };
    // 2 pi times the integral of y (horizon + y (top - horizon)).
    let seen = Estimate::new(&stage, 0.05 * Vec3::Y, Vec3::ZERO, 32);
    seen.assert_is(horizon / 3.0 + top * (2.0 / 3.0), "gradient");
}

#[test]
fn a_closed_room_that_shines_adds_up_the_series() {
    for albedo in [0.0, 0.5, 0.8] {
        let shine = Phong { diffuse: grey(albedo), emission: grey(0.5), ..white() };
        let stage = stage(IntegratorKind::Path).with(sphere(3.0), shine, Transform::IDENTITY);
        let seen = Estimate::new(&stage, Vec3::new(0.3, 0.1, 0.0), Vec3::new(1.0, 0.2, 0.4), 64);
        seen.assert_is(Rgb::splat(0.5 / (1.0 - albedo)), &format!("albedo {albedo}"));
    }
}

#[test]
fn in_an_even_sky_nothing_white_is_seen() {
    let clear = Phong { fresnel: FresnelMode::Dielectric, ..glass(1.5) };
    let mixed = Phong { mirror: grey(0.3), diffuse: grey(0.3), transparency: grey(0.4), ..clear.clone() };
    for (what, phong) in
        [("matte", white()), ("mirror", common::mirror()), ("glass", clear), ("mixed", mixed)]
    {
        for geometry in [sphere(1.0), torus(1.0, 0.4)] {
            let stage = stage(IntegratorKind::Path).with(geometry, phong.clone(), Transform::IDENTITY);
            let stage = stage.with_sky(1.0);
            let seen = Estimate::new(&stage, Vec3::new(0.7, 3.0, 2.0), Vec3::new(0.6, 0.1, 0.1), 32);
            seen.assert_is(Rgb::ONE, what);
        }
    }
}

#[test]
fn a_highlight_makes_no_light() {
    for shininess in [0.0, 1.0, 30.0, 3000.0] {
        for height in [0.02_f32, 0.3, 5.0] {
            let phong = Phong {
                diffuse: grey(0.6),
                specular: grey(0.8),
                shininess: FloatInput::constant(shininess),
                ..white()
            };
            let stage = stage(IntegratorKind::Path).with(plane(), phong, Transform::IDENTITY).with_sky(1.0);
            let seen = Estimate::new(&stage, Vec3::new(1.0, height, 0.0), Vec3::ZERO, 64);
            assert!(seen.mean.x <= 1.0 + 4.5 * seen.deviation.x, "{shininess} {height}: {seen:?}");
            if height > 1.0 && shininess > 1.0 {
                assert!(seen.mean.x > 0.9, "{shininess} {height}: {seen:?}");
            }
        }
    }
}

#[test]
fn glass_on_the_floor_darkens_nothing_in_an_even_sky() {
    // The underside of the block lies in the floor: light comes back through it.
    let clear = Phong { fresnel: FresnelMode::Dielectric, ..glass(1.5) };
    let stage = stage(IntegratorKind::Path)
        .with(plane(), white(), Transform::IDENTITY)
        .with(common::cuboid(1.0, 1.0, 1.0), clear, at(0.0, 0.5, 0.0))
        .with_sky(1.0);
    let seen = Estimate::new(&stage, Vec3::new(0.2, 3.0, 1.0), Vec3::new(0.1, 0.0, 0.1), 128);
    seen.assert_is(Rgb::ONE, "glass on white");
}
