//! Errors of pictures: numbers by hand, FLIP against NVIDIA's own evaluator, laws.

use glam::{Vec3, Vec4};
use heliostat_io::compare::{Range, compare, compare_channels, difference_frame, flip};
use heliostat_io::picture::Picture;
use heliostat_scene::frame::{Channel, Depth, Frame};
use heliostat_scene::settings::PixelRect;
use std::collections::BTreeMap;

fn picture(width: u32, pixels: &[Vec3]) -> Picture {
    let pixels: Vec<_> = pixels.iter().map(|p| p.extend(1.0)).collect();
    Picture { width, height: pixels.len() as u32 / width, pixels }
}

const SIZE: [usize; 2] = [96, 64];

/// A picture of ramps and squares, and the same with a patch and less green.
fn patterns() -> [Vec<Vec3>; 2] {
    let at = |i: usize| (i % SIZE[0], i / SIZE[0]);
    let reference: Vec<_> = (0..SIZE[0] * SIZE[1])
        .map(at)
        .map(|(x, y)| {
            let square = if (x / 8 + y / 8) % 2 == 1 { 0.75 } else { 0.0 };
            Vec3::new(((x * 7 + y * 3) % 32) as f32 / 32.0, square, x as f32 / 96.0)
        })
        .collect();
    let changed = |(i, p): (usize, &Vec3)| {
        let (x, y) = at(i);
        let is_patch = (40..60).contains(&x) && (20..30).contains(&y);
        let before = if is_patch { Vec3::new(0.5, 0.25, 0.0) } else { *p };
        before * Vec3::new(1.0, 0.9, 1.0)
    };
    let test = reference.iter().enumerate().map(changed).collect();
    [reference, test]
}

fn mean(errors: &[f32]) -> f32 {
    errors.iter().sum::<f32>() / errors.len() as f32
}

#[test]
fn numbers_are_those_of_hand_calculation() {
    let a = picture(2, &[Vec3::new(1.0, 0.0, 0.0), Vec3::splat(0.5)]);
    let b = picture(2, &[Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.5, 0.5, 1.5)]);
    let numbers = compare(&a, &b, Range::Hdr).unwrap().numbers;
    assert!((numbers.rmse - (1.25_f64 / 6.0).sqrt()).abs() < 1e-12);
    assert!((numbers.rel_mse - (0.25 / 1.01 + 1.0 / 0.26) / 6.0).abs() < 1e-12);
    assert_eq!((numbers.max, numbers.max_at, numbers.differing), (1.0, [1, 0], 2));
    assert_eq!((numbers.max_alpha, numbers.broken), (0.0, 0));
}

#[test]
fn broken_pixels_are_the_worst_there_is() {
    let good = picture(2, &[Vec3::ONE, Vec3::ONE]);
    let bad = picture(2, &[Vec3::new(f32::NAN, 1.0, 1.0), Vec3::new(1.0, f32::INFINITY, 1.0)]);
    let comparison = compare(&good, &bad, Range::Hdr).unwrap();
    assert_eq!(comparison.numbers.broken, 2);
    assert_eq!(comparison.numbers.max, f64::INFINITY);
    assert_eq!(comparison.numbers.rmse, f64::INFINITY);
    assert_eq!(comparison.flip, [1.0, 1.0]);
    // The same damage in both is no difference.
    let same = compare(&bad, &bad.clone(), Range::Hdr).unwrap();
    assert_eq!((same.numbers.max, same.numbers.broken, same.mean_flip()), (0.0, 0, 0.0));
}

#[test]
fn alpha_counts_apart() {
    let a = Picture { width: 1, height: 1, pixels: vec![Vec4::new(0.1, 0.1, 0.1, 1.0)] };
    let b = Picture { pixels: vec![Vec4::new(0.1, 0.1, 0.1, 0.75)], ..a.clone() };
    let numbers = compare(&a, &b, Range::Ldr).unwrap().numbers;
    assert_eq!((numbers.max, numbers.max_alpha, numbers.differing), (0.0, 0.25, 1));
}

#[test]
fn different_sizes_are_refused() {
    let a = picture(2, &[Vec3::ONE; 2]);
    let b = picture(1, &[Vec3::ONE; 2]);
    assert!(compare(&a, &b, Range::Ldr).unwrap_err().contains("2 x 1 pixels and 1 x 2 pixels"));
}

