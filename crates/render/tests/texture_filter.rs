//! Textures over what rays stand for: far away they keep their mean and lose their noise, near by they stay as they are.

mod common;

use common::{Stage, grey, plane};
use glam::{DAffine3, DMat3, DVec3, Vec2};
use heliostat_geometry::Transform;
use heliostat_render::Prepared;
use heliostat_scene::camera::{Camera, Projection};
use heliostat_scene::image::{Encoding, Image, Samples};
use heliostat_scene::light::LightKind;
use heliostat_scene::material::{ColorInput, Phong};
use heliostat_scene::settings::Filter;
use heliostat_scene::texture::{CheckerSpace, Filtering, Minify, Pattern, Texture, UvTransform, Wrap};
use heliostat_scene::{Motion, RenderSettings, Rgb, TextureId};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Black and white texels in turn.
fn board(minify: Minify) -> Pattern {
    let texels = (0..64 * 64_u32).map(|i| if (i % 64 + i / 64).is_multiple_of(2) { 255 } else { 0 });
    let samples = Samples::U8(texels.collect());
    Pattern::Image {
        image: Arc::new(Image::new(64, 64, 1, Encoding::Srgb, samples)),
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Repeat,
        filtering: Filtering::Bilinear,
        minify,
    }
}

/// A floor that shows a texture as it is, `scale` times in a metre.
fn floor(pattern: Pattern, scale: f32) -> Stage {
    let phong = Phong {
        ambient: ColorInput { factor: Rgb::ONE, texture: Some(TextureId(0)) },
        diffuse: grey(0.0),
        ..Phong::default()
    };
    let uv = UvTransform { scale: Vec2::splat(scale), ..UvTransform::default() };
    let mut stage = Stage::new();
    stage.scene.textures.push(Texture { name: "board".to_owned(), pattern, uv });
    stage.with(plane(), phong, Transform::IDENTITY).with_light(1.0, 1, LightKind::Ambient)
}

/// One metre above the floor, towards the horizon, which lies in the middle of the picture.
fn to_the_horizon() -> Camera {
    let motion = Motion::still(DAffine3::from_translation(DVec3::Y));
    Camera {
        name: "main".to_owned(),
        motion,
        projection: Projection::Perspective { fov_y: 1.0 },
        focus: None,
    }
}

/// From above, a metre high.
fn from_above() -> Camera {
    let turn = DMat3::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    let pose = DAffine3::from_mat3_translation(turn, DVec3::Y);
    Camera {
        motion: Motion::still(pose),
        projection: Projection::Orthographic { height: 1.0 },
        ..to_the_horizon()
    }
}

/// The green channel of a picture.
fn green(stage: &Stage, camera: Camera, size: [u32; 2], samples: u32, mip_maps: bool) -> Vec<f32> {
    let mut scene = stage.scene.clone();
    scene.cameras.push(camera);
    let settings = RenderSettings {
        width: size[0],
        height: size[1],
        samples,
        filter: Filter::Box,
        filter_radius: 0.5,
        mip_maps,
        threads: 1,
        ..RenderSettings::default()
    };
    let prepared = Prepared::new(&scene, &settings).expect("the scene is valid");
    let mut film = prepared.film();
    let cancel = AtomicBool::new(false);
    let control = heliostat_render::Control { cancel: &cancel, on_tile: &|_| {} };
    prepared.pass(&mut film, 0..samples, &control);
    prepared.frame(&film).channel("G").expect("a picture has colours").values.clone()
}

fn mean(values: &[f32]) -> f32 {
    values.iter().sum::<f32>() / values.len() as f32
}

fn rms(a: &[f32], b: &[f32]) -> f32 {
    let squares: Vec<f32> = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).collect();
    mean(&squares).sqrt()
}

/// A board towards the horizon with few samples, against many points: the noise falls and the mean stays.
#[track_caller]
fn noise_falls(pattern: Pattern, scale: f32, least: f32) {
    let stage = floor(pattern, scale);
    let size = [32, 24];
    // The lower half is floor.
    let look =
        |samples, mip_maps| green(&stage, to_the_horizon(), size, samples, mip_maps)[32 * 13..].to_vec();
    let truth = look(1024, false);
    let (points, means) = (look(1, false), look(1, true));
    let (noise, left) = (rms(&points, &truth), rms(&means, &truth));
    assert!(noise > least, "points are noisy: {noise}");
    assert!(left < 0.25 * noise, "{left} of {noise}");
    // The standard error of the mean over all points is their noise by the root of their number.
    assert!((mean(&means) - mean(&truth)).abs() < 0.01, "{} {}", mean(&means), mean(&truth));
}

#[test]
fn images_lose_noise_towards_the_horizon_and_keep_their_mean() {
    // Bilinear values of a board are a product of two triangle waves: their deviation is 1/6, and a pixel above.
    noise_falls(board(Minify::Mip), 0.5, 0.1);
}

#[test]
fn checkers_lose_noise_towards_the_horizon_and_keep_their_mean() {
    let pattern = Pattern::Checker { even: Rgb::ONE, odd: Rgb::ZERO, space: CheckerSpace::Uv };
    // Black or white: 1/2, less where squares are larger than pixels.
    noise_falls(pattern, 16.0, 0.3);
}

#[test]
fn a_sampler_without_smaller_copies_is_obeyed() {
    let look = |minify, mip_maps| {
        green(&floor(board(minify), 0.5), to_the_horizon(), [16, 12], 1, mip_maps)[16 * 7..].to_vec()
    };
    assert_eq!(look(Minify::Bilinear, true), look(Minify::Bilinear, false));
    let nearest = look(Minify::Nearest, true);
    let first_rows = nearest.len() / 2;
    assert!(nearest[..first_rows].iter().all(|&v| v == 0.0 || v == 1.0), "{nearest:?}");
}

#[test]
fn what_is_shown_texel_by_texel_is_not_blurred() {
    let stage = floor(board(Minify::Mip), 1.0);
    // 64 texels on 80 pixels: bit for bit the same.
    let look = |size, mip_maps| green(&stage, from_above(), [size, size], 1, mip_maps);
    assert_eq!(look(80, true), look(80, false));
    // Texel on pixel, up to rounding.
    assert!(rms(&look(64, true), &look(64, false)) < 1e-3);
    // Two texels on a pixel: the mean of both.
    let halved = look(32, true);
    assert!(halved.iter().all(|v| (v - 0.5).abs() < 0.01), "{halved:?}");
}
