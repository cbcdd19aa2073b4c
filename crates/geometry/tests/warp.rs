//! Every warp against its density: counts per cell, integral one, inverse.

use glam::{Vec2, Vec3};
use heliostat_geometry::strategies::Random;
use heliostat_geometry::warp::{
    DISK_PDF, SPHERE_PDF, cone_pdf, cone_to_square, cosine_hemisphere_pdf, cosine_hemisphere_to_square,
    disk_to_square, hemisphere_pdf, hemisphere_to_square, polygon_pdf, polygon_to_square, sphere_to_square,
    square_to_cone, square_to_cosine_hemisphere, square_to_disk, square_to_hemisphere, square_to_polygon,
    square_to_sphere, square_to_triangle, triangle_to_square,
};
use std::f64::consts::{PI, TAU};

const SAMPLES: usize = 400_000;
const GRID: usize = 20;

/// Counts against expectations: the statistic is about its degrees of freedom, its deviation the root of their double.
fn assert_distribution(counts: &[f64], expected: &[f64], name: &str) {
    let integral: f64 = expected.iter().sum::<f64>() / SAMPLES as f64;
    assert!((integral - 1.0).abs() < 1e-3, "{name}: the density integrates to {integral}");
    let (mut statistic, mut freedom, mut pool) = (0.0, -1.0_f64, (0.0, 0.0));
    for (count, expected) in counts.iter().zip(expected) {
        if *expected == 0.0 {
            assert_eq!(*count, 0.0, "{name}: a sample where the density is 0");
        } else if *expected < 10.0 {
            pool = (pool.0 + count, pool.1 + expected);
        } else {
            statistic += (count - expected).powi(2) / expected;
            freedom += 1.0;
        }
    }
    if pool.1 > 10.0 {
        statistic += (pool.0 - pool.1).powi(2) / pool.1;
        freedom += 1.0;
    }
    let limit = freedom + 5.0 * (2.0 * freedom).sqrt();
    assert!(statistic < limit, "{name}: chi-square {statistic} over {freedom} degrees of freedom");
}

/// A warp to directions, in cells of height and angle, which have equal solid angles.
fn check_directions(
    name: &str,
    warp: impl Fn(Vec2) -> Vec3,
    pdf: impl Fn(Vec3) -> f32,
    inverse: impl Fn(Vec3) -> Vec2,
    lowest: f64,
) {
    let mut random = Random::new(40);
    // Cells from the lowest z that the warp reaches, so that narrow cones are resolved too.
    let span = 1.0 - lowest;
    let mut counts = vec![0.0; GRID * GRID];
    for _ in 0..SAMPLES {
        let u = random.square();
        let dir = warp(u);
        assert!((dir.length() - 1.0).abs() < 1e-6, "{name}: {dir} is not unit");
        // By the ring, where `1 - z` has no digits.
        let ring = f64::from(dir.x).hypot(f64::from(dir.y));
        let fall = if dir.z > 0.9 {
            ring * ring / (1.0 + (1.0 - ring * ring).sqrt())
        } else {
            1.0 - f64::from(dir.z)
        };
        let row = ((fall / span * GRID as f64) as usize).min(GRID - 1);
        let turn = f64::from(dir.y).atan2(f64::from(dir.x)) / TAU + 0.5;
        counts[row * GRID + ((turn * GRID as f64) as usize).min(GRID - 1)] += 1.0;
        assert_round_trip(name, u, inverse(dir));
    }
    let expected: Vec<f64> = (0..GRID * GRID)
        .map(|cell| {
            // Midpoints of 8 heights are enough for densities linear in z.
            let mean = (0..8)
                .map(|i| {
                    let z = 1.0 - span * ((cell / GRID) as f64 + (f64::from(i) + 0.5) / 8.0) / GRID as f64;
                    let angle = TAU * ((cell % GRID) as f64 + 0.5) / GRID as f64 - PI;
                    let ring = (1.0 - z * z).max(0.0).sqrt();
                    f64::from(pdf(Vec3::new(
                        (ring * angle.cos()) as f32,
                        (ring * angle.sin()) as f32,
                        z as f32,
                    )))
                })
                .sum::<f64>()
                / 8.0;
            mean * span * TAU / (GRID * GRID) as f64 * SAMPLES as f64
        })
        .collect();
    assert_distribution(&counts, &expected, name);
}

/// The inverse brings a sample back, up to the rounding that a map without a slope above about 10 can amplify.
fn assert_round_trip(name: &str, u: Vec2, back: Vec2) {
    let apart = (u - back).abs();
    // The border of a turn may come back at its other end.
    let apart = Vec2::new(apart.x.min(1.0 - apart.x), apart.y);
    // Close to a pole the angle has no digits.
    let at_pole = u.y.min(1.0 - u.y) < 1e-3 || u.distance(Vec2::splat(0.5)) < 1e-3;
    assert!(at_pole || apart.max_element() < 2e-4, "{name}: {u} comes back as {back}");
}

