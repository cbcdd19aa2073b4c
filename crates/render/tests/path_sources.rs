//! `path` and `path_simple` agree on textured emission, daylight, measured lamps and things out of the light's way.

mod common;

use common::{Estimate, Stage, at, ball_mesh, black, grey, plane, rectangle, sphere, tilted, white};
use glam::Vec3;
use heliostat_geometry::Transform;
use heliostat_scene::image::{Encoding, Samples};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::{ColorInput, Phong};
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::{Background, Daylight};
use heliostat_scene::settings::{IntegratorKind, LightChoice};
use heliostat_scene::texture::{Filtering, Minify, Pattern, Texture, UvTransform, Wrap};
use heliostat_scene::{Image, Profile, Rgb, TextureId};
use std::sync::Arc;

const FROM: Vec3 = Vec3::new(0.5, 1.5, 4.0);
const FLOOR: Vec3 = Vec3::new(0.2, 0.0, 0.3);

fn seen(stage: &mut Stage, kind: IntegratorKind, samples: u32) -> Estimate {
    stage.settings.integrator = kind;
    Estimate::new(stage, FROM, FLOOR, samples)
}

#[track_caller]
fn assert_agree(mut stage: Stage, what: &str) {
    let simple = seen(&mut stage, IntegratorKind::PathSimple, 1024);
    for choice in [LightChoice::Tree, LightChoice::Power, LightChoice::Uniform] {
        stage.settings.light_choice = choice;
        let path = seen(&mut stage, IntegratorKind::Path, 256);
        assert!(path.mean.min_element() > 0.0, "{what} is black: {path:?}");
        path.assert_same(&simple, what);
    }
}

/// A floor under something that shines with a picture: 16 x 16 texels, dim but for a bright corner.
fn under_picture(lamp: impl Fn(&mut Stage) -> Geometry, place: Transform) -> Stage {
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY);
    let geometry = lamp(&mut stage);
    let bright = |i: usize| i % 16 < 3 && i / 16 < 2;
    let values = (0..256).map(|i| if bright(i) { 12.0 } else { 0.05 }).collect();
    let image = Image::new(16, 16, 1, Encoding::Linear, Samples::F32(values));
    stage.scene.textures.push(Texture {
        name: "picture".to_owned(),
        pattern: Pattern::Image {
            image: Arc::new(image),
            wrap_u: Wrap::Clamp,
            wrap_v: Wrap::Clamp,
            filtering: Filtering::Bilinear,
            minify: Minify::Bilinear,
        },
        uv: UvTransform::default(),
    });
    let texture = Some(TextureId(0));
    stage.with(geometry, Phong { emission: ColorInput { factor: Rgb::ONE, texture }, ..black() }, place)
}

#[test]
fn textures_that_shine() {
    let down = || tilted(180.0, 0.3, 1.2, 0.2);
    assert_agree(under_picture(|_| rectangle(1.2, 0.9), down()), "rectangle");
    assert_agree(under_picture(|stage| stage.mesh(ball_mesh(0.4, 6, true)), at(0.0, 1.0, 0.0)), "mesh");
    let quad = |stage: &mut Stage| {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        stage.mesh(heliostat_geometry::TriMesh {
            positions: corners.map(|(x, z)| Vec3::new(x - 0.5, 0.0, z - 0.5)).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            uvs: corners.map(|(u, v)| glam::Vec2::new(u, v)).to_vec(),
            ..heliostat_geometry::TriMesh::default()
        })
    };
    assert_agree(under_picture(quad, down()), "two triangles");
}

#[test]
fn light_from_a_bright_corner_is_found() {
    let mut stage = under_picture(|_| rectangle(1.2, 0.9), tilted(180.0, 0.3, 1.2, 0.2));
    let found = seen(&mut stage, IntegratorKind::Direct, 64);
    let noise = found.deviation.x / found.mean.x;
    // Uniform points would find the corner once in 43 times: of 2048 samples the mean would be uncertain by
    // sqrt(43 / 2048), 14 percent.
    assert!(noise < 0.03, "{noise}");
}

#[test]
fn daylight() {
    let day = |elevation: f32| {
        let (sin, cos) = elevation.to_radians().sin_cos();
        Background::Daylight(Daylight {
            to_sun: Vec3::new(0.6 * cos, sin, 0.8 * cos),
            turbidity: 4.0,
            ground_albedo: Rgb::splat(0.2),
            intensity: Rgb::splat(0.01),
            // So dim that rays that find it by chance do not drown all else in noise.
            sun: 1.0e-4,
        })
    };
    for elevation in [40.0, 3.0] {
        let mut stage =
            Stage::new().with(plane(), Phong { diffuse: grey(0.5), ..white() }, Transform::IDENTITY);
        stage.add(sphere(0.4), white(), at(0.6, 0.4, 0.2));
        stage.scene.background = day(elevation);
        assert_agree(stage, "daylight");
    }
}

#[test]
fn lamps_as_they_were_measured() {
    let profile = Profile::new(vec![0.0, 0.5, 1.2], vec![0.0, 1.0], vec![2.0, 4.0, 0.0, 1.0, 8.0, 0.0]);
    let lamp = |x: f32| LightKind::Measured {
        position: Vec3::new(x, 1.5, 0.0),
        axis: Vec3::new(0.0, -1.0, 0.0),
        across: Vec3::X,
        profile: Arc::new(profile.clone().unwrap()),
        falloff: Falloff::InverseSquare,
    };
    let stage = Stage::new().with(plane(), Phong { diffuse: grey(0.5), ..white() }, Transform::IDENTITY);
    assert_agree(stage.with_light(0.4, 1, lamp(0.2)).with_light(0.2, 1, lamp(-0.5)), "measured");
}

#[test]
fn a_measured_lamp_throws_its_candela_over_the_squared_distance() {
    let profile = Profile::new(vec![0.0, 1.0], vec![0.0], vec![9.0, 9.0]).unwrap();
    let lamp = LightKind::Measured {
        position: Vec3::new(0.0, 3.0, 0.0),
        axis: Vec3::NEG_Y,
        across: Vec3::X,
        profile: Arc::new(profile),
        falloff: Falloff::InverseSquare,
    };
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(1.0, 1, lamp);
    stage.settings.integrator = IntegratorKind::Direct;
    let radiance = stage.grey(Vec3::new(0.5, 1.0, 0.0), Vec3::ZERO);
    assert!((radiance * std::f32::consts::PI - 1.0).abs() < 1e-4, "{radiance}");
}

#[test]
fn what_casts_no_shadow_is_out_of_the_way_of_all_light() {
    let room = || {
        let floor = Stage::new().with(plane(), Phong { diffuse: grey(0.6), ..white() }, Transform::IDENTITY);
        let lamp = LightKind::Area {
            geometry: rectangle(2.0, 2.0),
            transform: tilted(180.0, 0.5, 2.5, 0.5),
            two_sided: false,
            visible: true,
            falloff: Falloff::InverseSquare,
        };
        floor.with_light(4.0, 1, lamp).with_sky(0.2)
    };
    let mut stage = room();
    stage.add(sphere(0.6), white(), at(0.2, 1.0, 0.3)).casts_shadow = false;
    let mut empty = room();
    let (with, without) =
        (seen(&mut stage, IntegratorKind::Path, 256), seen(&mut empty, IntegratorKind::Path, 256));
    // The floor in front of the ball, which the camera sees past.
    with.assert_same(&without, "the floor under it");
    stage.add(sphere(0.2), Phong { emission: grey(2.0), ..black() }, at(-0.4, 0.6, 0.6)).casts_shadow = false;
    assert_agree(stage, "things out of the way");
}
