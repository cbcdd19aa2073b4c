//! Areas and area samples of the analytic shapes against integral geometry.
//!
//! Random lines, uniform in direction and place, cross a surface in proportion to its area, and their crossings are
//! uniform on it (Crofton). So the root finders, which know nothing of sampling, check area, density and evenness.

mod common;

use common::{KINDS, depth};
use glam::{DVec3, Vec2, Vec3};
use heliostat_geometry::ray::LocalRay;
use heliostat_geometry::shape::{AreaSample, Shape};
use heliostat_geometry::strategies::Random;
use heliostat_geometry::warp::square_to_disk;
use heliostat_geometry::{Interval, OrthonormalFrame};
use std::f64::consts::PI;

/// Divisions of each parameter.
const GRID: usize = 5;
/// Cells: parameters, by whether the normal looks up, across or down, to tell faces apart.
const CELLS: usize = 3 * GRID * GRID;

fn cell(uv: Vec2, ng: DVec3) -> usize {
    let bin = |x: f32| ((x * GRID as f32) as usize).min(GRID - 1);
    let n = ng.normalize().y;
    let facing = if n > 0.999_999 { 2 } else { usize::from(n >= -0.999_999) };
    (facing * GRID + bin(uv.y)) * GRID + bin(uv.x)
}

/// A line that is one of all lines through the ball around the shape with equal chance, from its border.
fn random_line(random: &mut Random, centre: Vec3, radius: f32) -> LocalRay {
    let dir = random.direction();
    let place = radius * square_to_disk(random.square());
    let origin = centre + OrthonormalFrame::around(dir).to_world(place.extend(-1.1 * radius));
    LocalRay { origin: origin.as_dvec3(), dir: dir.as_dvec3(), range: Interval::POSITIVE }
}

/// Calls `visit` with every crossing of a line.
fn crossings(shape: &Shape, mut line: LocalRay, mut visit: impl FnMut(Vec2, DVec3)) -> u32 {
    let mut count = 0;
    while let Some(root) = shape.hit(&line) {
        let hit = shape.geometry().surface(&line, root);
        visit(hit.uv, hit.ng);
        count += 1;
        assert!(count <= 4, "{shape:?} {line:?}");
        line.range.min = (root.t as f32).next_up();
    }
    count
}

/// Two histograms of one distribution: the statistic is about its degrees of freedom, its deviation their double root.
fn assert_same_distribution(a: &[f64], b: &[f64], name: &str) {
    let (total_a, total_b): (f64, f64) = (a.iter().sum(), b.iter().sum());
    let (mut statistic, mut freedom) = (0.0, -1.0);
    for (a, b) in a.iter().zip(b).filter(|(a, b)| *a + *b > 10.0) {
        statistic += (a * (total_b / total_a).sqrt() - b * (total_a / total_b).sqrt()).powi(2) / (a + b);
        freedom += 1.0;
    }
    let limit = freedom + 5.0 * (2.0_f64 * freedom).sqrt() + 10.0;
    assert!(statistic < limit, "{name}: chi-square {statistic} over {freedom} degrees of freedom");
}

#[test]
fn crossings_of_random_lines_agree_with_area_and_samples() {
    let mut random = Random::new(20);
    for kind in KINDS {
        for _ in 0..6 {
            let shape = random.shape_of(kind);
            let bounds = shape.geometry().bounds();
            let (centre, radius) = (bounds.centre(), bounds.radius());
            let (mut by_lines, mut by_samples) = (vec![0.0; CELLS], vec![0.0; CELLS]);

            let lines = 60_000;
            let (mut sum, mut squares) = (0.0, 0.0);
            for _ in 0..lines {
                let line = random_line(&mut random, centre, radius);
                let count = f64::from(crossings(&shape, line, |uv, ng| by_lines[cell(uv, ng)] += 1.0));
                sum += count;
                squares += count * count;
            }
            let n = f64::from(lines);
            let (mean, ball) = (sum / n, 2.0 * PI * f64::from(radius).powi(2));
            let deviation = ((squares / n - mean * mean) / n).sqrt() * ball;
            let area = shape.geometry().area();
            assert!((mean * ball - area).abs() < 5.0 * deviation, "{shape:?}: {area} by {}", mean * ball);

            for _ in 0..sum as usize {
                let sample = shape.geometry().sample(random.square()).unwrap();
                by_samples[cell(sample.uv, sample.ng)] += 1.0;
            }
            assert_same_distribution(&by_lines, &by_samples, &format!("{shape:?}"));
        }
    }
}

