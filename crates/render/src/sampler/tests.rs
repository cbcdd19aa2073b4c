//! Nets, independence and promises of the sampler.

use super::*;

/// Asserts that every elementary interval of volume 1 / 2^k holds exactly one of the 2^k points.
fn assert_net(points: &[Vec2]) {
    let k = points.len().trailing_zeros();
    assert_eq!(points.len(), 1 << k);
    for columns in 0..=k {
        let mut seen = vec![0; points.len()];
        for p in points {
            let x = (p.x * (1u32 << columns) as f32) as usize;
            let y = (p.y * (1u32 << (k - columns)) as f32) as usize;
            seen[(y << columns) + x] += 1;
        }
        assert!(seen.iter().all(|&n| n == 1), "2^{columns} columns of {} points: {seen:?}", points.len());
    }
}

#[test]
fn pascal_is_the_second_sobol_dimension() {
    for index in (0..1 << 16).step_by(7) {
        let from_table = sobol_burley::parts::sobol_rev(u32::reverse_bits(index), 1);
        assert_eq!(pascal(index), from_table);
    }
}

#[test]
fn every_power_of_two_of_samples_is_a_net() {
    for pixel in [[0, 0], [1, 0], [0, 1], [1919, 1079], [u32::MAX, 3]] {
        for draw in 0..4 {
            let point = |sample| {
                let mut sampler = Sampler::new(7, pixel, sample).fork(2).fork(0);
                (0..=draw).map(|_| sampler.next_2d()).last().unwrap()
            };
            for block in [0..1, 0..16, 16..32, 0..256] {
                assert_net(&block.map(point).collect::<Vec<_>>());
            }
        }
    }
}

#[test]
fn arrays_are_nets_and_so_is_their_union() {
    let array = |sample| Sampler::new(1, [30, 40], sample).array_2d(16).collect::<Vec<_>>();
    for sample in 0..16 {
        assert_net(&array(sample));
    }
    assert_net(&(0..16).flat_map(array).collect::<Vec<_>>());
}

#[test]
fn an_array_of_one_is_a_single_draw() {
    for sample in 0..32 {
        let mut single = Sampler::new(1, [3, 4], sample);
        let mut array = single;
        assert_eq!(array.array_2d(1).collect::<Vec<_>>(), [single.next_2d()]);
    }
}

#[test]
fn numbers_stay_inside_the_unit_square() {
    assert_eq!(to_unit(0), 0.0);
    assert!(to_unit(u32::MAX) < 1.0);
}

#[test]
fn draws_branches_and_pixels_are_uncorrelated() {
    // With n independent pairs the correlation has deviation 1 / sqrt(n); 5 deviations are asked for.
    let n = 4096;
    type Pairs<'a> = &'a dyn Fn(u32) -> (f32, f32);
    let correlation = |pair: Pairs<'_>| {
        let sum: f64 = (0..n).map(pair).map(|(a, b)| (f64::from(a) - 0.5) * (f64::from(b) - 0.5)).sum();
        12.0 * sum / f64::from(n)
    };
    let limit = 5.0 / f64::from(n).sqrt();
    let at = |x, y| Sampler::new(0, [x, y], 0);
    let pairs: [(&str, Pairs<'_>); 6] = [
        ("neighbours in x", &|i| (at(i, 0).next_1d(), at(i + 1, 0).next_1d())),
        ("neighbours in y", &|i| (at(0, i).next_1d(), at(0, i + 1).next_1d())),
        ("x and y of a draw", &|i| at(i, 9).next_2d().into()),
        ("two draws", &|i| {
            let mut sampler = at(i, 9);
            (sampler.next_1d(), sampler.next_1d())
        }),
        ("two branches", &|i| (at(i, 9).fork(0).next_1d(), at(i, 9).fork(1).next_1d())),
        ("parent and branch", &|i| (at(i, 9).next_1d(), at(i, 9).fork(0).next_1d())),
    ];
    for (name, pair) in pairs {
        let found = correlation(pair);
        assert!(found.abs() < limit, "{name}: {found}");
    }
}

#[test]
fn two_draws_of_the_samples_of_a_pixel_are_uncorrelated() {
    let n = 1024;
    let sum: f64 = (0..n)
        .map(|sample| {
            let mut sampler = Sampler::new(0, [5, 6], sample);
            let (a, b) = (sampler.next_1d(), sampler.next_1d());
            (f64::from(a) - 0.5) * (f64::from(b) - 0.5)
        })
        .sum();
    assert!((12.0 * sum / f64::from(n)).abs() < 5.0 / f64::from(n).sqrt());
}

