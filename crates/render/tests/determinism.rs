//! The promise: the same bits for any number of threads, any region, any cutting into passes, any run.

mod formula;

use formula::{
    assert_same_channels, crop, frame, ground, light, pass, perspective, prepare, scene, small, value,
};
use heliostat_render::Control;
use heliostat_scene::camera::{Focus, FocusMethod};
use heliostat_scene::settings::{Filter, Layers, PixelRect};
use heliostat_scene::{Camera, RenderSettings, Rgb};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

const FILTERS: [(Filter, f32); 6] = [
    (Filter::Box, 0.5),
    (Filter::Tent, 1.0),
    (Filter::Gaussian, 1.5),
    (Filter::Mitchell, 2.0),
    (Filter::BlackmanHarris, 1.5),
    (Filter::Lanczos, 3.0),
];

fn all_layers() -> RenderSettings {
    RenderSettings { layers: Layers::ALL, ..small() }
}

fn focused(method: FocusMethod) -> Camera {
    let focus = Focus { distance: 6.0, lens_radius: 0.3, blades: 6, blade_rotation: 0.2, method };
    Camera { focus: Some(focus), ..perspective() }
}

#[test]
fn threads_and_runs_leave_no_trace() {
    for method in [FocusMethod::Lens, FocusMethod::Post] {
        let scene = scene(focused(method));
        let with = |threads| frame(&scene, &RenderSettings { threads, ..all_layers() }, ground);
        let one = with(1);
        for channel in
            one.channels.iter().filter(|c| !["N.X", "N.Z", "sample_count.Y"].contains(&c.name.as_str()))
        {
            assert!(channel.values.iter().any(|v| *v != channel.values[0]), "{} is blank", channel.name);
        }
        for threads in [1, 2, 8] {
            let other = with(threads);
            assert_same_channels(&other, &one, &format!("{method:?}, {threads} threads"));
            assert_eq!(other.meta, one.meta);
        }
    }
}

#[test]
fn a_region_is_a_crop_of_the_whole() {
    let regions = [(0, 0, 53, 37), (0, 0, 1, 1), (52, 36, 53, 37), (15, 3, 33, 18), (7, 30, 50, 37)];
    for method in [FocusMethod::Lens, FocusMethod::Post] {
        let scene = scene(focused(method));
        for (filter, filter_radius) in FILTERS {
            let settings = RenderSettings { filter, filter_radius, samples: 4, ..all_layers() };
            let whole = frame(&scene, &settings, ground);
            for (x0, y0, x1, y1) in regions {
                let window = PixelRect { x0, y0, x1, y1 };
                let part =
                    frame(&scene, &RenderSettings { region: Some(window), ..settings.clone() }, ground);
                assert_same_channels(
                    &part,
                    &crop(&whole, window),
                    &format!("{method:?} {filter:?} {window:?}"),
                );
            }
        }
    }
}

#[test]
fn a_region_that_reaches_out_of_the_picture_is_cut_to_it() {
    let scene = scene(perspective());
    let region = Some(PixelRect { x0: 40, y0: 20, x1: 900, y1: 800 });
    let part = frame(&scene, &RenderSettings { region, ..small() }, ground);
    assert_eq!(part.window, PixelRect { x0: 40, y0: 20, x1: 53, y1: 37 });
    assert_eq!((part.width, part.height), (53, 37));
}

#[test]
fn passes_add_up_to_the_whole() {
    let scene = scene(focused(FocusMethod::Lens));
    for (filter, filter_radius) in FILTERS {
        let settings = RenderSettings { filter, filter_radius, samples: 16, ..all_layers() };
        let whole = frame(&scene, &settings, ground);
        let prepared = prepare(&scene, &settings, ground);
        // Cut anywhere, overlapping and repeated ranges included.
        let cuts: [&[std::ops::Range<u32>]; 3] =
            [&[0..4, 4..16], &[0..1, 1..2, 2..9, 9..16], &[0..5, 0..5, 3..12, 0..16, 7..8]];
        for ranges in cuts {
            let mut film = prepared.film();
            for range in ranges {
                assert!(pass(&prepared, &mut film, range.clone()).finished);
            }
            assert_eq!(film.samples(), (16, 16));
            assert_same_channels(&prepared.frame(&film), &whole, &format!("{filter:?} {ranges:?}"));
        }
    }
}

