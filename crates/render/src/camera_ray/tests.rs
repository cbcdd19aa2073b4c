//! Rays against closed-form projections, lenses against similar triangles.

use super::*;
use heliostat_scene::camera::Projection;
use std::f32::consts::{FRAC_PI_2, PI, TAU};

const WIDTH: u32 = 640;
const HEIGHT: u32 = 360;

fn camera(projection: Projection) -> Camera {
    Camera { name: "test".into(), motion: Motion::still(DAffine3::IDENTITY), projection, focus: None }
}

fn rays(projection: Projection) -> CameraRays {
    CameraRays::new(&camera(projection), WIDTH, HEIGHT)
}

fn all() -> [Projection; 5] {
    [
        Projection::Perspective { fov_y: 0.7 },
        Projection::Orthographic { height: 3.0 },
        Projection::Fisheye { fov: 3.5 },
        Projection::Panorama,
        Projection::Cylindrical { fov_x: 4.0, fov_y: 1.0 },
    ]
}

/// Places all over the picture, off the pixel centres.
fn places() -> impl Iterator<Item = DVec2> {
    (0..400).map(|i| {
        let turn = f64::from(i) * 0.618_033_988_75 + 0.01;
        DVec2::new(turn.fract() * f64::from(WIDTH), (f64::from(i) + 0.3) / 400.0 * f64::from(HEIGHT))
    })
}

/// Where a point of camera space is seen: the textbook formulas, by inverse functions that the rays never use.
fn project(projection: Projection, p: DVec3) -> DVec2 {
    let (w, h) = (f64::from(WIDTH), f64::from(HEIGHT));
    let flat = |x: f64, y: f64| DVec2::new(0.5 * w + 0.5 * h * x, 0.5 * h - 0.5 * h * y);
    let column = |fov: f64| w * (0.5 + p.x.atan2(-p.z) / fov);
    match projection {
        Projection::Perspective { fov_y } => {
            let scale = -p.z * f64::from(fov_y / 2.0).tan();
            flat(p.x / scale, p.y / scale)
        }
        Projection::Orthographic { height } => {
            let scale = 0.5 * f64::from(height);
            flat(p.x / scale, p.y / scale)
        }
        Projection::Fisheye { fov } => {
            let angle = p.x.hypot(p.y).atan2(-p.z);
            let radius = 0.5 * h.min(w) * angle / (0.5 * f64::from(fov));
            let across = DVec2::new(p.x, -p.y).normalize_or_zero();
            DVec2::new(0.5 * w, 0.5 * h) + radius * across
        }
        Projection::Panorama => {
            let height = p.y.atan2(p.x.hypot(p.z));
            DVec2::new(column(std::f64::consts::TAU), h * (0.5 - height / std::f64::consts::PI))
        }
        Projection::Cylindrical { fov_x, fov_y } => {
            let slope = p.y / p.x.hypot(p.z) / f64::from(fov_y / 2.0).tan();
            DVec2::new(column(f64::from(fov_x)), 0.5 * h * (1.0 - slope))
        }
    }
}

#[test]
fn every_projection_is_undone_by_its_formula() {
    for projection in all() {
        let rays = rays(projection);
        let mut seen = 0;
        for place in places() {
            let Some(found) = rays.ray(place, Vec2::ZERO, 0.0) else { continue };
            seen += 1;
            let p = found.ray.origin.as_dvec3() + 7.3 * found.ray.dir.as_dvec3();
            let back = project(projection, p);
            // Directions are f32: 2^-24 of up to 500 pixels per radian.
            assert!(back.distance(place) < 2e-4, "{projection:?}: {place} became {back}");
            assert!((found.ray.dir.length() - 1.0).abs() < 1e-6);
        }
        let empty = matches!(projection, Projection::Fisheye { .. });
        assert!(if empty { seen > 100 && seen < 300 } else { seen == 400 }, "{projection:?}: {seen}");
    }
}

