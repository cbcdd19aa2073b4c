//! Anti-aliasing, depth of field and motion blur of whole renders against closed forms.

mod formula;

use formula::{frame, light, scene, value};
use glam::{DAffine3, DVec3, Vec3};
use heliostat_render::{CameraRay, Sample, Sampler};
use heliostat_scene::camera::{Focus, FocusMethod, Projection};
use heliostat_scene::settings::Filter;
use heliostat_scene::{Camera, Motion, RenderSettings};

const WIDTH: u32 = 64;
const HEIGHT: u32 = 32;

/// A camera at the origin that sees a square world of 1 metre in 32 pixels, one metre away.
fn camera(focus: Option<Focus>) -> Camera {
    Camera {
        name: "main".into(),
        motion: Motion::still(DAffine3::IDENTITY),
        projection: Projection::Perspective { fov_y: 2.0 * 0.5_f32.atan() },
        focus,
    }
}

fn settings(samples: u32) -> RenderSettings {
    RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        samples,
        filter: Filter::Box,
        filter_radius: 0.5,
        threads: 2,
        ..RenderSettings::default()
    }
}

/// White to the right of `edge` metres on a wall at `depth`, black to the left.
fn wall(
    depth: f32,
    edge: impl Fn(f32) -> f32 + Sync + Send,
) -> impl Fn(&CameraRay, &mut Sampler) -> Sample + Sync + Send {
    move |ray, _| {
        let p = ray.ray.at((-depth - ray.ray.origin.z) / ray.ray.dir.z);
        light(if p.x > edge(ray.time) { Vec3::ONE } else { Vec3::ZERO })
    }
}

#[test]
fn an_edge_is_covered_by_its_share_of_the_pixel() {
    for samples in [1, 4, 16, 64] {
        for shift in [0.0, 0.25, 0.4, 0.875] {
            // The edge stands `shift` pixels into column 40.
            let edge = (40.0 + shift - 32.0) / 32.0;
            let picture = frame(&scene(camera(None)), &settings(samples), wall(1.0, move |_| edge));
            for y in 0..HEIGHT {
                assert_eq!(value(&picture, "R", 39, y), 0.0);
                assert_eq!(value(&picture, "R", 41, y), 1.0);
                let covered = value(&picture, "R", 40, y);
                let allowed = if samples == 1 { 1.0 } else { 1.0 / samples as f32 };
                assert!((covered - (1.0 - shift)).abs() <= allowed, "{samples}, {shift}: {covered}");
            }
        }
    }
}

#[test]
fn the_report_s_four_samples_smooth_an_edge_and_one_does_not() {
    let slanted = |ray: &CameraRay, _: &mut Sampler| {
        let p = ray.ray.at(-1.0 / ray.ray.dir.z);
        light(if p.x > 0.3 * p.y { Vec3::ONE } else { Vec3::ZERO })
    };
    let greys = |samples| {
        let picture = frame(&scene(camera(None)), &settings(samples), slanted);
        let values = &picture.channel("R").unwrap().values;
        values.iter().filter(|&&v| v > 0.0 && v < 1.0).count()
    };
    assert_eq!(greys(1), 0);
    assert!(greys(4) >= HEIGHT as usize / 2);
}

/// The share of a unit disk to the right of a chord at distance `d` from the centre.
fn beyond(d: f64) -> f64 {
    let d = d.clamp(-1.0, 1.0);
    (d.acos() - d * (1.0 - d * d).sqrt()) / std::f64::consts::PI
}

#[test]
fn a_lens_blurs_an_edge_like_the_disk_of_the_thin_lens() {
    let focus =
        Focus { distance: 2.0, lens_radius: 0.2, blades: 0, blade_rotation: 0.0, method: FocusMethod::Lens };
    for depth in [1.0_f32, 1.4, 4.0, 50.0] {
        // Similar triangles, in pixels of 1/32 at depth 1.
        let radius = f64::from(0.2 / 2.0 * (1.0 - 2.0 / depth).abs() * 32.0);
        let picture = frame(&scene(camera(Some(focus))), &settings(256), wall(depth, |_| 0.0));
        let mean = |x: u32| (0..HEIGHT).map(|y| f64::from(value(&picture, "R", x, y))).sum::<f64>() / 32.0;
        for x in 24..40 {
            // The box of the pixel over the disk: a mean of chords.
            let chord = |i: i32| beyond(-(f64::from(x) + (f64::from(i) + 0.5) / 64.0 - 32.0) / radius);
            let want = (0..64).map(chord).sum::<f64>() / 64.0;
            assert!((mean(x) - want).abs() < 1e-2, "depth {depth}, column {x}: {} for {want}", mean(x));
        }
    }
}

