//! Triangles: ordinary and every bad kind.

use super::numbers::{hostile_float, point};
use glam::Vec3;
use proptest::prelude::*;

/// Three corners: ordinary, in an axis plane, slivers, needles, points, and corners of hostile numbers.
pub fn triangle() -> impl Strategy<Value = [Vec3; 3]> {
    let hostile = || (hostile_float(), hostile_float(), hostile_float()).prop_map(Vec3::from);
    prop_oneof![
        4 => [point(), point(), point()],
        2 => axis_aligned(),
        2 => sliver(),
        1 => (point(), point()).prop_map(|(a, b)| [a, b, b]),
        1 => (point(), point()).prop_map(|(a, b)| [a, b, 0.5 * (a + b)]),
        1 => point().prop_map(|a| [a; 3]),
        1 => [hostile(), hostile(), hostile()],
    ]
}

/// A triangle in a plane across an axis, which a splitting plane may hold.
fn axis_aligned() -> impl Strategy<Value = [Vec3; 3]> {
    ([point(), point(), point()], 0_usize..3, -4_i8..=4).prop_map(|(mut corners, axis, at)| {
        for corner in &mut corners {
            corner[axis] = f32::from(at);
        }
        corners
    })
}

/// A triangle far longer than wide.
fn sliver() -> impl Strategy<Value = [Vec3; 3]> {
    (point(), point(), point(), -7_i32..-1)
        .prop_map(|(a, b, off, e)| [a, b, a.lerp(b, 0.4) + 10.0_f32.powi(e) * off])
}
