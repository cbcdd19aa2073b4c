//! What is learnt against planted answers: densities that are densities, draws that follow them, leaves that hold what they should.

use super::directions::Directions;
use super::growth::{Growth, UNKNOWN};
use super::lead::{Lead, Odds};
use super::places::Places;
use super::trail::Record;
use crate::bsdf::tests::white;
use crate::bsdf::{Bsdf, Event, StandardBsdf, StandardPoint};
use crate::sampler::Sampler;
use glam::{Vec2, Vec3};
use heliostat_geometry::OrthonormalFrame;
use heliostat_geometry::warp::{SPHERE_PDF, sphere_to_square, square_to_sphere};
use heliostat_scene::Rgb;

/// Bins of the sphere along either side of the square.
const BINS: usize = 16;
const DRAWS: u32 = 200_000;

fn record(dir: Vec2, value: f32) -> Record {
    Record { leaf: 0, p: Vec3::ZERO, dir, pdf: 1.0, sent: value, lead: None }
}

/// What is learnt, in so many turns, of light with that density on the square.
fn taught(turns: u32, light: impl Fn(Vec2) -> f32) -> Growth {
    let mut growth = Growth::new();
    for turn in 0..turns {
        if turn > 0 {
            growth = growth.refined();
        }
        let mut draws = Sampler::new(u64::from(turn), [0, 0], 0);
        draws.array_2d(1 << 17).for_each(|u| growth.add(&record(u, light(u))));
    }
    growth
}

/// A dim sky, a bright window, and a lamp that is a thousandth of the sphere, across the seam of the square.
fn room(u: Vec2) -> f32 {
    let is_lamp = (u.x < 0.015 || u.x > 0.985) && (u.y - 0.3).abs() < 0.016;
    let is_window = (u - Vec2::new(0.6, 0.5)).abs().max_element() < 0.1;
    0.1 + f32::from(u8::from(is_window)) * 5.0 + f32::from(u8::from(is_lamp)) * 300.0
}

fn learnt() -> Directions {
    taught(5, room).directions().unwrap()
}

/// The centres of squares in a grid.
fn grid(n: usize) -> impl Iterator<Item = Vec2> {
    (0..n * n).map(move |i| (Vec2::new((i % n) as f32, (i / n) as f32) + 0.5) / n as f32)
}

fn bin(u: Vec2) -> usize {
    let [x, y] = (BINS as f32 * u).to_array().map(|x| (x as usize).min(BINS - 1));
    y * BINS + x
}

/// The share of each bin by a density per steradian.
fn shares(pdf: impl Fn(Vec3) -> f32) -> Vec<f64> {
    const N: usize = 1024;
    let mut shares = vec![0.0; BINS * BINS];
    grid(N).for_each(|u| shares[bin(u)] += f64::from(pdf(square_to_sphere(u)) / SPHERE_PDF) / (N * N) as f64);
    shares
}

/// Asserts that counts follow shares; what is left of the draws had no density.
#[track_caller]
fn assert_follow(counts: &[f64], shares: &[f64]) {
    let (mut statistic, mut freedom, mut pool) = (0.0, -1.0, (0.0, 0.0));
    let n = f64::from(DRAWS);
    let rest = (n - counts.iter().sum::<f64>(), n * (1.0 - shares.iter().sum::<f64>()));
    for (count, expected) in counts.iter().zip(shares).map(|(&c, &s)| (c, n * s)).chain([rest]) {
        pool = (pool.0 + count, pool.1 + expected);
        if pool.1 >= 10.0 {
            statistic += (pool.0 - pool.1) * (pool.0 - pool.1) / pool.1;
            freedom += 1.0;
            pool = (0.0, 0.0);
        }
    }
    // Wilson and Hilferty: four and a half deviations.
    let spread: f64 = 2.0 / (9.0 * freedom);
    let normal = ((statistic / freedom).cbrt() - (1.0 - spread)) / spread.sqrt();
    assert!(normal < 4.5, "chi-square {statistic} over {freedom}: {normal} deviations; rest {rest:?}");
}