#[test]
fn a_wall_in_focus_is_sharp_into_the_corners() {
    let focus =
        Focus { distance: 2.0, lens_radius: 0.3, blades: 5, blade_rotation: 0.0, method: FocusMethod::Lens };
    // Checks of one pixel each, everywhere: any blur mixes them.
    let checks = |ray: &CameraRay, _: &mut Sampler| {
        let p = ray.ray.at((-2.0 - ray.ray.origin.z) / ray.ray.dir.z) * 16.0;
        light(Vec3::splat((p.x.floor() + p.y.floor()).rem_euclid(2.0)))
    };
    let picture = frame(&scene(camera(Some(focus))), &settings(16), checks);
    let values = &picture.channel("R").unwrap().values;
    let (x, y) = (|i: usize| i % 64, |i: usize| i / 64);
    for (i, &v) in values.iter().enumerate() {
        // A sample on the very border of a check may fall to either side.
        let want = ((x(i) + y(i) + 1) % 2) as f32;
        assert!((v - want).abs() <= 1.0 / 16.0, "pixel {}, {}: {v}", x(i), y(i));
    }
}

#[test]
fn a_moving_edge_is_a_linear_ramp() {
    // The edge runs from column 20 to column 44 while the shutter is open: 24 pixels of ramp.
    let picture =
        frame(&scene(camera(None)), &settings(256), wall(1.0, |time| (20.0 + 24.0 * time - 32.0) / 32.0));
    for x in 0..WIDTH {
        let mean = (0..HEIGHT).map(|y| value(&picture, "R", x, y)).sum::<f32>() / HEIGHT as f32;
        let want = ((x as f32 + 0.5 - 20.0) / 24.0).clamp(0.0, 1.0);
        // Five deviations of the mean of 32 pixels with 256 samples each.
        assert!((mean - want).abs() < 5e-3, "column {x}: {mean} for {want}");
    }
}

#[test]
fn a_moving_camera_makes_the_same_ramp() {
    let poses = [0.0, -0.25, -0.75].map(|x| DAffine3::from_translation(DVec3::new(x, 0.0, 0.0)));
    let moving = Camera { motion: Motion::through(poses.to_vec()).unwrap(), ..camera(None) };
    let picture = frame(&scene(moving), &settings(256), wall(1.0, |_| 0.0));
    // In the first half of the shutter the edge runs 8 pixels to the right, in the second 16.
    for x in 0..WIDTH {
        let mean = (0..HEIGHT).map(|y| value(&picture, "R", x, y)).sum::<f32>() / HEIGHT as f32;
        let at = x as f32 + 0.5 - 32.0;
        let want = if at < 8.0 { at / 16.0 } else { 0.5 + (at - 8.0) / 32.0 };
        assert!((mean - want.clamp(0.0, 1.0)).abs() < 1.5e-2, "column {x}: {mean} for {want}");
    }
}

#[test]
fn the_blur_after_rendering_agrees_with_the_lens_on_an_even_depth() {
    let with = |method| {
        let focus = Focus { distance: 1.0, lens_radius: 0.05, blades: 0, blade_rotation: 0.0, method };
        let hit = |ray: &CameraRay, sampler: &mut Sampler| {
            let sample = wall(4.0, |_| 0.0)(ray, sampler);
            let p = ray.ray.at((-4.0 - ray.ray.origin.z) / ray.ray.dir.z);
            let first = heliostat_render::FirstHit {
                p,
                normal: Vec3::Z,
                albedo: Vec3::ONE,
                uv: p.truncate(),
                object: Some(0),
                material: None,
            };
            Sample { first: Some(first), ..sample }
        };
        frame(&scene(camera(Some(focus))), &settings(64), hit)
    };
    let (lens, post) = (with(FocusMethod::Lens), with(FocusMethod::Post));
    for x in 4..WIDTH - 4 {
        let difference = value(&lens, "R", x, 16) - value(&post, "R", x, 16);
        assert!(difference.abs() < 0.06, "column {x}: {difference}");
    }
}
