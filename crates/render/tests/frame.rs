//! What a frame holds: channels, depth, matrices, and what becomes of samples that are no numbers.

mod formula;

use formula::{camera, frame, ground, light, pass, perspective, pose, prepare, scene, small, value};
use glam::{Mat4, Vec3, Vec4};
use heliostat_render::{CameraRay, Sample, Sampler};
use heliostat_scene::camera::Projection;
use heliostat_scene::frame::{Depth, Meta};
use heliostat_scene::settings::{Filter, Layers, PixelRect};
use heliostat_scene::{Camera, Frame, Motion, RenderSettings};

fn layered(samples: u32) -> RenderSettings {
    RenderSettings { layers: Layers::ALL, samples, ..small() }
}

/// The matrix of the header, for points as rows: `row * matrix`.
fn matrix(frame: &Frame, key: &str) -> Mat4 {
    match frame.meta.get(key) {
        // Rows of the one for rows are columns of the one for columns, which glam takes.
        Some(Meta::Matrix(rows)) => Mat4::from_cols_array(rows),
        other => panic!("{key}: {other:?}"),
    }
}

fn point(frame: &Frame, x: u32, y: u32) -> Vec3 {
    Vec3::from_array(["P.X", "P.Y", "P.Z"].map(|name| value(frame, name, x, y)))
}

fn text<'a>(frame: &'a Frame, key: &str) -> Option<&'a str> {
    match frame.meta.get(key)? {
        Meta::Text(text) => Some(text),
        other => panic!("{key}: {other:?}"),
    }
}

fn pixels(frame: &Frame) -> impl Iterator<Item = (u32, u32)> + use<> {
    let w = frame.window;
    (w.y0..w.y1).flat_map(move |y| (w.x0..w.x1).map(move |x| (x, y)))
}

#[test]
fn channels_have_the_promised_names_and_depths() {
    let scene = scene(perspective());
    let names = |layers| {
        let frame = frame(&scene, &RenderSettings { layers, samples: 1, ..small() }, ground);
        assert!(frame.channels.iter().all(|c| c.values.len() == frame.pixel_count()));
        frame.channels.into_iter().map(|c| (c.name, c.depth)).collect::<Vec<_>>()
    };
    let named = |list: &[(&str, Depth)]| list.iter().map(|&(n, d)| (n.to_owned(), d)).collect::<Vec<_>>();
    let (half, float) = (Depth::Half, Depth::Float);
    let beauty = [("R", half), ("G", half), ("B", half), ("A", half)];
    assert_eq!(names(Layers::default()), named(&beauty));
    let depth = Layers { depth: true, ..Layers::default() };
    assert_eq!(names(depth), named(&[&beauty[..], &[("Z", float)]].concat()));
    let rest = [
        ("albedo.R", half),
        ("albedo.G", half),
        ("albedo.B", half),
        ("sample_count.Y", float),
        ("variance.R", float),
        ("variance.G", float),
        ("variance.B", float),
        ("Z", float),
        ("N.X", float),
        ("N.Y", float),
        ("N.Z", float),
        ("P.X", float),
        ("P.Y", float),
        ("P.Z", float),
        ("UV.U", float),
        ("UV.V", float),
        ("object_id.Y", float),
        ("material_id.Y", float),
    ];
    assert_eq!(names(Layers::ALL), named(&[&beauty[..], &rest[..]].concat()));
}

#[test]
fn positions_go_through_the_matrices_to_depth_and_pixel() {
    for projection in [Projection::Perspective { fov_y: 1.2 }, Projection::Orthographic { height: 5.0 }] {
        let frame = frame(&scene(camera(projection)), &layered(1), ground);
        let (to_camera, to_ndc) = (matrix(&frame, "worldToCamera"), matrix(&frame, "worldToNDC"));
        assert_eq!(text(&frame, "heliostat/depthType"), Some("perpendicular"));
        let (mut hits, mut misses) = (0, 0);
        for (x, y) in pixels(&frame) {
            let z = value(&frame, "Z", x, y);
            if value(&frame, "object_id.Y", x, y) == 0.0 {
                assert_eq!((z, point(&frame, x, y)), (1e10, Vec3::ZERO));
                misses += 1;
                continue;
            }
            hits += 1;
            let p = point(&frame, x, y);
            let seen = to_camera.transform_point3(p);
            // Positions are f32 of some 50 metres, so is the depth.
            assert!((seen.z - z).abs() < 2e-5 * (50.0 + z), "{projection:?} {x},{y}: {} for {z}", seen.z);
            let ndc: Vec4 = to_ndc * p.extend(1.0);
            let place = ndc.truncate() / ndc.w;
            let want = ((x as f32 + 0.5) / 53.0, (y as f32 + 0.5) / 37.0);
            // Far points lie many metres per pixel away; near ones show the error of the matrix.
            let allowed = 2e-4;
            assert!((place.x - want.0).abs() < allowed, "{projection:?} {x},{y}: {place}");
            assert!((place.y - want.1).abs() < allowed, "{projection:?} {x},{y}: {place}");
        }
        assert!(hits > 500 && (misses > 100 || projection == Projection::Orthographic { height: 5.0 }));
    }
}

