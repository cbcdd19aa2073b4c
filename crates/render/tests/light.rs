//! Light sources against closed forms: what arrives at a white plane.

mod common;

use common::{
    Looker, Stage, assert_close, at, ball_mesh, black, grey, plane, rectangle, sphere, tilted, white,
};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use heliostat_geometry::shape::Disk;
use heliostat_geometry::{Shape, Transform};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::Phong;
use heliostat_scene::object::Geometry;
use std::f32::consts::PI;

/// Rounding of a few dozen `f32` operations.
const ROUNDING: f32 = 64.0 * f32::EPSILON;

fn area(geometry: Geometry, transform: Transform, two_sided: bool) -> LightKind {
    LightKind::Area { geometry, transform, two_sided, visible: false, falloff: Falloff::InverseSquare }
}

/// Irradiance at the point `x, 0, z` of a white floor.
fn irradiance(stage: &Stage, x: f32, z: f32) -> f32 {
    stage.grey(Vec3::new(x, 0.5, z), Vec3::new(x, 0.0, z))
}

#[test]
fn a_point_light_falls_off_with_the_square_and_the_cosine() {
    for scale in [1e-3_f32, 1.0, 1e4] {
        let intensity = 7.0 * scale * scale;
        let stage = Stage::new()
            .with(plane(), white(), Transform::IDENTITY)
            .with_point_light(intensity, Vec3::new(0.0, 3.0 * scale, 0.0));
        for x in [0.0_f32, 1.0, 4.0] {
            let x = x * scale;
            let seen = stage.grey(Vec3::new(x, scale, scale), Vec3::new(x, 0.0, 0.0));
            let d2 = x * x + 9.0 * scale * scale;
            assert_close(seen, intensity / d2 * (3.0 * scale / d2.sqrt()), ROUNDING);
        }
    }
}

#[test]
fn without_falloff_intensity_is_what_arrives_at_any_distance() {
    for y in [0.1_f32, 1.0, 1000.0] {
        let position = Vec3::new(0.0, y, 0.0);
        let kind = LightKind::Point { position, falloff: Falloff::None };
        let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(3.0, 1, kind);
        assert_close(stage.grey(Vec3::new(1.0, 1.0, 0.0), Vec3::ZERO), 3.0, ROUNDING);
    }
}

#[test]
fn a_spot_is_full_inside_gone_outside_and_half_in_the_middle() {
    let (inner, outer) = (20_f32.to_radians(), 40_f32.to_radians());
    let position = Vec3::new(0.0, 2.0, 0.0);
    let kind = LightKind::Spot { position, direction: Vec3::NEG_Y, inner, outer, falloff: Falloff::None };
    let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(1.0, 1, kind);
    let seen = |cos: f32| {
        let x = 2.0 * (1.0 - cos * cos).sqrt() / cos;
        irradiance(&stage, x, 0.0) / cos
    };
    assert_close(seen(10_f32.to_radians().cos()), 1.0, ROUNDING);
    assert_eq!(seen(41_f32.to_radians().cos()), 0.0);
    // Halfway between the two cosines a smooth step is one half; its slope there is 1.5 over their difference.
    assert_close(seen(0.5 * (inner.cos() + outer.cos())), 0.5, 100.0 * f32::EPSILON);
}

#[test]
fn a_directional_light_gives_its_irradiance_times_the_cosine() {
    let direction = Vec3::new(0.6, -0.8, 0.0);
    let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(
        5.0,
        1,
        LightKind::Directional { direction, angle: 0.0 },
    );
    assert_close(irradiance(&stage, 100.0, -30.0), 5.0 * 0.8, ROUNDING);
}

#[test]
fn ambient_lights_add_up_and_have_no_shadow() {
    let surface = Phong { ambient: grey(0.5), ..black() };
    let stage = Stage::new()
        .with(plane(), surface, Transform::IDENTITY)
        .with(sphere(1.0), black(), at(0.0, 2.0, 0.0))
        .with_light(1.0, 1, LightKind::Ambient)
        .with_light(2.0, 1, LightKind::Ambient);
    assert_eq!(irradiance(&stage, 0.0, 0.0), 1.5);
}

