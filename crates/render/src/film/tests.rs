//! Films: tiles, strata, claims.

use super::stopping::Use;
use super::*;
use heliostat_scene::settings::Filter;

#[test]
fn tiles_cover_each_pixel_once() {
    for (x0, y0, x1, y1) in [(0, 0, 1, 1), (0, 0, 64, 32), (5, 17, 40, 50), (31, 0, 33, 16), (0, 0, 100, 7)] {
        let window = PixelRect { x0, y0, x1, y1 };
        let mut seen = vec![0; (window.width() * window.height()) as usize];
        for rect in tile_rects(window) {
            assert!(rect.width() <= TILE && rect.height() <= TILE);
            for (x, y) in (rect.y0..rect.y1).flat_map(|y| (rect.x0..rect.x1).map(move |x| (x, y))) {
                seen[((y - y0) * window.width() + x - x0) as usize] += 1;
            }
        }
        assert!(seen.iter().all(|&n| n == 1), "{window:?}");
    }
}

fn shot(value: f32, is_negative: bool, distance: f32) -> Shot {
    Shot { radiance: Rgb::splat(value), alpha: 1.0, depth: value, hit: None, is_negative, distance }
}

fn film(filter: Filter, radius: f32) -> Film {
    let filter = PixelFilter::new(filter, radius, 16);
    let keep = Keep { lobes: filter.has_negative_lobes(), albedo: false, nearest: true, ..Keep::default() };
    Film::new(PixelRect { x0: 0, y0: 0, x1: 1, y1: 1 }, &filter, keep)
}

#[test]
fn strata_are_averaged_apart() {
    let mut film = film(Filter::Lanczos, 3.0);
    let (a, b) = film.masses();
    for (value, is_negative) in [(1.0, false), (3.0, false), (0.5, true)] {
        film.tiles_mut()[0].add(0, &shot(value, is_negative, 0.0), Use::Kept);
    }
    let rgba = film.tiles()[0].rgba(0, film.masses());
    let want = (2.0 * a - 0.5 * b) as f32;
    assert_eq!(rgba, [want, want, want, (a - b) as f32]);
}

#[test]
fn a_pixel_with_one_stratum_or_none_is_still_a_mean() {
    let mut film = film(Filter::Lanczos, 3.0);
    assert_eq!(film.tiles()[0].rgba(0, film.masses()), [0.0; 4]);
    film.tiles_mut()[0].add(0, &shot(0.25, true, 0.0), Use::Kept);
    assert_eq!(film.tiles()[0].rgba(0, film.masses()), [0.25, 0.25, 0.25, 1.0]);
}

#[test]
fn the_sample_nearest_to_the_centre_wins_and_the_first_of_equals() {
    let mut film = film(Filter::Box, 0.5);
    for (depth, distance) in [(1.0, 0.5), (2.0, 0.25), (3.0, 0.25), (4.0, 0.3)] {
        film.tiles_mut()[0].add(0, &shot(depth, false, distance), Use::Kept);
    }
    assert_eq!(film.tiles()[0].nearest(0).depth, 2.0);
}

#[test]
fn samples_are_claimed_once() {
    let mut film = film(Filter::Box, 0.5);
    let tile = &mut film.tiles_mut()[0];
    assert_eq!(tile.claim(&(0..4), 16), 0..4);
    assert!(tile.claim(&(0..4), 16).is_empty());
    assert_eq!(tile.claim(&(2..6), 16), 4..6);
    assert!(tile.claim(&(0..3), 16).is_empty());
    assert_eq!(tile.claim(&(10..14), 3), 10..13);
    assert_eq!(tile.claim(&(10..14), 3), 13..14);
    assert_eq!(tile.claim(&(u32::MAX - 1..u32::MAX), 3), u32::MAX - 1..u32::MAX);
    assert_eq!(film.samples(), (11, 11));
}