#[test]
fn the_same_place_gives_the_same_numbers_and_others_differ() {
    let all = |mut s: Sampler| [s.next_1d(), s.next_1d(), s.array_2d(3).map(|p| p.y).sum()];
    let base = Sampler::new(3, [10, 20], 4);
    assert_eq!(all(base), all(Sampler::new(3, [10, 20], 4)));
    let others = [
        Sampler::new(4, [10, 20], 4),
        Sampler::new(3, [20, 10], 4),
        Sampler::new(3, [10, 20], 5),
        base.fork(0),
        base.fork(1),
        base.fork(0).fork(1),
        base.fork(1).fork(0),
    ];
    for (i, a) in others.iter().enumerate() {
        assert_ne!(all(*a), all(base));
        assert!(others[..i].iter().all(|b| all(*a) != all(*b)));
    }
}

fn blue(is_chequered: bool, seed: u64) -> Pattern {
    Pattern { seed, kind: SamplerKind::Blue, is_chequered }
}

/// The third draw of a branch.
fn draw(pattern: &Pattern, pixel: [u32; 2], sample: u32) -> Vec2 {
    let mut sampler = pattern.sampler(pixel, sample).fork(3).fork(1);
    (0..3).map(|_| sampler.next_2d()).last().unwrap()
}

#[test]
fn squares_of_pixels_are_nets_together_at_every_power_of_two() {
    for (corner, seed) in [([0, 0], 0), ([8, 16], 1), ([1912, 1072], 2), ([65_528, 65_528], 3)] {
        for side in [1, 2, 4, 8] {
            for samples in [1, 2, 4, 8, 16] {
                let pixels = (0..side * side).map(|i| [corner[0] + i % side, corner[1] + i / side]);
                let points = pixels.flat_map(|p| (0..samples).map(move |s| draw(&blue(false, seed), p, s)));
                assert_net(&points.collect::<Vec<_>>());
            }
        }
    }
}

#[test]
fn pixels_of_one_colour_are_nets_together_where_noise_decides() {
    // Two pixels of a colour in each of two rows: columns 0, 2 and 1, 3.
    let pixels = [[0, 0], [2, 0], [1, 1], [3, 1]];
    for samples in [1, 4, 16] {
        let points = pixels.iter().flat_map(|p| (0..samples).map(|s| draw(&blue(true, 5), *p, s)));
        assert_net(&points.collect::<Vec<_>>());
    }
}

#[test]
fn colours_of_the_chessboard_are_uncorrelated_where_noise_decides() {
    let n = 4096;
    let pair = |i: u32| (draw(&blue(true, 0), [2 * i, 0], 0), draw(&blue(true, 0), [2 * i + 1, 0], 0));
    let sum: f64 = (0..n).map(pair).map(|(a, b)| (f64::from(a.x) - 0.5) * (f64::from(b.x) - 0.5)).sum();
    assert!((12.0 * sum / f64::from(n)).abs() < 5.0 / f64::from(n).sqrt());
}

#[test]
fn two_draws_of_neighbours_are_uncorrelated() {
    let n = 4096_u32;
    // Over pictures, since within one the pixels are no independent cases.
    let sum: f64 = (0..n)
        .map(|seed| {
            let mut sampler = blue(false, u64::from(seed)).sampler([seed % 64, seed / 64], seed % 16);
            (f64::from(sampler.next_1d()) - 0.5) * (f64::from(sampler.next_1d()) - 0.5)
        })
        .sum();
    assert!((12.0 * sum / f64::from(n)).abs() < 5.0 / f64::from(n).sqrt());
}

#[test]
fn errors_of_neighbours_cancel_and_those_of_pixels_stay() {
    // The share of a disk in the unit square, with 4 samples a pixel.
    let truth = std::f64::consts::PI / 16.0;
    let error = |pattern: &Pattern, pixel: [u32; 2]| {
        let hits = (0..4).filter(|&s| draw(pattern, pixel, s).distance(Vec2::new(0.4, 0.6)) < 0.25).count();
        hits as f64 / 4.0 - truth
    };
    let mean_squares = |kind| {
        let (mut pixels, mut squares) = (0.0, 0.0);
        for seed in 0..200 {
            let pattern = Pattern { seed, kind, is_chequered: false };
            let errors: Vec<f64> = (0..16).map(|i| error(&pattern, [8 + i % 4, 4 + i / 4])).collect();
            pixels += errors.iter().map(|e| e * e).sum::<f64>() / 16.0;
            squares += (errors.iter().sum::<f64>() / 16.0).powi(2);
        }
        (pixels / 200.0, squares / 200.0)
    };
    let (white, blue) = (mean_squares(SamplerKind::White), mean_squares(SamplerKind::Blue));
    assert!((blue.0 / white.0 - 1.0).abs() < 0.1, "a pixel: {} against {}", blue.0, white.0);
    assert!(blue.1 < 0.35 * white.1, "a square: {} against {}", blue.1, white.1);
}
