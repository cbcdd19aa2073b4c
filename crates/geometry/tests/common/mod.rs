//! What the tests of the shapes share: the kinds, a solid's inside by definition, and rays at it.

#![allow(dead_code, reason = "each test uses a part of this")]

use glam::{DVec2, DVec3, Vec3};
use heliostat_geometry::ray::LocalRay;
use heliostat_geometry::shape::{LocalHit, Shape};
use heliostat_geometry::strategies::Random;
use heliostat_geometry::{Interval, Ray};

/// The bounded kinds that [`Random::shape_of`] knows.
pub(crate) const KINDS: std::ops::Range<usize> = 0..8;

/// The depth of `p` below the surface of a solid, negative outside; `None` for shapes that are no solids.
///
/// Only the sign and the zero are exact; elsewhere it is a bound of the distance from above.
pub(crate) fn depth(shape: &Shape, p: DVec3) -> Option<f64> {
    let across = DVec2::new(p.x, p.z).length();
    let f = f64::from;
    match shape {
        Shape::Sphere(s) => Some(f(s.radius) - p.length()),
        Shape::Cuboid(s) => Some((0.5 * s.size.as_dvec3() - p.abs()).min_element()),
        Shape::Cylinder(s) if s.capped => Some((f(s.radius) - across).min(p.y).min(f(s.height) - p.y)),
        Shape::Cone(s) if s.capped => {
            let radius = f(s.radius) + (f(s.top_radius) - f(s.radius)) * p.y / f(s.height);
            Some((radius - across).min(p.y).min(f(s.height) - p.y))
        }
        Shape::Torus(s) => Some(f(s.minor) - DVec2::new(across - f(s.major), p.y).length()),
        _ => None,
    }
}

/// The nearest hit on a shape in its own space.
pub(crate) fn hit(shape: &Shape, ray: &LocalRay) -> Option<LocalHit> {
    shape.hit(ray).map(|root| shape.geometry().surface(ray, root))
}

/// A ray over all of `t >= 0`.
pub(crate) fn local_ray(origin: Vec3, dir: Vec3) -> LocalRay {
    LocalRay::from(&Ray { origin, dir, range: Interval::POSITIVE })
}

/// A ray that passes a shape near or far, from near or far.
pub(crate) fn ray_at(random: &mut Random, shape: &Shape) -> LocalRay {
    let bounds = shape.geometry().bounds();
    let distance = [0.5, 2.0, 2.0, 100.0, 1e4][random.below(5)];
    let target = bounds.centre() + 0.55 * bounds.size() * random.cube();
    let origin = bounds.centre() + distance * bounds.radius() * random.cube();
    local_ray(origin, target - origin)
}