#[test]
fn a_density_adds_up_to_one_and_draws_follow_it() {
    for directions in
        [learnt(), taught(1, room).directions().unwrap(), taught(3, |_| 1.0).directions().unwrap()]
    {
        let shares = shares(|dir| directions.pdf(dir));
        let sum: f64 = shares.iter().sum();
        assert!((sum - 1.0).abs() < 2e-3, "{sum}");
        let mut counts = vec![0.0; BINS * BINS];
        for i in 0..DRAWS {
            let u = Sampler::new(7, [i, 3], 0).next_2d();
            counts[bin(sphere_to_square(directions.sample(u)))] += 1.0;
        }
        assert_follow(&counts, &shares);
    }
}

#[test]
fn light_is_found_where_it_is() {
    let directions = learnt();
    let pdf = |x: f32, y: f32| directions.pdf(square_to_sphere(Vec2::new(x, y))) / SPHERE_PDF;
    let mean = grid(512).map(room).sum::<f32>() / (512.0 * 512.0);
    // What was planted, smeared by the box over a square of its own size.
    for (x, y, share) in [(0.002, 0.3, 0.6), (0.998, 0.3, 0.6), (0.6, 0.5, 0.9)] {
        let planted = room(Vec2::new(x, y)) / mean;
        assert!(pdf(x, y) > share * planted && pdf(x, y) < planted / share, "{} for {planted}", pdf(x, y));
    }
    assert!(pdf(0.3, 0.8) < 0.3 / mean, "{}", pdf(0.3, 0.8));
    // A single direction becomes narrow, not infinite; nothing at all is no density.
    assert_eq!(Growth::new().refined().directions(), None);
    let mut growth = Growth::new();
    for _ in 0..6 {
        growth = growth.refined();
        (0..2000).for_each(|_| growth.add(&record(Vec2::new(0.3, 0.4), 4.0)));
    }
    let peak = growth.directions().unwrap().pdf(square_to_sphere(Vec2::new(0.3, 0.4)));
    assert!(peak > 1e4 && peak.is_finite(), "{peak}");
    growth.add(&record(Vec2::ZERO, f32::MAX));
    growth.add(&record(Vec2::ZERO, f32::MAX));
    assert_eq!(growth.directions(), None, "too much to be shared out");
}

#[test]
fn edges_and_poles_lose_nothing() {
    for (x, y) in [(0.0, 0.0), (1.0, 1.0), (0.0, 0.5), (1.0, 0.2), (0.5, 0.0), (0.3, 1.0), (0.49, 0.51)] {
        let mut growth = taught(4, room);
        let all = growth.found();
        growth = growth.refined();
        assert!((growth.found() / all - 0.5).abs() < 1e-4, "half of it is kept: {} of {all}", growth.found());
        let (kept, much) = (growth.found(), all);
        growth.add(&record(Vec2::new(x, y), much));
        let added = growth.found() - kept;
        assert!((added / much - 1.0).abs() < 1e-4, "{x} {y}: {added} of {much}");
    }
}

#[test]
fn the_share_of_the_surface_is_learnt() {
    let own = |surface: f32, learnt: f32| {
        let mut growth = Growth::new();
        let odds = Odds::new(surface, learnt, 1.0);
        for (sent, lead) in [(1.0, Some(odds)), (0.0, Some(odds)), (2.0, None)] {
            growth.add(&Record { sent, lead, ..record(Vec2::splat(0.5), 1.0) });
        }
        growth.own()
    };
    assert_eq!(own(0.01, 5.0), 0.3);
    assert_eq!(own(5.0, 0.01), 0.6);
    assert_eq!(own(1.0, 1.0), UNKNOWN);
    assert_eq!(Growth::new().own(), UNKNOWN);
    // Two in five are only found by the surface, the others only by what was learnt.
    let mut growth = Growth::new();
    for (surface, learnt, sent) in [(1.0, 0.0, 2.0), (0.0, 1.0, 3.0)] {
        let lead = Some(Odds::new(surface, learnt, 1.0));
        growth.add(&Record { sent, lead, ..record(Vec2::splat(0.5), 1.0) });
    }
    assert_eq!(growth.own(), 0.4);
}

