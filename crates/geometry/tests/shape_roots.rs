//! Roots of the analytic shapes against their definitions: nothing missed, nothing invented.

mod common;

use common::{KINDS, depth, hit, local_ray, ray_at};
use glam::{DVec3, Vec3};
use heliostat_geometry::ray::LocalRay;
use heliostat_geometry::shape::{Cone, Cylinder, Shape, Sphere, Torus};
use heliostat_geometry::strategies::Random;

/// The largest coordinate of a shape.
fn extent(shape: &Shape) -> f64 {
    let bounds = shape.geometry().bounds();
    f64::from(bounds.min.abs().max(bounds.max.abs()).max_element())
}

/// No point before the hit, or of the whole ray without one, is on the other side of the surface.
fn assert_nothing_missed(shape: &Shape, ray: &LocalRay) {
    let Some(start_depth) = depth(shape, ray.origin) else { return };
    let end = hit(shape, ray)
        .map_or_else(|| (ray.origin.length() + 4.0 * extent(shape)) / ray.dir.length(), |hit| hit.t);
    // The surface is a band of rounding: far origins have coarse distances.
    let slack = 1e-12 * (extent(shape) + ray.origin.length());
    if start_depth.abs() <= slack {
        return;
    }
    let start_inside = start_depth > 0.0;
    // Walk only where the shape can be.
    let middle = -ray.origin.dot(ray.dir) / ray.dir.length_squared();
    let reach = 2.0 * extent(shape) / ray.dir.length();
    let (from, to) = ((middle - reach).max(0.0), (middle + reach).min(end));
    for step in 1..400 {
        let t = from + (to - from) * f64::from(step) / 400.0;
        let depth = depth(shape, ray.at(t)).unwrap_or(0.0);
        let wrong = if start_inside { depth < -slack } else { depth > slack };
        assert!(!wrong || from >= to, "{shape:?} {ray:?}: at {t} of {end} the depth is {depth}");
    }
}

/// A hit lies on the ray and on the surface, and its normal looks out of the solid.
fn assert_hit_is_true(shape: &Shape, ray: &LocalRay) -> bool {
    let Some(found) = hit(shape, ray) else { return false };
    assert!(found.t > 0.0 && found.ng.is_finite() && found.ng != DVec3::ZERO, "{shape:?} {ray:?} {found:?}");
    assert!(
        (-1e-6..=1.0 + 1e-6).contains(&found.uv.x) && (-1e-6..=1.0 + 1e-6).contains(&found.uv.y),
        "{found:?}"
    );
    // Roots are good to rounding of the distance, and to its square root where the ray only touches.
    let cosine = found.ng.normalize().dot(ray.dir.normalize()).abs();
    let size = extent(shape) + ray.origin.length();
    let off_ray = found.p.distance(ray.at(found.t));
    assert!(off_ray <= 1e-12 * size / cosine.max(1e-6), "{shape:?} {ray:?}: {off_ray} off, cosine {cosine}");
    if let Some(depth_there) = depth(shape, found.p) {
        assert!(depth_there.abs() <= 1e-14 * extent(shape).max(1.0), "{shape:?}: depth {depth_there}");
        let above = found.p + 1e-6 * extent(shape) * found.ng.normalize();
        assert!(
            depth(shape, above).is_some_and(|depth| depth < 0.0),
            "{shape:?}: the normal looks inside at {:?}",
            found.p
        );
    }
    true
}

#[test]
fn hits_are_on_the_surface_and_nothing_is_missed() {
    let mut random = Random::new(1);
    for kind in KINDS {
        let mut hits = 0;
        for _ in 0..4000 {
            let shape = random.shape_of(kind);
            let ray = ray_at(&mut random, &shape);
            hits += u32::from(assert_hit_is_true(&shape, &ray));
            assert_nothing_missed(&shape, &ray);
        }
        assert!(hits > 300, "kind {kind} was hit only {hits} times");
    }
}

#[test]
fn axis_parallel_rays_miss_nothing() {
    let mut random = Random::new(2);
    for kind in KINDS {
        for _ in 0..2000 {
            let shape = random.shape_of(kind);
            let bounds = shape.geometry().bounds();
            let mut dir = Vec3::ZERO;
            dir[random.below(3)] = [1.0, -1.0][random.below(2)];
            // Often exactly in the planes and on the axis of the shape.
            let mut place = random.cube();
            for axis in 0..3 {
                if random.below(3) == 0 {
                    place[axis] = [0.0, 1.0, -1.0, 0.5][random.below(4)];
                }
            }
            let origin =
                bounds.centre() + 0.5 * place * bounds.size() - [0.0, 3.0, 1e4][random.below(3)] * dir;
            let ray = local_ray(origin, dir);
            assert_hit_is_true(&shape, &ray);
            assert_nothing_missed(&shape, &ray);
        }
    }
}