#[test]
fn up_is_up_and_right_is_right() {
    for projection in all() {
        let rays = rays(projection);
        let at = |x: f64, y: f64| rays.ray(DVec2::new(x, y), Vec2::ZERO, 0.0).unwrap();
        let centre = at(320.0, 180.0);
        assert_eq!(centre.ray.dir, Vec3::NEG_Z, "{projection:?}");
        assert_eq!(centre.forward, Vec3::NEG_Z);
        let points = [at(330.0, 180.0), at(320.0, 170.0)].map(|r| r.ray.at(10.0));
        assert!(points[0].x > 0.0 && points[0].y.abs() < 1e-6, "{projection:?}");
        assert!(points[1].y > 0.0 && points[1].x.abs() < 1e-6, "{projection:?}");
    }
}

#[test]
fn a_panorama_has_no_seam() {
    let rays = rays(Projection::Panorama);
    let dir = |x: f64, y: f64| rays.ray(DVec2::new(x, y), Vec2::ZERO, 0.0).unwrap().ray.dir;
    for y in [0.5, 90.25, 200.0, 359.5] {
        for x in [0.0, 0.25, -0.75, 3.5] {
            assert_eq!(dir(x, y), dir(x + f64::from(WIDTH), y), "{x}, {y}");
        }
    }
    assert_eq!(dir(0.0, 180.0), Vec3::Z);
    assert_eq!(dir(480.0, 180.0), Vec3::X);
    assert_eq!(dir(160.0, 180.0), Vec3::NEG_X);
    assert!(dir(77.0, 0.0).distance(Vec3::Y) < 1e-7);
    // Over the pole the picture goes on at the other side.
    assert!(dir(100.0, -2.0).distance(dir(420.0, 2.0)) < 1e-6);
}

#[test]
fn a_fisheye_is_empty_outside_its_circle_and_touches_the_shorter_borders() {
    let rays = rays(Projection::Fisheye { fov: PI });
    let dir = |x: f64, y: f64| rays.ray(DVec2::new(x, y), Vec2::ZERO, 0.0).map(|r| r.ray.dir);
    assert!(dir(320.0, 0.0).unwrap().distance(Vec3::Y) < 1e-6);
    assert!(dir(500.0, 180.0).unwrap().distance(Vec3::X) < 1e-6);
    assert_eq!(dir(500.1, 180.0), None);
    assert_eq!(dir(10.0, 10.0), None);
    // A whole turn: the border of the circle is straight behind.
    let whole = CameraRays::new(&camera(Projection::Fisheye { fov: TAU }), WIDTH, HEIGHT);
    let behind = whole.ray(DVec2::new(320.0, 360.0), Vec2::ZERO, 0.0).unwrap();
    assert!(behind.ray.dir.distance(Vec3::Z) < 1e-6);
}

#[test]
fn neighbouring_samples_of_a_wide_picture_differ_by_even_steps() {
    // At 16384 columns a quarter of a pixel is 1e-4 radian: steps must not be lost or doubled.
    let camera = camera(Projection::Panorama);
    let rays = CameraRays::new(&camera, 16384, 8192);
    let step = f64::from(TAU) / 16384.0 / 4.0;
    for i in 0..64 {
        let dir = |k: i32| {
            let place = DVec2::new(5000.0 + f64::from(k) / 4.0, 4096.0);
            rays.ray(place, Vec2::ZERO, 0.0).unwrap().ray.dir.as_dvec3()
        };
        let found = dir(i).distance(dir(i + 1));
        assert!((found / step - 1.0).abs() < 2e-3, "{i}: {found} for {step}");
    }
}

fn focused(projection: Projection, focus: Focus) -> CameraRays {
    CameraRays::new(&Camera { focus: Some(focus), ..camera(projection) }, WIDTH, HEIGHT)
}

const FOCUS: Focus =
    Focus { distance: 4.0, lens_radius: 0.1, blades: 0, blade_rotation: 0.0, method: FocusMethod::Lens };