/// A sample is a point of the surface, and a ray that looks straight at it finds the same frame.
#[test]
fn samples_lie_on_the_surface_as_hits_see_it() {
    let mut random = Random::new(21);
    for kind in KINDS {
        for _ in 0..5000 {
            let shape = random.shape_of(kind);
            let sample: AreaSample = shape.geometry().sample(random.square()).unwrap();
            assert!((sample.ng.length() - 1.0).abs() < 1e-12);
            assert!((sample.pdf * shape.geometry().area() - 1.0).abs() < 1e-12);
            assert!(shape.geometry().bounds().contains(sample.p.as_vec3()), "{shape:?} {sample:?}");
            if let Some(depth) = depth(&shape, sample.p) {
                assert!(
                    depth.abs() < 1e-14 * f64::from(shape.geometry().bounds().radius()) * 10.0,
                    "{depth}"
                );
            }
            let height = 1e-3 * f64::from(shape.geometry().bounds().size().max_element());
            let ray = LocalRay {
                origin: sample.p + height * sample.ng,
                dir: -sample.ng,
                range: Interval::POSITIVE,
            };
            // On a border rounding may decide against the hit.
            let Some(root) = shape.hit(&ray) else { continue };
            let hit = shape.geometry().surface(&ray, root);
            if (root.t - height).abs() < 1e-6 * height {
                assert!(hit.ng.normalize().distance(sample.ng) < 1e-6, "{shape:?} {sample:?} {hit:?}");
                // The parameters of a seam may lie on either side of it, and those of a pole anywhere.
                let apart = (hit.uv - sample.uv).abs();
                let around = apart.x.min(1.0 - apart.x) * hit.dpdu.length() + apart.y * hit.dpdv.length();
                assert!(
                    around < 1e-4 * hit.dpdu.length().max(hit.dpdv.length()),
                    "{shape:?} {sample:?} {hit:?}"
                );
            }
        }
    }
}

#[test]
fn bounds_hold_every_sample_and_no_more_than_needed() {
    let mut random = Random::new(22);
    for kind in KINDS {
        for _ in 0..10 {
            let shape = random.shape_of(kind);
            let samples = (0..4000).map(|_| shape.geometry().sample(random.square()).unwrap().p.as_vec3());
            let (bounds, seen) = (shape.geometry().bounds(), heliostat_geometry::Aabb::of_points(samples));
            assert!(bounds.contains_box(seen), "{shape:?}");
            let slack = 0.1 * bounds.size().max_element();
            assert!((seen.min - bounds.min).max_element() < slack, "{shape:?} {seen:?}");
            assert!((bounds.max - seen.max).max_element() < slack, "{shape:?} {seen:?}");
        }
    }
}

/// Known areas, by hand.
#[test]
fn areas_are_those_of_the_textbook() {
    use heliostat_geometry::shape::{Cone, Cuboid, Cylinder, Disk, Plane, Sphere, Torus, Triangle};
    let area = |shape: Shape| shape.geometry().area();
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b, "{a} {b}");
    near(area(Shape::Sphere(Sphere { radius: 3.0 })), 36.0 * PI);
    near(area(Shape::Cuboid(Cuboid { size: Vec3::new(1.0, 2.0, 3.0) })), 22.0);
    near(area(Shape::Disk(Disk { radius: 2.0, inner_radius: 1.0 })), 3.0 * PI);
    near(area(Shape::Cylinder(Cylinder { radius: 1.0, height: 5.0, capped: true })), 12.0 * PI);
    near(area(Shape::Cone(Cone { radius: 3.0, top_radius: 0.0, height: 4.0, capped: true })), 24.0 * PI);
    near(area(Shape::Cone(Cone { radius: 4.0, top_radius: 1.0, height: 4.0, capped: false })), 25.0 * PI);
    near(area(Shape::Torus(Torus { major: 2.0, minor: 0.5 })), 4.0 * PI * PI);
    // A torus without a ring is a sphere.
    near(area(Shape::Torus(Torus { major: 0.0, minor: 2.0 })), 16.0 * PI);
    near(area(Shape::Triangle(Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::Y })), 0.5);
    assert!(area(Shape::Plane(Plane)).is_infinite());
}

/// Under any transform the density in world space is one over world area, piece by piece.
#[test]
fn world_densities_add_up_to_the_world_area() {
    let mut random = Random::new(23);
    // A sphere stretched along y is a spheroid, whose area has a closed form.
    let sphere = Shape::Sphere(heliostat_geometry::shape::Sphere { radius: 1.0 });
    for stretch in [0.2_f64, 0.5, 2.0, 10.0] {
        let place =
            heliostat_geometry::Transform::scaling(Vec3::new(3.0, 3.0 * stretch as f32, -3.0)).unwrap();
        let n = 40_000;
        let mean = (0..n)
            .map(|_| {
                let sample = sphere.geometry().sample(random.square()).unwrap();
                1.0 / f64::from(place.sample_to_world(&sample).pdf)
            })
            .sum::<f64>()
            / f64::from(n);
        let e = (1.0 - stretch.min(1.0 / stretch).powi(2)).sqrt();
        let area = if stretch < 1.0 {
            2.0 * PI * (1.0 + stretch * stretch / e * e.atanh())
        } else {
            2.0 * PI * (1.0 + stretch / e * e.asin())
        };
        assert!((mean / (9.0 * area) - 1.0).abs() < 0.01, "stretch {stretch}: {mean} of {}", 9.0 * area);
    }
}