/// Choose a point of the surface, then look at it from somewhere: the ray must stop there or before.
#[test]
fn planted_points_are_found() {
    let mut random = Random::new(3);
    for kind in KINDS {
        for _ in 0..20_000 {
            let shape = random.shape_of(kind);
            let Some(sample) = shape.geometry().sample(random.square()) else { continue };
            let distance = random.magnitude(0.01, 1e4);
            let origin = (sample.p + f64::from(distance) * random.direction().as_dvec3()).as_vec3();
            // Full precision of the direction: it is the plan, not a rounded ray, that must arrive.
            let ray = LocalRay { dir: sample.p - origin.as_dvec3(), ..local_ray(origin, Vec3::X) };
            let cosine = sample.ng.dot(ray.dir.normalize()).abs();
            // A flat shape is hit or not by rounding when the point is on its border; stay inside.
            if cosine < 1e-4 || on_border(&shape, sample.p) {
                continue;
            }
            let found = shape.hit(&ray);
            let tolerance = 1e-12 * (1.0 + origin.length() as f64 / ray.dir.length()) / cosine.powi(2);
            assert!(
                found.is_some_and(|root| root.t <= 1.0 + tolerance),
                "{shape:?} at {:?} from {origin:?}: {found:?}",
                sample.p
            );
        }
    }
}

/// Whether a point of an open shape is within rounding of its border.
fn on_border(shape: &Shape, p: DVec3) -> bool {
    let bounds = shape.geometry().bounds();
    let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * (high - low).max_element();
    match shape {
        Shape::Rectangle(_) => near(p.x.abs(), high.x) || near(p.z.abs(), high.z),
        Shape::Disk(s) => {
            let across = p.x.hypot(p.z);
            near(across, s.radius.into()) || near(across, s.inner_radius.into())
        }
        Shape::Cylinder(s) if !s.capped => near(p.y, 0.0) || near(p.y, high.y),
        Shape::Cone(s) if !s.capped => near(p.y, 0.0) || near(p.y, high.y),
        Shape::Triangle(s) => {
            let [a, b, c] = [s.a, s.b, s.c].map(|v| v.as_dvec3());
            let area = (b - a).cross(c - a).length();
            [(a, b), (b, c), (c, a)].iter().any(|(a, b)| (p - *a).cross(*b - *a).length() < 1e-6 * area)
        }
        _ => false,
    }
}

#[test]
fn known_roots_of_the_torus() {
    let shape = Shape::Torus(Torus { major: 2.0, minor: 0.5 });
    let t = |x, y, z, dx, dy, dz| {
        hit(&shape, &local_ray(Vec3::new(x, y, z), Vec3::new(dx, dy, dz))).map(|found| found.t as f32)
    };
    // Along x through both tubes, from four places.
    assert_eq!(t(-5.0, 0.0, 0.0, 1.0, 0.0, 0.0), Some(2.5));
    assert_eq!(t(-2.0, 0.0, 0.0, 1.0, 0.0, 0.0), Some(0.5));
    assert_eq!(t(0.0, 0.0, 0.0, 1.0, 0.0, 0.0), Some(1.5));
    assert_eq!(t(2.0, 0.0, 0.0, 1.0, 0.0, 0.0), Some(0.5));
    assert_eq!(t(5.0, 0.0, 0.0, 1.0, 0.0, 0.0), None);
    // Down the axis, through the hole; down onto the ring; past the outside.
    assert_eq!(t(0.0, 9.0, 0.0, 0.0, -1.0, 0.0), None);
    assert_eq!(t(0.0, 9.0, 2.0, 0.0, -2.0, 0.0), Some(4.25));
    assert_eq!(t(0.0, 9.0, 2.75, 0.0, -1.0, 0.0), None);
    // Touching from above and at the outermost ring: within rounding of a double root, or past it.
    for (origin, dir, touch) in [
        (Vec3::new(-5.0, 0.5, 2.0), Vec3::X, 5.0),
        (Vec3::new(-5.0, 0.0, 2.5), Vec3::X, 5.0),
        (Vec3::new(2.5, 7.0, 0.0), Vec3::NEG_Y, 7.0),
        (Vec3::new(1.5, 7.0, 0.0), Vec3::NEG_Y, 7.0),
    ] {
        if let Some(found) = hit(&shape, &local_ray(origin, dir)) {
            assert!((found.t - touch).abs() < 1e-7, "{origin:?}: {}", found.t);
        }
    }
}

