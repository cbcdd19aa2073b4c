//! Pixels that end at a given noise: without a bias, at the error that was asked for, the same bits for everyone.

mod formula;

use formula::{assert_same_channels, crop, ground, light, pass, perspective, prepare, scene, value};
use heliostat_render::{RenderError, Sampler};
use heliostat_scene::settings::{Filter, IntegratorKind, Layers, PixelRect, SamplerKind};
use heliostat_scene::{Frame, RenderSettings, Rgb, Scene};

/// A path of this share of all samples is as bright as this, on a dim ground.
const RARE: f32 = 1.0 / 128.0;
const BRIGHT: f32 = 64.0;
const DIM: f32 = 0.5;
const MEAN: f64 = (DIM + RARE * BRIGHT) as f64;

fn settings() -> RenderSettings {
    RenderSettings {
        width: 16,
        height: 8,
        samples: 4,
        noise: Some(0.25),
        max_samples: Some(64),
        threads: 1,
        ..RenderSettings::default()
    }
}

fn rare(sampler: &mut Sampler) -> f32 {
    // By two draws, which are not stratified together.
    if sampler.next_1d() < 0.125 && sampler.next_1d() < 8.0 * RARE {
        BRIGHT
    } else {
        DIM + RARE * DIM / (1.0 - RARE)
    }
}

fn whole(
    scene: &Scene,
    settings: &RenderSettings,
    formula: impl Fn(&heliostat_render::CameraRay, &mut Sampler) -> heliostat_render::Sample + Sync + Send,
) -> Frame {
    let prepared = prepare(scene, settings, formula);
    let mut film = prepared.film();
    assert!(pass(&prepared, &mut film, 0..settings.most_samples()).finished);
    prepared.frame(&film)
}

fn values<'f>(frame: &'f Frame, channel: &str) -> &'f [f32] {
    &frame.channel(channel).expect("a layer that was asked for").values
}

fn mean(frame: &Frame, channel: &str) -> f64 {
    let values = values(frame, channel);
    values.iter().map(|v| f64::from(*v)).sum::<f64>() / values.len() as f64
}

/// How many deviations the mean of independent values is off.
fn deviations(values: &[f64], truth: f64) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean - truth) / (variance / n).sqrt()
}

#[test]
fn rare_bright_paths_keep_their_mean() {
    let scene = scene(perspective());
    for sampler in [SamplerKind::White, SamplerKind::Blue] {
        let mut counts = Vec::new();
        let means: Vec<f64> = (0..400)
            .map(|seed| {
                let layers = Layers { sample_count: true, ..Layers::default() };
                let settings = RenderSettings { seed, sampler, layers, ..settings() };
                let frame = whole(&scene, &settings, |_, draws| light(Rgb::splat(rare(draws))));
                counts.push(mean(&frame, "sample_count.Y"));
                mean(&frame, "G")
            })
            .collect();
        let z = deviations(&means, MEAN);
        assert!(z.abs() < 4.0, "{sampler:?}: {z} deviations");
        // The counts do depend on what was met: else there would be nothing to prove.
        let count = counts.iter().sum::<f64>() / 400.0;
        assert!((6.0..60.0).contains(&count), "{sampler:?}: {count} samples");
    }
}

#[test]
fn the_test_above_sees_the_bias_of_pixels_that_ask_themselves() {
    let pixel = |x: u32| {
        let (mut sum, mut squares, mut n) = (0.0, 0.0, 0_u32);
        loop {
            let value = f64::from(rare(&mut Sampler::new(0, [x, 0], n)));
            (sum, squares, n) = (sum + value, squares + value * value, n + 1);
            let mean = sum / f64::from(n);
            let error = ((squares / f64::from(n) - mean * mean) / f64::from(n)).sqrt();
            if n == 64 || n.is_power_of_two() && n >= 4 && error <= 0.25 * mean {
                return mean;
            }
        }
    };
    let rows: Vec<f64> =
        (0..400).map(|row| (0..128).map(|x| pixel(128 * row + x)).sum::<f64>() / 128.0).collect();
    let z = deviations(&rows, MEAN);
    assert!(z < -8.0, "{z} deviations");
}

#[test]
fn pixels_end_at_the_error_that_was_asked_for() {
    let scene = scene(perspective());
    for (target, filter, filter_radius) in [
        (0.05, Filter::BlackmanHarris, 1.5),
        (0.02, Filter::BlackmanHarris, 1.5),
        (0.05, Filter::Mitchell, 2.0),
    ] {
        let settings = RenderSettings {
            width: 48,
            height: 48,
            noise: Some(target),
            max_samples: None,
            filter,
            filter_radius,
            ..settings()
        };
        // Products of several draws are stratified in none of them: a deviation of about 0.6 from the mean 1.
        let noisy =
            |s: &mut Sampler| (0..4).map(|_| 2.0 * f32::from(u8::from(s.next_1d() < 0.5))).sum::<f32>() / 4.0;
        let frame = whole(&scene, &settings, |_, s| light(Rgb::splat(noisy(s) * 2.0 * s.next_1d())));
        let values = values(&frame, "G");
        let error = values.iter().map(|v| (f64::from(*v) - 1.0).powi(2)).sum::<f64>() / values.len() as f64;
        let share = error.sqrt() / f64::from(target);
        assert!((0.3..1.15).contains(&share), "{filter:?} at {target}: {share} of the error");
    }
}