/// Points of the unit square on a grid.
fn grid(n: u32) -> impl Iterator<Item = Vec2> {
    let at = move |i: u32| (i as f32 + 0.5) / n as f32;
    (0..n * n).map(move |i| Vec2::new(at(i % n), at(i / n)))
}

#[test]
fn all_rays_of_a_place_meet_in_focus() {
    for projection in all() {
        let sharp = rays(projection);
        let lens = focused(projection, FOCUS);
        for place in places().step_by(7) {
            let Some(pinhole) = sharp.ray(place, Vec2::ZERO, 0.0) else { continue };
            let pinhole = pinhole.ray;
            // Flat pictures are sharp on the plane z = -4, into the corners; the others on a sphere.
            let t = if sharp.has_perpendicular_depth() { 4.0 / -pinhole.dir.z } else { 4.0 };
            let in_focus = pinhole.at(t);
            for u in grid(5) {
                let ray = lens.ray(place, u, 0.0).unwrap().ray;
                let nearest = (in_focus - ray.origin).dot(ray.dir);
                assert!(ray.at(nearest).distance(in_focus) < 3e-6, "{projection:?} at {place}");
                assert!(ray.origin.distance(pinhole.origin) <= 0.1 + 1e-6);
            }
        }
    }
}

#[test]
fn a_point_out_of_focus_spreads_to_the_disk_of_the_formula() {
    for projection in [Projection::Perspective { fov_y: 0.7 }, Projection::Orthographic { height: 3.0 }] {
        let lens = focused(projection, FOCUS);
        for depth in [1.0, 2.5, 4.0, 8.0, 100.0] {
            // A point is seen in the places whose rays meet it: project it through each point of the lens onto the
            // plane in focus, and that into the picture. With parallel rays every place has its own lens, and
            // place + lens (1 - depth / distance) is the point.
            let point = DVec3::new(0.0, 0.0, -depth);
            let mut widest = 0.0_f64;
            for u in grid(64) {
                let on_lens = square_to_polygon(u, 0).as_dvec2() * 0.1;
                let place = if lens.is_parallel() { on_lens * (depth / 4.0 - 1.0) } else { DVec2::ZERO };
                let through = (place + on_lens).extend(0.0);
                let in_focus = through + (point - through) * (4.0 / depth);
                let seen = project(projection, in_focus);
                widest = widest.max(seen.distance(DVec2::new(320.0, 180.0)));
                let ray = lens.ray(seen, u, 0.0).unwrap().ray;
                let origin =
                    if lens.is_parallel() { (in_focus.truncate() + on_lens).extend(0.0) } else { through };
                assert!(ray.origin.as_dvec3().distance(origin) < 1e-6);
            }
            let want = lens.blur_radius(&FOCUS, depth);
            assert!((widest - want).abs() <= 0.02 * want + 1e-9, "{projection:?} {depth}: {widest}, {want}");
        }
    }
}

#[test]
fn an_iris_of_blades_is_a_polygon_that_turns() {
    let iris = |blades, blade_rotation| {
        let lens =
            focused(Projection::Orthographic { height: 3.0 }, Focus { blades, blade_rotation, ..FOCUS });
        let centre = DVec2::new(320.0, 180.0);
        grid(100).map(move |u| lens.ray(centre, u, 0.0).unwrap().ray.origin.truncate()).collect::<Vec<_>>()
    };
    for (blades, turn) in [(3, 0.0), (5, 0.4), (6, FRAC_PI_2), (8, 1.0)] {
        let half = PI / blades as f32;
        for p in iris(blades, turn) {
            // Within each side: distance along the side's normal at most the inner radius.
            let angle = (p.y.atan2(p.x) - turn).rem_euclid(2.0 * half) - half;
            assert!(p.length() * angle.cos() <= 0.1 * half.cos() + 1e-6, "{blades} blades: {p}");
        }
    }
    // The disk is filled to its rim and no further, with its centre of mass in the middle.
    let disk = iris(0, 0.0);
    assert!(disk.iter().all(|p| p.length() <= 0.1 + 1e-6));
    let mean = disk.iter().sum::<Vec2>() / disk.len() as f32;
    let inertia = disk.iter().map(|p| p.length_squared()).sum::<f32>() / disk.len() as f32;
    assert!(mean.length() < 1e-5);
    assert!((inertia - 0.005).abs() < 1e-5, "a uniform disk has the mean square radius r^2 / 2: {inertia}");
}