/// Tangent rays a hair above and below the tube: a double root that opens.
#[test]
fn silhouettes_of_the_torus_are_sharp() {
    let mut random = Random::new(4);
    for _ in 0..20_000 {
        let minor = random.magnitude(0.01, 1.0);
        let torus = Torus { major: minor * random.magnitude(1.05, 100.0), minor };
        let shape = Shape::Torus(torus);
        let sample = shape.geometry().sample(random.square()).unwrap();
        let across = sample.ng.cross(random.direction().as_dvec3()).normalize();
        // Curvature of the surface along the ray; negative on the inner side, where the ray enters anyway.
        let gap = f64::from(minor) * f64::from(random.magnitude(1e-9, 1e-3));
        let distance = f64::from(random.magnitude(0.1, 1e4)) * f64::from(torus.major);
        let base =
            LocalRay { origin: DVec3::ZERO, dir: across, range: heliostat_geometry::Interval::POSITIVE };
        for sign in [1.0, -1.0] {
            let ray = LocalRay { origin: sample.p + sign * gap * sample.ng - distance * across, ..base };
            assert_nothing_missed(&shape, &ray);
        }
        // Below the surface the line is inside, so from outside it has entered at or before that point.
        let ray = LocalRay { origin: sample.p - gap * sample.ng - distance * across, ..base };
        let from_inside = depth(&shape, ray.origin).unwrap() > 0.0;
        let slack = 1e-12 * distance;
        if gap > slack {
            let found = shape.hit(&ray);
            assert!(
                from_inside || found.is_some_and(|root| root.t <= distance + slack),
                "{shape:?} {ray:?} {found:?}"
            );
        }
    }
}

#[test]
fn a_thick_torus_is_its_outer_skin() {
    let mut random = Random::new(5);
    for _ in 0..5000 {
        let minor = random.magnitude(0.1, 2.0);
        let shape = Shape::Torus(Torus { major: minor * random.between(0.0, 1.0), minor });
        let ray = ray_at(&mut random, &shape);
        assert_nothing_missed(&shape, &ray);
        if let Some(found) = hit(&shape, &ray) {
            assert!(depth(&shape, found.p).unwrap().abs() < 1e-12);
        }
    }
}

#[test]
fn rays_at_the_apex_and_the_rims_of_cones_and_cylinders_are_stopped() {
    let mut random = Random::new(6);
    for _ in 0..20_000 {
        let (radius, height) = (random.magnitude(0.1, 2.0), random.magnitude(0.1, 2.0));
        let cone = Shape::Cone(Cone { radius, top_radius: 0.0, height, capped: true });
        let cylinder = Shape::Cylinder(Cylinder { radius, height, capped: true });
        // From a point inside there is a way out in every direction, rims and apex included.
        let inside = Vec3::new(0.1 * radius, 0.3 * height, -0.2 * radius);
        let angle = random.between(0.0, std::f32::consts::TAU);
        let rim = Vec3::new(radius * angle.sin(), [0.0, height][random.below(2)], radius * angle.cos());
        for (shape, target) in [(cone, Vec3::new(0.0, height, 0.0)), (cone, rim), (cylinder, rim)] {
            let found = hit(&shape, &local_ray(inside, target - inside));
            assert!(
                found.is_some_and(|hit| hit.ng.is_finite() && hit.ng != DVec3::ZERO),
                "{shape:?} {target:?}"
            );
        }
    }
}

#[test]
fn the_range_of_the_ray_chooses_the_root() {
    let shape = Shape::Sphere(Sphere { radius: 1.0 });
    let t = |min: f32, max: f32| {
        let mut ray = local_ray(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z);
        (ray.range.min, ray.range.max) = (min, max);
        shape.hit(&ray).map(|root| root.t)
    };
    assert_eq!(t(0.0, f32::INFINITY), Some(2.0));
    assert_eq!(t(2.0, 2.0), Some(2.0));
    assert_eq!(t(2.5, 9.0), Some(4.0));
    assert_eq!(t(0.0, 1.9), None);
    assert_eq!(t(2.5, 3.5), None);
}