/// Expected values: NVIDIA's `flip-evaluator` 1.7 on the same numbers.
#[test]
fn flip_agrees_with_its_authors() {
    let [reference, test] = patterns();
    let ldr = flip::ldr(&reference, &test, SIZE, flip::PIXELS_PER_DEGREE);
    let expected = [0.241_592, 0.976_958, 0.972_235, 0.065_866];
    let at = |errors: &[f32], x: usize, y: usize| errors[y * SIZE[0] + x];
    let largest = |errors: &[f32]| errors.iter().fold(0.0_f32, |m, v| m.max(*v));
    for (got, expected) in [mean(&ldr), largest(&ldr), at(&ldr, 50, 25), at(&ldr, 5, 5)].iter().zip(expected)
    {
        assert!((got - expected).abs() < 1e-4, "{got} {expected}");
    }
    let brighter = [&reference, &test].map(|pixels| pixels.iter().map(|p| *p * 8.0).collect::<Vec<_>>());
    let hdr = flip::hdr(&brighter[0], &brighter[1], SIZE, flip::PIXELS_PER_DEGREE);
    let expected = [0.122_694, 0.986_873, 0.976_998, 0.082_720];
    for (got, expected) in [mean(&hdr), largest(&hdr), at(&hdr, 50, 25), at(&hdr, 5, 5)].iter().zip(expected)
    {
        assert!((got - expected).abs() < 1e-4, "{got} {expected}");
    }
}

#[test]
fn flip_has_its_ends_and_is_symmetric() {
    let [reference, test] = patterns();
    let size = SIZE;
    assert_eq!(mean(&flip::ldr(&test, &test, size, 67.0)), 0.0);
    assert_eq!(flip::ldr(&reference, &test, size, 67.0), flip::ldr(&test, &reference, size, 67.0));
    // Green against blue is the largest difference there is (HPG 2020, section 4.1.2).
    let flat = |color| vec![color; 32 * 32];
    let errors = flip::ldr(&flat(Vec3::Y), &flat(Vec3::Z), [32, 32], 67.0);
    assert!(errors.iter().all(|e| (e - 1.0).abs() < 1e-4));
}

#[test]
fn fine_patterns_blur_with_distance() {
    let checker: Vec<_> = (0..64 * 64).map(|i| Vec3::splat(((i + i / 64) % 2) as f32)).collect();
    let flat = vec![Vec3::splat(0.5); 64 * 64];
    let seen = |pixels_per_degree| mean(&flip::ldr(&flat, &checker, [64, 64], pixels_per_degree));
    assert!(seen(20.0) > 0.5 && seen(67.0) < 0.5 * seen(20.0), "{} {}", seen(20.0), seen(67.0));
}

#[test]
fn the_difference_picture_is_black_where_nothing_differs() {
    let [reference, mut test] = patterns();
    test.clone_from(&reference);
    test[7] = Vec3::ZERO;
    let [a, b] = [reference, test].map(|pixels| picture(96, &pixels));
    let frame = difference_frame(&compare(&a, &b, Range::Ldr).unwrap(), &a, &b);
    let value = |name: &str, i: usize| frame.channel(name).expect("a channel").values[i];
    assert_eq!(value("difference.B", 7), a.pixels[7].z);
    assert!(value("R", 7) > 0.1 && value("R", 96 * 60) < 0.01 && value("flip.Y", 96 * 60) == 0.0);
}

fn frame(names: &[&str], value: f32) -> Frame {
    let channel =
        |name: &&str| Channel { name: (*name).to_owned(), depth: Depth::Float, values: vec![value; 4] };
    let window = PixelRect { x0: 0, y0: 0, x1: 2, y1: 2 };
    Frame {
        width: 2,
        height: 2,
        window,
        channels: names.iter().map(channel).collect(),
        meta: BTreeMap::new(),
    }
}

#[test]
fn channels_are_compared_one_by_one() {
    let reference = frame(&["Z", "N.X"], 1.0);
    let mut test = frame(&["N.X", "Z"], 1.0);
    test.channels[1].values[3] = 3.0;
    let numbers = compare_channels(&reference, &test).unwrap();
    assert_eq!((numbers[0].name.as_str(), numbers[0].max, numbers[0].differing), ("Z", 2.0, 1));
    assert_eq!((numbers[0].rmse, numbers[1].max), (1.0, 0.0));
    let error = compare_channels(&reference, &frame(&["Z", "P.X"], 1.0)).unwrap_err();
    assert!(error.contains("N.X, P.X"), "{error}");
    let mut cropped = test;
    cropped.window.x1 = 1;
    assert!(compare_channels(&reference, &cropped).is_err());
}