#[test]
fn calm_and_black_pixels_take_the_least_number() {
    let scene = scene(perspective());
    let layers = Layers { sample_count: true, variance: true, ..Layers::default() };
    for (radiance, wobble) in [(1.0, 0.0), (0.0, 0.001)] {
        let settings = RenderSettings { samples: 8, noise: Some(0.05), layers, ..settings() };
        let shade = |s: &mut Sampler| Rgb::splat(radiance + wobble * s.next_1d());
        let frame = whole(&scene, &settings, |_, s| light(shade(s)));
        assert!(values(&frame, "sample_count.Y").iter().all(|n| *n == 8.0));
        let variance = values(&frame, "variance.R");
        assert!(variance.iter().all(|v| (*v > 0.0) == (wobble > 0.0) && *v < 1e-6));
    }
}

#[test]
fn noisy_places_take_more_samples() {
    let scene = scene(perspective());
    let layers = Layers { sample_count: true, ..Layers::default() };
    let settings = RenderSettings {
        width: 64,
        height: 16,
        samples: 32,
        noise: Some(0.1),
        max_samples: Some(256),
        layers,
        ..settings()
    };
    let frame = whole(&scene, &settings, |ray, s| {
        let local = formula::pose().inverse().transform_vector3(ray.ray.dir.as_dvec3());
        light(Rgb::splat(if local.x < 0.0 { 1.0 } else { rare(s) }))
    });
    assert_eq!(value(&frame, "sample_count.Y", 4, 4), 32.0);
    assert_eq!(value(&frame, "sample_count.Y", 60, 4), 256.0);
}

#[test]
fn threads_passes_and_regions_leave_no_trace() {
    let scene = scene(perspective());
    let settings =
        RenderSettings { width: 53, height: 37, noise: Some(0.12), layers: Layers::ALL, ..settings() };
    let one = whole(&scene, &settings, ground);
    let counts = values(&one, "sample_count.Y");
    assert!(counts.iter().any(|n| *n != counts[0]), "all pixels take {}", counts[0]);
    for threads in [2, 8] {
        let other = whole(&scene, &RenderSettings { threads, ..settings.clone() }, ground);
        assert_same_channels(&other, &one, &format!("{threads} threads"));
    }
    for cuts in [&[1, 2, 4, 8, 16, 32, 64][..], &[5, 64], &[3, 17, 40, 64]] {
        let prepared = prepare(&scene, &settings, ground);
        let mut film = prepared.film();
        let mut start = 0;
        for &end in cuts {
            pass(&prepared, &mut film, start..end);
            start = end;
        }
        assert_same_channels(&prepared.frame(&film), &one, &format!("{cuts:?}"));
    }
    for (x0, y0, x1, y1) in [(0, 0, 1, 1), (52, 36, 53, 37), (15, 3, 33, 18)] {
        let window = PixelRect { x0, y0, x1, y1 };
        let part = whole(&scene, &RenderSettings { region: Some(window), ..settings.clone() }, ground);
        assert_same_channels(&part, &crop(&one, window), &format!("{window:?}"));
    }
}

#[test]
fn settings_that_mean_nothing_are_refused() {
    let scene = scene(perspective());
    let error = |settings: RenderSettings| match heliostat_render::Prepared::new(&scene, &settings) {
        Err(error) => error,
        Ok(_) => panic!("{settings:?}"),
    };
    for noise in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let found = error(RenderSettings { noise: Some(noise), ..settings() });
        assert!(matches!(found, RenderError::Setting { name: "noise", .. }), "{found}");
    }
    let found = error(RenderSettings { time: Some(0.0), ..settings() });
    assert!(matches!(found, RenderError::Setting { name: "time", .. }), "{found}");
    let found = error(RenderSettings { integrator: IntegratorKind::Depth, ..settings() });
    assert!(matches!(found, RenderError::NoNoise), "{found}");
    let found = error(RenderSettings { samples: 65, ..settings() });
    assert!(matches!(found, RenderError::MaxSamples { samples: 65, most: 64 }), "{found}");
    let found = error(RenderSettings { noise: None, ..settings() });
    assert!(matches!(found, RenderError::UselessMaxSamples), "{found}");
}