/// A warp to the plane, in square cells; cells on the border are compared as one.
fn check_plane(
    name: &str,
    warp: impl Fn(Vec2) -> Vec2,
    pdf: f32,
    inverse: impl Fn(Vec2) -> Vec2,
    inside: impl Fn(Vec2) -> bool,
) {
    let mut random = Random::new(41);
    let cell_of = |p: Vec2| {
        let bin = |x: f32| (((x + 1.0) * 0.5 * GRID as f32) as usize).min(GRID - 1);
        bin(p.y) * GRID + bin(p.x)
    };
    let side = 2.0 / GRID as f32;
    let corner = |cell: usize| side * Vec2::new((cell % GRID) as f32, (cell / GRID) as f32) - Vec2::ONE;
    let whole: Vec<bool> = (0..GRID * GRID)
        .map(|cell| {
            let low = corner(cell);
            [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE].iter().all(|c| inside(low + side * *c))
        })
        .collect();
    let mut counts = vec![0.0; GRID * GRID + 1];
    for _ in 0..SAMPLES {
        let u = random.square();
        let p = warp(u);
        assert!(inside(p * (1.0 - 1e-6)), "{name}: {p} is outside");
        let cell = cell_of(p);
        counts[if whole[cell] { cell } else { GRID * GRID }] += 1.0;
        assert_round_trip(name, u, inverse(p));
    }
    let per_cell = f64::from(pdf) * f64::from(side * side) * SAMPLES as f64;
    let mut expected: Vec<f64> = whole.iter().map(|&w| if w { per_cell } else { 0.0 }).collect();
    expected.push(SAMPLES as f64 - expected.iter().sum::<f64>());
    assert_distribution(&counts, &expected, name);
}

#[test]
fn warps_to_directions_follow_their_density() {
    let cosine = (square_to_cosine_hemisphere, cosine_hemisphere_pdf, cosine_hemisphere_to_square);
    check_directions("cosine hemisphere", cosine.0, cosine.1, cosine.2, -1.0);
    check_directions("hemisphere", square_to_hemisphere, hemisphere_pdf, hemisphere_to_square, -1.0);
    check_directions("sphere", square_to_sphere, |_| SPHERE_PDF, sphere_to_square, -1.0);
    for angle in [1e-4_f32, 0.01, 0.5, 1.5, 3.0] {
        let lowest = 1.0 - 2.0 * f64::from(0.5 * angle).sin().powi(2);
        let warp = |u| square_to_cone(u, angle);
        let name = format!("cone of {angle}");
        if angle < 0.1 {
            // `1 - z` of so narrow a cone is beyond `f32`; look at the disk of its rings instead.
            let scale = 1.0 / (2.0 * (0.5 * angle).sin());
            check_plane(
                &name,
                |u| scale * warp(u).truncate(),
                DISK_PDF,
                |p| cone_to_square((p / scale).extend(1.0), angle),
                |p| p.length() <= 1.0,
            );
        } else {
            check_directions(&name, warp, |_| cone_pdf(angle), |dir| cone_to_square(dir, angle), lowest);
        }
        // The density of a cap, by its area.
        assert!(
            (f64::from(cone_pdf(angle)) * TAU * 2.0 * f64::from(0.5 * angle).sin().powi(2) - 1.0).abs()
                < 1e-6
        );
    }
}

#[test]
fn warps_to_the_plane_follow_their_density() {
    check_plane("disk", square_to_disk, DISK_PDF, disk_to_square, |p| p.length() <= 1.0);
    for sides in [3, 4, 5, 6, 9, 17] {
        // Inside the regular polygon: on the inner side of every edge, at the distance of the inner circle.
        let reach = (std::f32::consts::PI / sides as f32).cos();
        let inside = |p: Vec2| {
            (0..sides).all(|k| {
                p.dot(Vec2::from_angle(std::f32::consts::TAU * (k as f32 + 0.5) / sides as f32)) <= reach
            })
        };
        let name = format!("{sides} blades");
        check_plane(
            &name,
            |u| square_to_polygon(u, sides),
            polygon_pdf(sides),
            |p| polygon_to_square(p, sides),
            inside,
        );
    }
    // The right triangle with legs of 2, whose area is 2.
    let [a, b, c] = [Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0), Vec2::new(-1.0, 1.0)];
    let to_plane = |u| {
        let [x, y, z] = square_to_triangle(u);
        x * a + y * b + z * c
    };
    let back = |p: Vec2| {
        let (y, z) = ((p.x + 1.0) / 2.0, (p.y + 1.0) / 2.0);
        triangle_to_square([1.0 - y - z, y, z])
    };
    // The sample's own border is the diagonal; the origin of the shrinking test is inside.
    check_plane("triangle", to_plane, 0.5, back, |p| p.x >= -1.0 && p.y >= -1.0 && p.x + p.y <= 1e-6);
}

#[test]
fn fewer_than_three_blades_are_round() {
    assert_eq!(square_to_polygon(Vec2::new(0.3, 0.9), 0), square_to_disk(Vec2::new(0.3, 0.9)));
    assert_eq!(polygon_pdf(2), DISK_PDF);
}
