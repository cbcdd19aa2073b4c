//! Frames of the analytic shapes: parameters in range, tangents that are derivatives, normals at right angles.

mod common;

use common::{KINDS, hit, local_ray, ray_at};
use glam::{DVec3, Vec2, Vec3};
use heliostat_geometry::Interval;
use heliostat_geometry::ray::LocalRay;
use heliostat_geometry::shape::{
    Cone, Cuboid, Cylinder, Disk, LocalHit, Rectangle, Root, Shape, Sphere, Torus,
};
use heliostat_geometry::strategies::Random;

fn hit_with_part(shape: &Shape, ray: &LocalRay) -> Option<(Root, LocalHit)> {
    shape.hit(ray).map(|root| (root, shape.geometry().surface(ray, root)))
}

#[test]
fn tangents_are_at_right_angles_to_the_normal_and_right_handed() {
    let mut random = Random::new(30);
    for kind in KINDS {
        for _ in 0..4000 {
            let shape = random.shape_of(kind);
            let Some(found) = hit(&shape, &ray_at(&mut random, &shape)) else { continue };
            let n = found.ng.normalize();
            let (dpdu, dpdv) = (found.dpdu.as_dvec3(), found.dpdv.as_dvec3());
            assert!(n.dot(dpdu).abs() <= 1e-6 * dpdu.length(), "{shape:?} {found:?}");
            assert!(n.dot(dpdv).abs() <= 1e-6 * dpdv.length(), "{shape:?} {found:?}");
            // Zero only at poles.
            let area = dpdu.cross(dpdv);
            assert!(area == DVec3::ZERO || n.dot(area) > 0.0, "{shape:?} {found:?}");
            assert!((Vec2::ZERO.cmple(found.uv) & found.uv.cmple(Vec2::ONE)).all(), "{shape:?} {found:?}");
        }
    }
}

/// A small step along a tangent changes position and parameters as the derivatives say.
#[test]
fn tangents_are_the_derivatives_of_the_position() {
    let mut random = Random::new(31);
    for kind in KINDS {
        let mut checked = 0;
        for _ in 0..4000 {
            let shape = random.shape_of(kind);
            let Some((root, found)) = hit_with_part(&shape, &ray_at(&mut random, &shape)) else { continue };
            let n = found.ng.normalize();
            let along = n.cross(random.direction().as_dvec3()).normalize_or(DVec3::X);
            // Lengths that are small beside every curvature of the shape.
            let feature = match shape {
                Shape::Torus(s) => f64::from(s.minor.min(s.major - s.minor)),
                _ => f64::from(found.dpdu.length()) / std::f64::consts::TAU,
            };
            let step = 1e-3 * feature;
            if step < 1e-6 {
                continue;
            }
            let ray = LocalRay { origin: found.p + step * (along + n), dir: -n, range: Interval::POSITIVE };
            let Some((other_root, other)) = hit_with_part(&shape, &ray) else { continue };
            let duv = (other.uv - found.uv).as_dvec2();
            if other_root.part != root.part
                || duv.abs().max_element() > 0.5
                || other.p.distance(found.p) > 2.0 * step
            {
                continue;
            }
            checked += 1;
            let predicted = duv.x * found.dpdu.as_dvec3() + duv.y * found.dpdv.as_dvec3();
            // Second order in the step, and the rounding of `f32` parameters.
            let rounding = 1e-7 * f64::from(found.dpdu.length() + found.dpdv.length());
            let error = predicted.distance(other.p - found.p);
            assert!(error < 0.02 * step + 2.0 * rounding, "{shape:?} {found:?} {other:?}: {error} of {step}");
        }
        assert!(checked > 300, "kind {kind}: {checked}");
    }
}

/// Seen from outside, pictures stand upright: u to the right, v up.
#[test]
fn parameters_are_upright_seen_from_the_front_and_from_above() {
    let at = |shape: Shape, origin: Vec3, dir: Vec3| hit(&shape, &local_ray(origin, dir)).unwrap().uv;
    let round = [
        Shape::Sphere(Sphere { radius: 1.0 }),
        Shape::Torus(Torus { major: 0.7, minor: 0.3 }),
        Shape::Cylinder(Cylinder { radius: 1.0, height: 1.0, capped: true }),
        Shape::Cone(Cone { radius: 1.0, top_radius: 0.9, height: 1.0, capped: true }),
        Shape::Cuboid(Cuboid { size: Vec3::splat(2.0) }),
    ];
    for shape in round {
        let middle = shape.geometry().bounds().centre();
        let front = at(shape, Vec3::new(0.0, middle.y, 5.0), Vec3::NEG_Z);
        assert!((front - Vec2::splat(0.5)).abs().max_element() < 1e-3, "{shape:?} {front}");
        assert!(at(shape, Vec3::new(0.1, middle.y, 5.0), Vec3::NEG_Z).x > front.x, "{shape:?}");
        assert!(at(shape, Vec3::new(0.0, middle.y + 0.1, 5.0), Vec3::NEG_Z).y > front.y, "{shape:?}");
    }
    let flat = [
        Shape::Rectangle(Rectangle { size: Vec2::new(2.0, 2.0) }),
        Shape::Disk(Disk { radius: 1.0, inner_radius: 0.0 }),
        Shape::Cylinder(Cylinder { radius: 1.0, height: 1.0, capped: true }),
        Shape::Cuboid(Cuboid { size: Vec3::splat(2.0) }),
    ];
    for shape in flat {
        assert_eq!(at(shape, Vec3::new(0.0, 5.0, 0.0), Vec3::NEG_Y), Vec2::splat(0.5));
        assert_eq!(at(shape, Vec3::new(0.5, 5.0, 0.0), Vec3::NEG_Y), Vec2::new(0.75, 0.5));
        assert_eq!(at(shape, Vec3::new(0.0, 5.0, -0.5), Vec3::NEG_Y), Vec2::new(0.5, 0.75));
    }
}

/// Where a parametrisation ends, the numbers stay numbers.
#[test]
fn poles_and_the_apex_have_sane_frames() {
    let shapes = [
        Shape::Sphere(Sphere { radius: 2.0 }),
        Shape::Cone(Cone { radius: 1.0, top_radius: 0.0, height: 2.0, capped: true }),
        Shape::Cylinder(Cylinder { radius: 1.0, height: 2.0, capped: true }),
        Shape::Torus(Torus { major: 0.0, minor: 2.0 }),
    ];
    for shape in shapes {
        for origin in [Vec3::new(0.0, 5.0, 0.0), Vec3::new(1e-30, 5.0, 0.0)] {
            let found = hit(&shape, &local_ray(origin, Vec3::NEG_Y)).unwrap();
            assert_eq!(found.t, 3.0, "{shape:?}");
            assert!(found.ng.is_finite() && found.ng.y > 0.0, "{shape:?} {found:?}");
            assert!(found.uv.is_finite() && found.dpdu.is_finite() && found.dpdv.is_finite());
        }
    }
}