/// Irradiance from one quarter of a parallel rectangle: corner `(a, b)` at height `h` above the point.
fn quarter(a: f64, b: f64, h: f64) -> f64 {
    let (ra, rb) = ((a * a + h * h).sqrt(), (b * b + h * h).sqrt());
    0.5 * (a / ra * (b / ra).atan() + b / rb * (a / rb).atan())
}

#[test]
fn a_rectangle_lights_a_parallel_plane_by_its_form_factor() {
    // Faces downward: turned half about x. The form factor is in Howell, A Catalog of Radiation Heat Transfer
    // Configuration Factors, B-3; the irradiance is pi times it.
    for (w, d, h) in [(2.0_f64, 1.0_f64, 1.5_f64), (0.4, 3.0, 0.5), (200.0, 100.0, 150.0)] {
        let light = area(rectangle(w as f32, d as f32), tilted(180.0, 0.0, h, 0.0), false);
        let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(2.0, 4096, light);
        let centre = 2.0 * 4.0 * quarter(0.5 * w, 0.5 * d, h);
        assert_close(irradiance(&stage, 0.0, 0.0), centre as f32, 2e-3);
        // Below a corner there is one rectangle of full size.
        let corner = 2.0 * quarter(w, d, h);
        assert_close(irradiance(&stage, 0.5 * w as f32, 0.5 * d as f32), corner as f32, 4e-3);
    }
}

#[test]
fn a_sphere_lights_like_its_centre() {
    // E = pi L (r / d)^2 cos: Lambert's sphere, as long as all of it is above the horizon.
    let stretched = DAffine3::from_scale_rotation_translation(
        DVec3::splat(3.0),
        glam::DQuat::from_rotation_z(1.0),
        DVec3::new(1.0, 4.0, 0.0),
    );
    let places = [(0.5, at(1.0, 4.0, 0.0)), (1.0, Transform::new(stretched).unwrap())];
    for (radius, place) in places {
        let world_radius = if radius == 0.5 { 0.5_f32 } else { 3.0 };
        let light = area(sphere(radius), place, false);
        let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(2.0, 256, light);
        let expected = 2.0 * PI * world_radius.powi(2) / 17.0 * (4.0 / 17.0_f32.sqrt());
        assert_close(irradiance(&stage, 0.0, 0.0), expected, 2e-3);
    }
}

#[test]
fn a_sphere_stretched_to_an_ellipsoid_is_lit_by_its_area() {
    // Far away an ellipsoid shines like its shadow: E = L A / d^2 with A the ellipse across the way.
    let matrix =
        DAffine3 { matrix3: DMat3::from_diagonal(DVec3::new(2.0, 0.5, 1.0)), translation: DVec3::Y * 400.0 };
    let light = area(sphere(1.0), Transform::new(matrix).unwrap(), false);
    let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(1.0, 4096, light);
    assert_close(irradiance(&stage, 0.0, 0.0), 2.0 * PI / 400.0_f32.powi(2), 0.01);
}

#[test]
fn a_disk_lights_the_point_below_its_centre_by_its_angle() {
    // E = pi L sin^2 of half the angle that it covers.
    let disk = Geometry::Shape(Shape::Disk(Disk { radius: 2.0, inner_radius: 0.0 }));
    let light = area(disk, tilted(180.0, 5.0, 1.5, 0.0), false);
    let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(1.0, 4096, light);
    assert_close(irradiance(&stage, 5.0, 0.0), PI * 4.0 / (4.0 + 2.25), 4e-3);
}

#[test]
fn a_mesh_light_equals_the_sphere_it_is_made_of() {
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY);
    let mesh = stage.mesh(ball_mesh(1.0, 64, false));
    let stage = stage.with_light(2.0, 4096, area(mesh, at(0.0, 3.0, 0.0), false));
    // The mesh is inscribed: its shadow is smaller by about (pi / 64)^2 / 3.
    assert_close(irradiance(&stage, 0.0, 0.0), 2.0 * PI / 9.0, 0.01);
}