#[test]
fn without_an_opening_or_with_post_blur_rays_are_those_of_a_pinhole() {
    let sharp = rays(Projection::Perspective { fov_y: 0.7 });
    let closed = Focus { lens_radius: 0.0, ..FOCUS };
    let post = Focus { method: FocusMethod::Post, ..FOCUS };
    for focus in [closed, post] {
        let other = focused(Projection::Perspective { fov_y: 0.7 }, focus);
        for place in places() {
            assert_eq!(other.ray(place, Vec2::splat(0.2), 0.0), sharp.ray(place, Vec2::ZERO, 0.0));
        }
    }
}

#[test]
fn a_moving_camera_stays_rigid_and_moves_straight() {
    let poses = [0.0, 0.6, 1.4].map(|angle| {
        DAffine3::from_rotation_translation(
            glam::DQuat::from_euler(glam::EulerRot::YXZ, angle, 0.3 * angle, 0.2),
            DVec3::new(10.0 * angle, 1.0, -3.0),
        )
    });
    let moving = Camera {
        motion: Motion::through(poses.to_vec()).unwrap(),
        ..camera(Projection::Perspective { fov_y: 0.7 })
    };
    let rays = CameraRays::new(&moving, WIDTH, HEIGHT);
    for i in 0..=20 {
        let time = i as f32 / 20.0;
        let axes = rays.pose(time).matrix3;
        let unit = axes.transpose() * axes;
        assert!(unit.abs_diff_eq(DMat3::IDENTITY, 1e-14), "{time}: {unit}");
        assert!((axes.determinant() - 1.0).abs() < 1e-14);
    }
    // At the poses the camera is where the poses are; between them on the straight line.
    for (time, pose) in [(0.0, poses[0]), (0.5, poses[1]), (1.0, poses[2])] {
        let found = rays.pose(time);
        assert!(found.abs_diff_eq(pose, 1e-14), "{time}");
        let ray = rays.ray(DVec2::new(320.0, 180.0), Vec2::ZERO, time).unwrap();
        assert!(ray.ray.dir.distance(-pose.matrix3.z_axis.as_vec3()) < 1e-6);
        assert_eq!((ray.ray.origin, ray.eye), (pose.translation.as_vec3(), pose.translation.as_vec3()));
    }
    let middle = rays.ray(DVec2::new(320.0, 180.0), Vec2::ZERO, 0.25).unwrap();
    let half_way = 0.5 * (poses[0].translation + poses[1].translation);
    assert!(middle.eye.as_dvec3().distance(half_way) < 1e-6);
}

#[test]
fn depth_is_perpendicular_in_flat_pictures_and_a_distance_in_others() {
    let turned =
        DAffine3::from_rotation_translation(glam::DQuat::from_rotation_y(2.1), DVec3::new(5.0, 6.0, 7.0));
    for projection in all() {
        let camera = Camera { motion: Motion::still(turned), ..camera(projection) };
        let rays = CameraRays::new(&camera, WIDTH, HEIGHT);
        let ray = rays.ray(DVec2::new(400.0, 100.0), Vec2::ZERO, 0.0).unwrap();
        let p = ray.ray.at(9.0);
        let local = turned.inverse().transform_point3(p.as_dvec3());
        let want = if rays.has_perpendicular_depth() { -local.z } else { local.length() };
        assert!((f64::from(rays.depth(&ray, p)) - want).abs() < 1e-5, "{projection:?}");
    }
}