#[test]
fn a_pass_says_what_it_did() {
    let scene = scene(perspective());
    let settings = small();
    let prepared = prepare(&scene, &settings, ground);
    let mut film = prepared.film();
    let (tiles, rays) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let on_tile = |tile: heliostat_render::TileDone| {
        tiles.fetch_add(1, Ordering::Relaxed);
        rays.fetch_max(tile.rays as usize, Ordering::Relaxed);
        assert!(tile.done >= 1 && tile.done <= tile.total);
    };
    let control = Control { cancel: &AtomicBool::new(false), on_tile: &on_tile };
    let outcome = prepared.pass(&mut film, 0..4, &control);
    let pixels = 53 * 37;
    assert!(outcome.finished);
    assert_eq!(outcome.samples, 4 * pixels);
    assert_eq!(tiles.load(Ordering::Relaxed), 4 * 3);
    // One camera ray and the one that the formula counts.
    assert_eq!(rays.load(Ordering::Relaxed) as u64, 2 * 4 * pixels);
    let stats = prepared.stats();
    assert_eq!((stats.samples, stats.rays.camera, stats.rays.shadow), (4 * pixels, 4 * pixels, 4 * pixels));
    assert_eq!(stats.non_finite_samples, 0);
    assert!(stats.seconds.trace > 0.0);
    // The same again adds nothing.
    assert_eq!(prepared.pass(&mut film, 0..4, &control).samples, 0);
}

#[test]
fn a_cancelled_pass_leaves_a_good_film_and_can_be_taken_up_again() {
    let scene = scene(focused(FocusMethod::Lens));
    for threads in [1, 3] {
        let settings = RenderSettings { threads, samples: 4, ..all_layers() };
        let whole = frame(&scene, &settings, ground);
        let prepared = prepare(&scene, &settings, ground);
        let mut film = prepared.film();
        let cancel = AtomicBool::new(false);
        let on_tile = |tile: heliostat_render::TileDone| {
            if tile.done >= 5 {
                cancel.store(true, Ordering::Relaxed);
            }
        };
        let outcome = prepared.pass(&mut film, 0..4, &Control { cancel: &cancel, on_tile: &on_tile });
        assert!(!outcome.finished);
        assert_eq!(film.samples(), (0, 4));
        // What is there is right, what is not there is empty.
        let part = prepared.frame(&film);
        let (mut done, mut missing) = (0, 0);
        for y in 0..37 {
            for x in 0..53 {
                let pixel = ["R", "G", "B", "A", "Z", "object_id.Y"].map(|name| value(&part, name, x, y));
                let want = ["R", "G", "B", "A", "Z", "object_id.Y"].map(|name| value(&whole, name, x, y));
                if pixel == want {
                    done += 1;
                } else {
                    assert_eq!(pixel, [0.0, 0.0, 0.0, 0.0, 1e10, 0.0]);
                    missing += 1;
                }
            }
        }
        assert!(done >= 5 * 16 * 5 && missing > 0, "{done} done, {missing} missing");
        assert_eq!(outcome.samples, 4 * done);
        assert!(pass(&prepared, &mut film, 0..4).finished);
        assert_same_channels(&prepared.frame(&film), &whole, "taken up again");
    }
}

#[test]
fn an_unfinished_film_of_an_even_picture_is_even() {
    let scene = scene(perspective());
    for (filter, filter_radius) in FILTERS {
        let settings = RenderSettings { filter, filter_radius, samples: 16, ..small() };
        let prepared = prepare(&scene, &settings, |_, _| light(Rgb::new(0.25, 1.0, 8.0)));
        let mut film = prepared.film();
        for sample in 0..16 {
            pass(&prepared, &mut film, sample..sample + 1);
            let frame = prepared.frame(&film);
            for (name, want) in [("R", 0.25), ("G", 1.0), ("B", 8.0), ("A", 1.0)] {
                let values = &frame.channel(name).unwrap().values;
                assert!(values.iter().all(|&v| v == want), "{filter:?} after {sample}: {name}");
            }
        }
    }
}

#[test]
fn seeds_differ() {
    let scene = scene(perspective());
    let with = |seed| frame(&scene, &RenderSettings { seed, ..small() }, ground);
    let (a, b) = (with(0), with(1));
    let differing = a.channels[0].values.iter().zip(&b.channels[0].values).filter(|(a, b)| a != b).count();
    assert!(differing > 53 * 37 * 9 / 10);
}