#[test]
fn the_back_of_an_area_light_is_dark_unless_it_is_two_sided() {
    for (two_sided, turned, lit) in
        [(false, 0.0, false), (false, 180.0, true), (true, 0.0, true), (true, 180.0, true)]
    {
        let light = area(rectangle(1.0, 1.0), tilted(turned, 0.0, 2.0, 0.0), two_sided);
        let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(1.0, 64, light);
        assert_eq!(irradiance(&stage, 0.0, 0.0) > 0.0, lit, "two-sided {two_sided}, turned by {turned}");
    }
}

#[test]
fn an_area_light_without_falloff_is_a_set_of_points() {
    let light = LightKind::Area {
        geometry: rectangle(0.2, 0.2),
        transform: at(0.0, 50.0, 0.0),
        two_sided: false,
        visible: false,
        falloff: Falloff::None,
    };
    let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(3.0, 16, light);
    // All points lie straight above to within 0.1 in 50: a cosine of 1 - 4e-6.
    assert_close(irradiance(&stage, 0.0, 0.0), 3.0, 1e-5);
}

#[test]
fn an_object_that_shines_lights_like_an_area_light() {
    let shining = Phong { emission: grey(2.0), ..black() };
    for tilt in [180.0, 0.0] {
        // Objects shine on both sides.
        let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with(
            rectangle(2.0, 1.0),
            shining.clone(),
            tilted(tilt, 0.0, 1.5, 0.0),
        );
        let mean = (0..64)
            .map(|i| stage.look_sample(Vec3::new(0.0, 1.0, 1.0), Vec3::ZERO, i).radiance.y)
            .sum::<f32>()
            / 64.0;
        assert_close(mean, (2.0 * 4.0 * quarter(1.0, 0.5, 1.5)) as f32, 4e-3);
    }
}

#[test]
fn a_shining_ball_lights_by_its_solid_angle_and_shades_what_is_behind_it() {
    let shining = Phong { emission: grey(2.0), ..black() };
    let stage = Stage::new()
        .with(plane(), white(), Transform::IDENTITY)
        .with(sphere(0.5), shining, at(0.0, 2.0, 0.0))
        .with_point_light(100.0, Vec3::new(0.0, 10.0, 0.0));
    // The point light above it is hidden: what arrives is the ball's alone.
    assert_close(stage.grey(Vec3::new(1.0, 1.0, 0.0), Vec3::ZERO), 2.0 * PI * 0.25 / 4.0, 2e-3);
    // Seen by itself it has its emission.
    assert_eq!(stage.grey(Vec3::new(0.0, 2.0, 5.0), Vec3::new(0.0, 2.0, 0.0)), 2.0);
}

#[test]
fn a_wide_directional_light_keeps_its_irradiance() {
    let kind = LightKind::Directional { direction: Vec3::NEG_Y, angle: 0.2 };
    let stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(4.0, 256, kind);
    // The mean cosine over a cap of half angle 0.1 is (1 + cos 0.1) / 2.
    assert_close(irradiance(&stage, 0.0, 0.0), 4.0 * 0.5 * (1.0 + 0.1_f32.cos()), 1e-4);
}

#[test]
fn visible_lights_are_seen_on_their_shining_side_and_throw_no_shadow() {
    let light = |visible| LightKind::Area {
        geometry: sphere(0.5),
        transform: at(0.0, 2.0, 0.0),
        two_sided: false,
        visible,
        falloff: Falloff::InverseSquare,
    };
    let from = Vec3::new(0.0, 2.0, 5.0);
    for visible in [false, true] {
        let stage = Stage::new()
            .with(plane(), white(), Transform::IDENTITY)
            .with_light(3.0, 4, light(visible))
            // A bulb: a point light inside the ball lights the floor through it.
            .with_point_light(8.0, Vec3::new(0.0, 2.0, 0.0));
        let seen = stage.look(from, Vec3::new(0.0, 2.0, 0.0));
        assert_eq!(seen.radiance.y, if visible { 3.0 } else { 0.0 });
        assert_eq!(seen.first.is_some(), visible);
        let floor =
            Looker::new(&stage).look(Vec3::new(1.0, 1.0, 0.0), Vec3::new(-1.0, -1.0, 0.0).normalize(), 0);
        assert_close(floor.radiance.y, 8.0 / 4.0 + 3.0 * PI * 0.25 / 4.0, 0.02);
    }
}
