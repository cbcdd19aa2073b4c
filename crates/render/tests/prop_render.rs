//! Pictures of any size, region, filter, cutting and number of threads: always the same bits.

mod formula;

use formula::{assert_same_channels, ground, pass, perspective, prepare, scene};
use heliostat_scene::camera::{Focus, FocusMethod};
use heliostat_scene::settings::{Filter, Layers, PixelRect};
use heliostat_scene::{Camera, RenderSettings};
use proptest::prelude::*;

fn filters() -> impl Strategy<Value = (Filter, f32)> {
    let kinds = prop::sample::select(vec![
        Filter::Box,
        Filter::Tent,
        Filter::Gaussian,
        Filter::Mitchell,
        Filter::BlackmanHarris,
        Filter::Lanczos,
    ]);
    (kinds, 0.1_f32..4.0)
}

fn cameras() -> impl Strategy<Value = Camera> {
    let method = prop::sample::select(vec![FocusMethod::Lens, FocusMethod::Post]);
    let focus = (method, 0.5_f32..20.0, 0.0_f32..0.5, prop::sample::select(vec![0, 3, 6]));
    prop::option::of(focus).prop_map(|focus| Camera {
        focus: focus.map(|(method, distance, lens_radius, blades)| Focus {
            distance,
            lens_radius,
            blades,
            blade_rotation: 0.5,
            method,
        }),
        ..perspective()
    })
}

/// A picture and a rectangle of at least one pixel inside it.
fn pictures() -> impl Strategy<Value = (u32, u32, PixelRect)> {
    (1_u32..48, 1_u32..48).prop_flat_map(|(width, height)| {
        (0..width, 0..height).prop_flat_map(move |(x0, y0)| {
            (x0 + 1..=width, y0 + 1..=height)
                .prop_map(move |(x1, y1)| (width, height, PixelRect { x0, y0, x1, y1 }))
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_way_of_rendering_gives_the_same_bits(
        (width, height, region) in pictures(),
        (filter, filter_radius) in filters(),
        camera in cameras(),
        samples in 1_u32..20,
        cut in 0.0_f32..1.0,
        seed: u64,
        threads in 1_usize..5,
    ) {
        let scene = scene(camera);
        let base = RenderSettings {
            width, height, filter, filter_radius, samples, seed, threads: 1, layers: Layers::ALL,
            ..RenderSettings::default()
        };
        let whole = formula::frame(&scene, &base, ground);
        let settings = RenderSettings { threads, region: Some(region), ..base };
        let prepared = prepare(&scene, &settings, ground);
        let mut film = prepared.film();
        let middle = (cut * samples as f32) as u32;
        pass(&prepared, &mut film, 0..middle);
        pass(&prepared, &mut film, middle..samples);
        let part = prepared.frame(&film);
        assert_same_channels(&part, &formula::crop(&whole, region), "a part in two passes");
    }
}