#[test]
fn the_camera_matrix_follows_the_exr_convention() {
    let frame = frame(&scene(perspective()), &layered(1), ground);
    let to_camera = matrix(&frame, "worldToCamera");
    let pose = pose();
    let world = |v: glam::DVec3| pose.transform_point3(v).as_vec3();
    for (local, want) in [
        (glam::DVec3::new(0.0, 0.0, -5.0), Vec3::new(0.0, 0.0, 5.0)),
        (glam::DVec3::new(2.0, 0.0, -5.0), Vec3::new(2.0, 0.0, 5.0)),
        (glam::DVec3::new(0.0, 3.0, -1.0), Vec3::new(0.0, 3.0, 1.0)),
    ] {
        assert!(to_camera.transform_point3(world(local)).distance(want) < 1e-4);
    }
    // As rows from the left: the translation stands in the last row.
    let Some(Meta::Matrix(rows)) = frame.meta.get("worldToCamera") else { panic!("no matrix") };
    assert_eq!((rows[3], rows[7], rows[11], rows[15]), (0.0, 0.0, 0.0, 1.0));
    let to_ndc = matrix(&frame, "worldToNDC");
    let ndc = |p: Vec3| {
        let q = to_ndc * p.extend(1.0);
        (q / q.w).truncate()
    };
    let (half_x, half_y) = (0.6_f32.tan() * 53.0 / 37.0, 0.6_f32.tan());
    let corner = |x: f32, y: f32| ndc(world(Vec3::new(x * half_x, y * half_y, -1.0).as_dvec3()));
    assert!(corner(-1.0, 1.0).truncate().length() < 1e-4, "the upper left corner is the origin");
    assert!(corner(1.0, -1.0).truncate().distance(glam::Vec2::ONE) < 1e-4);
}

#[test]
fn pictures_that_look_around_have_distances_and_no_ndc() {
    for projection in [
        Projection::Panorama,
        Projection::Fisheye { fov: 3.0 },
        Projection::Cylindrical { fov_x: 3.0, fov_y: 1.0 },
    ] {
        let frame = frame(&scene(camera(projection)), &layered(1), ground);
        assert_eq!(text(&frame, "heliostat/depthType"), Some("distance"));
        assert!(!frame.meta.contains_key("worldToNDC"));
        let eye = pose().translation.as_vec3();
        for (x, y) in pixels(&frame).filter(|&(x, y)| value(&frame, "object_id.Y", x, y) > 0.0) {
            let distance = point(&frame, x, y).distance(eye);
            assert!((value(&frame, "Z", x, y) / distance - 1.0).abs() < 1e-5);
        }
    }
}

#[test]
fn a_fisheye_is_transparent_outside_its_circle() {
    let white = |_: &CameraRay, _: &mut Sampler| light(Vec3::ONE);
    let scene = scene(camera(Projection::Fisheye { fov: 3.0 }));
    let frame = frame(&scene, &layered(16), white);
    for (x, y, alpha) in [(26, 18, 1.0), (0, 0, 0.0), (52, 36, 0.0), (2, 18, 0.0), (26, 3, 1.0)] {
        for name in ["R", "G", "B", "A"] {
            assert_eq!(value(&frame, name, x, y), alpha, "{name} at {x}, {y}");
        }
        assert_eq!(value(&frame, "Z", x, y), 1e10);
    }
    // Rays that are not there are not counted.
    let prepared = prepare(&scene, &layered(4), white);
    pass(&prepared, &mut prepared.film(), 0..4);
    let stats = prepared.stats();
    assert_eq!(stats.samples, 4 * 53 * 37);
    let circle = std::f64::consts::PI * 18.5 * 18.5 * 4.0;
    assert!((stats.rays.camera as f64 / circle - 1.0).abs() < 0.02);
}

#[test]
fn data_is_one_sample_near_the_centre_and_never_mixed() {
    for (filter, filter_radius) in [(Filter::Box, 0.5), (Filter::BlackmanHarris, 1.5), (Filter::Lanczos, 3.0)]
    {
        let settings = RenderSettings { filter, filter_radius, ..layered(64) };
        let frame = frame(&scene(perspective()), &settings, ground);
        let to_ndc = matrix(&frame, "worldToNDC");
        for (x, y) in pixels(&frame) {
            let (object, material) =
                (value(&frame, "object_id.Y", x, y), value(&frame, "material_id.Y", x, y));
            assert!(
                [(0.0, 0.0), (1.0, 4.0), (2.0, 5.0)].contains(&(object, material)),
                "{object} {material}"
            );
            if object == 0.0 {
                assert_eq!(value(&frame, "Z", x, y), 1e10);
                continue;
            }
            assert_eq!(value(&frame, "N.Y", x, y), 1.0);
            let ndc = to_ndc * point(&frame, x, y).extend(1.0);
            let (px, py) = (ndc.x / ndc.w * 53.0 - 0.5 - x as f32, ndc.y / ndc.w * 37.0 - 0.5 - y as f32);
            // 64 samples over some square pixels: the nearest is a fraction of a pixel off.
            assert!(px.hypot(py) < 0.6, "{filter:?} {x},{y}: {px} {py}");
        }
    }
}