#[test]
fn leaves_hold_no_more_than_they_should() {
    let mut draws = Sampler::new(1, [0, 0], 0);
    let mut points: Vec<_> = draws.array_2d(4096).map(|u| u.extend(0.0)).collect();
    // A floor without end, and one place that is met again and again.
    points.extend((0..64).map(|i| Vec3::new(10.0_f32.powi(i / 2), 0.0, -1.0)));
    points.extend([Vec3::splat(3.0); 500]);
    let mut places = Places::new();
    assert_eq!(places.divide(&points, 100_000), [0]);
    let origins = places.divide(&points, 100);
    assert!(origins.len() > 40 && origins.iter().all(|&origin| origin == 0), "{origins:?}");
    let mut held = vec![0; origins.len()];
    points.iter().for_each(|&p| held[places.leaf(p) as usize] += 1);
    let crowded = places.leaf(Vec3::splat(3.0)) as usize;
    assert!(held.iter().enumerate().all(|(i, &n)| n > 0 && (n <= 100 || i == crowded)), "{held:?}");
    // Leaves that are there keep their numbers.
    let p = Vec3::new(0.2, 0.7, 0.0);
    let before = places.leaf(p);
    let origins = places.divide(&points, 30);
    assert_eq!(origins[places.leaf(p) as usize], before);
    assert_eq!(places.divide(&[], 30).len(), origins.len());
    for hostile in [Vec3::NAN, Vec3::INFINITY, Vec3::NEG_INFINITY] {
        assert!((places.leaf(hostile) as usize) < origins.len());
    }
}

/// Plastic under a boundary of a roughness.
fn plastic(roughness: f32) -> Bsdf {
    let point = StandardPoint { base_color: Rgb::splat(0.6), roughness, ..white() };
    Bsdf::Standard(StandardBsdf::new(&point, true, Vec3::Z))
}

#[test]
fn mixtures_draw_what_they_say() {
    let (directions, frame) = (learnt(), OrthonormalFrame::around(Vec3::new(0.48, 0.6, 0.64)));
    for (bsdf, own) in [(plastic(0.0), 0.3), (plastic(0.5), 0.7), (Bsdf::white(), 0.1)] {
        let view = bsdf.seen_from(Vec3::new(0.6, 0.0, 0.8));
        let lead = Lead::new(&directions, own, view.breadth());
        let density = |dir: Vec3| match view.eval(frame.to_local(dir)) {
            (value, pdf) if value != Rgb::ZERO => lead.pdf(dir, pdf),
            _ => 0.0,
        };
        let shares = shares(density);
        let mut counts = vec![0.0; BINS * BINS];
        let (mut matte, mut expected) = (0.0, 0.0);
        for i in 0..DRAWS {
            let mut draws = Sampler::new(11, [i, 9], 0);
            let Some(sample) = lead.sample(&view, &frame, Rgb::ONE, draws.next_1d(), draws.next_2d()) else {
                continue;
            };
            if sample.is_delta() {
                continue;
            }
            let dir = frame.to_world(sample.wi);
            let (value, pdf) = view.eval(frame.to_local(dir));
            // At the horizon the turn of the frame leaves few digits.
            let close = |a: f32, b: f32| (a - b).abs() <= 1e-3 * b.abs() + 1e-5;
            assert!(close(sample.pdf, lead.pdf(dir, pdf)), "{sample:?}");
            assert!(close(sample.weight.x * sample.pdf, value.x), "{sample:?}");
            counts[bin(sphere_to_square(dir))] += 1.0;
            matte += f64::from(u8::from(sample.event == Event::Diffuse));
            expected += f64::from(view.matte_pdf(sample.wi) / pdf);
        }
        assert_follow(&counts, &shares);
        // A layer is named as often as it might have drawn the direction.
        assert!((matte - expected).abs() < 5.0 * f64::from(DRAWS).sqrt(), "{matte} for {expected}");
    }
}
