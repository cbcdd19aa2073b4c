//! Laws of affine transforms, at scales from 1e-3 to 1e5 and away from the origin.

use glam::{DVec3, Vec3};
use heliostat_geometry::strategies::{direction, point, transform};
use heliostat_geometry::{Aabb, Ray, Transform};
use proptest::prelude::*;

/// Largest absolute entry of the linear map times that of its inverse, which bounds how errors grow.
fn condition(place: &Transform) -> f64 {
    let m = place.matrix().matrix3;
    let largest = |m: glam::DMat3| m.to_cols_array().into_iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    largest(m) * largest(m.inverse())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, max_global_rejects: u32::MAX, ..ProptestConfig::default() })]

    /// There and back is where it was, up to two roundings to `f32`.
    #[test]
    fn points_return(place in transform(), p in point()) {
        let world = place.point(p);
        let back = place.point_to_local(world);
        // The rounding of the world point, seen from local space.
        let inverse = place.matrix().matrix3.inverse();
        let seen = (inverse.x_axis.abs() * f64::from(world.x.abs()))
            + inverse.y_axis.abs() * f64::from(world.y.abs())
            + inverse.z_axis.abs() * f64::from(world.z.abs());
        let bound = 1.2e-7 * (seen + p.as_dvec3().abs()) + DVec3::splat(1e-30);
        prop_assert!(((back - p).as_dvec3().abs().cmple(bound)).all(), "{p} {back} {bound}");
    }

    /// Normals stay at right angles to tangents and keep their side.
    #[test]
    fn normals_stay_at_right_angles(place in transform(), n in direction(), other in direction()) {
        let tangent = n.cross(other).normalize_or_zero();
        prop_assume!(tangent != Vec3::ZERO);
        let world_normal = place.normal(n);
        let world_tangent = place.vector(tangent);
        // The tangent's own error off the plane, 1e-7, grows by the condition of the map.
        prop_assert!((world_normal.length() - 1.0).abs() < 1e-6);
        let sine = world_normal.dot(world_tangent.normalize()).abs();
        prop_assert!(f64::from(sine) < 1e-6 * condition(&place), "{sine}");
        prop_assert!(world_normal.dot(place.vector(n)) > 0.0);
    }

    /// A ray and its image meet their points at the same parameters.
    #[test]
    fn rays_keep_their_parameters(place in transform(), origin in point(), dir in direction(), t in 0.0_f32..10.0) {
        let ray = Ray::new(place.point(origin), place.vector(dir));
        prop_assume!(ray.is_valid());
        let local = place.local_ray(&ray);
        let world = place.matrix().transform_point3(local.at(f64::from(t)));
        let direct = ray.origin.as_dvec3() + f64::from(t) * ray.dir.as_dvec3();
        let size = direct.length() + place.matrix().translation.length() + f64::from(t) * ray.dir.as_dvec3().length();
        prop_assert!(world.distance(direct) < 1e-13 * condition(&place) * size);
    }

    /// The box of an image holds the images.
    #[test]
    fn bounds_hold_the_image(place in transform(), a in point(), b in point(), s in [0.0_f32..=1.0, 0.0_f32..=1.0, 0.0_f32..=1.0]) {
        let bounds = Aabb::of_points([a, b]);
        let p = bounds.min + Vec3::from_array(s) * bounds.size();
        prop_assert!(place.bounds(bounds).contains(place.point(p.clamp(bounds.min, bounds.max))));
    }

    /// Composition is one map after the other, and a blend moves points on straight lines.
    #[test]
    fn maps_compose_and_blend(first in transform(), second in transform(), p in point(), weight in 0.0_f32..=1.0) {
        let exact = second.matrix().transform_point3(first.matrix().transform_point3(p.as_dvec3()));
        let both = first.then(&second).unwrap();
        prop_assert!(both.matrix().transform_point3(p.as_dvec3()).distance(exact) <= 1e-12 * (exact.length() + both.matrix().translation.length() + second.matrix().translation.length()));
        if let Some(between) = first.lerp(&second, weight) {
            let (a, b) = (first.matrix().transform_point3(p.as_dvec3()), second.matrix().transform_point3(p.as_dvec3()));
            let at = between.matrix().transform_point3(p.as_dvec3());
            prop_assert!(at.distance(a.lerp(b, weight.into())) <= 1e-12 * (a.length() + b.length() + 1e5));
        }
    }

    /// A mirror is told from a turn.
    #[test]
    fn mirrors_are_known(x in any::<bool>(), y in any::<bool>(), z in any::<bool>(), angles in point()) {
        let sign = |negative| if negative { -2.0 } else { 3.0 };
        let place = Transform::scaling(Vec3::new(sign(x), sign(y), sign(z))).unwrap();
        let turned = place.then(&Transform::rotation_xyz(angles)).unwrap();
        prop_assert_eq!(turned.is_mirror(), (u8::from(x) + u8::from(y) + u8::from(z)) % 2 == 1);
    }
}

#[test]
fn rotations_are_about_x_then_y_then_z() {
    let quarter = std::f32::consts::FRAC_PI_2;
    let turned = |angles: Vec3, p: Vec3| Transform::rotation_xyz(angles).point(p);
    let near = |a: Vec3, b: Vec3| assert!(a.distance(b) < 1e-6, "{a} {b}");
    near(turned(Vec3::new(quarter, 0.0, 0.0), Vec3::Y), Vec3::Z);
    near(turned(Vec3::new(0.0, quarter, 0.0), Vec3::Z), Vec3::X);
    near(turned(Vec3::new(0.0, 0.0, quarter), Vec3::X), Vec3::Y);
    // y goes to z by x, and z to x by y.
    near(turned(Vec3::new(quarter, quarter, 0.0), Vec3::Y), Vec3::X);
}

#[test]
fn places_look_where_they_are_told() {
    let (from, to) = (Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, 0.5, 10.0));
    let towards = (to - from).normalize();
    let camera = Transform::look_at(from, to, Vec3::Y).unwrap();
    assert!(camera.vector(Vec3::NEG_Z).distance(towards) < 1e-6);
    assert!(camera.vector(Vec3::Y).y > 0.0 && camera.vector(Vec3::X).y.abs() < 1e-6 && !camera.is_mirror());
    let light = Transform::face(from, to, Vec3::Y).unwrap();
    assert!(light.normal(Vec3::Y).distance(towards) < 1e-6);
    assert!(light.vector(Vec3::NEG_Z).y > 0.0 && light.vector(Vec3::X).y.abs() < 1e-6 && !light.is_mirror());
    assert_eq!(light.point(Vec3::ZERO), from);
    // Straight up with `up` upwards is allowed, and nowhere is not.
    let up = Transform::look_at(Vec3::ZERO, Vec3::Y, Vec3::Y).unwrap();
    assert!(up.vector(Vec3::NEG_Z).distance(Vec3::Y) < 1e-6);
    assert!(Transform::look_at(from, from, Vec3::Y).is_none());
}

#[test]
fn flat_and_infinite_maps_are_refused() {
    assert!(Transform::scaling(Vec3::new(1.0, 0.0, 1.0)).is_none());
    assert!(Transform::scaling(Vec3::new(1.0, f32::NAN, 1.0)).is_none());
    assert!(Transform::scaling(Vec3::new(1.0, f32::INFINITY, 1.0)).is_none());
    assert!(Transform::scaling(Vec3::ONE).unwrap().is_identity());
    let half_turn = Transform::rotation_xyz(Vec3::new(0.0, std::f32::consts::PI, 0.0));
    assert!(Transform::IDENTITY.lerp(&half_turn, 0.25).is_some());
}