#[test]
fn albedo_is_filtered_like_the_beauty() {
    // An integrator whose beauty is its albedo: both layers must be the same picture.
    let same = |ray: &CameraRay, sampler: &mut Sampler| {
        let sample = ground(ray, sampler);
        Sample { radiance: sample.first.map_or(Vec3::ZERO, |hit| hit.albedo), ..sample }
    };
    for (filter, filter_radius) in [(Filter::Tent, 1.0), (Filter::Mitchell, 2.0)] {
        let settings = RenderSettings { filter, filter_radius, ..layered(16) };
        let frame = frame(&scene(perspective()), &settings, same);
        for c in ["R", "G", "B"] {
            let layer = format!("albedo.{c}");
            assert_eq!(frame.channel(c).unwrap().values, frame.channel(&layer).unwrap().values);
        }
    }
}

#[test]
fn samples_that_are_no_numbers_are_left_out_and_counted() {
    let broken = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let formula = move |ray: &CameraRay, sampler: &mut Sampler| {
        let mut sample = ground(ray, sampler);
        sample.radiance = Vec3::splat(0.5);
        sample.alpha = 1.0;
        match sampler.sample() {
            1 => sample.radiance.y = broken[0],
            3 => sample.radiance.z = broken[1],
            4 => sample.alpha = broken[2],
            6 => {
                if let Some(hit) = &mut sample.first {
                    hit.normal.x = broken[0];
                } else {
                    sample.radiance.x = broken[0];
                }
            }
            _ => (),
        }
        sample
    };
    for (filter, filter_radius) in [(Filter::Box, 0.5), (Filter::Lanczos, 3.0)] {
        let settings = RenderSettings { filter, filter_radius, ..layered(8) };
        let scene = scene(perspective());
        let prepared = prepare(&scene, &settings, formula);
        let mut film = prepared.film();
        pass(&prepared, &mut film, 0..8);
        assert_eq!(prepared.stats().non_finite_samples, 4 * 53 * 37);
        let frame = prepared.frame(&film);
        for channel in &frame.channels {
            assert!(channel.values.iter().all(|v| v.is_finite()), "{}", channel.name);
        }
        for name in ["R", "G", "B"] {
            assert!(frame.channel(name).unwrap().values.iter().all(|&v| v == 0.5), "{filter:?} {name}");
        }
    }
}

#[test]
fn the_header_says_how_it_was_made_and_not_when_or_where() {
    let region = Some(PixelRect { x0: 3, y0: 4, x1: 20, y1: 21 });
    let settings = RenderSettings { region, seed: u64::MAX, threads: 1, ..layered(4) };
    let moving =
        Camera { motion: Motion::through(vec![pose(), glam::DAffine3::IDENTITY]).unwrap(), ..perspective() };
    let frame = frame(&scene(moving), &settings, ground);
    assert_eq!(text(&frame, "heliostat/seed"), Some("18446744073709551615"));
    assert_eq!(text(&frame, "heliostat/integrator"), Some("whitted"));
    assert_eq!(text(&frame, "heliostat/filter"), Some("blackman_harris"));
    assert_eq!(text(&frame, "heliostat/camera"), Some("main"));
    assert_eq!(text(&frame, "heliostat/region"), Some("3,4,20,21"));
    assert_eq!(frame.meta.get("heliostat/samples"), Some(&Meta::Int(4)));
    assert_eq!(frame.meta.get("heliostat/filterRadius"), Some(&Meta::Float(1.5)));
    // A camera that moves stands where it was when the shutter opened.
    let at_opening = matrix(&frame, "worldToCamera").transform_point3(pose().translation.as_vec3());
    assert!(at_opening.length() < 1e-4);
    let keys: Vec<&str> = frame.meta.keys().map(String::as_str).collect();
    let want = [
        "heliostat/camera",
        "heliostat/depthType",
        "heliostat/filter",
        "heliostat/filterRadius",
        "heliostat/integrator",
        "heliostat/mipMaps",
        "heliostat/region",
        "heliostat/sampler",
        "heliostat/samples",
        "heliostat/seed",
        "heliostat/version",
        "worldToCamera",
        "worldToNDC",
    ];
    assert_eq!(keys, want);
}
