//! Numbers, points and directions.

use glam::Vec3;
use proptest::prelude::*;

/// A number of everyday size, away from neither 0 nor whole numbers.
pub fn ordinary_float() -> impl Strategy<Value = f32> {
    prop_oneof![4 => -10.0_f32..10.0, 1 => (-4_i8..=4).prop_map(f32::from)]
}

/// A finite number of any kind: ordinary, whole, within 32 ulps of a whole number, tiny, huge, zero of both signs.
pub fn hostile_float() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => ordinary_float(),
        2 => (-4_i8..=4, -32_i8..=32).prop_map(|(whole, ulps)| nudged(f32::from(whole), ulps)),
        1 => Just(0.0_f32),
        1 => Just(-0.0_f32),
        1 => (-1.0_f32..1.0, -38_i32..-6).prop_map(|(m, e)| m * 10.0_f32.powi(e)),
        1 => (-1.0_f32..1.0, 6_i32..12).prop_map(|(m, e)| m * 10.0_f32.powi(e)),
    ]
}

/// `x` moved by some steps from one `f32` to the next.
fn nudged(x: f32, ulps: i8) -> f32 {
    (0..ulps.unsigned_abs()).fold(x, |x, _| if ulps < 0 { x.next_down() } else { x.next_up() })
}

/// A length above 0 from tiny to huge, mostly about 1.
pub fn extent() -> impl Strategy<Value = f32> {
    prop_oneof![4 => 0.1_f32..3.0, 1 => (1.0_f32..10.0, -4_i32..5).prop_map(|(m, e)| m * 10.0_f32.powi(e))]
}

/// The scales at which laws of geometry have to hold: powers of ten from 1e-3 to 1e5.
pub fn scale() -> impl Strategy<Value = f32> {
    (-3_i32..=5).prop_map(|e| 10.0_f32.powi(e))
}

/// A point of everyday size, often on an axis or an axis plane.
pub fn point() -> impl Strategy<Value = Vec3> {
    (ordinary_float(), ordinary_float(), ordinary_float(), 0_u8..16).prop_map(|(x, y, z, zeros)| {
        let keep = |bit: u8, v: f32| if zeros & 8 != 0 && zeros & bit != 0 { 0.0 } else { v };
        Vec3::new(keep(1, x), keep(2, y), keep(4, z))
    })
}

/// A direction that is not zero: random, parallel to an axis or an axis plane, or almost so; of any length.
pub fn direction() -> impl Strategy<Value = Vec3> {
    let random = (-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0).prop_map(Vec3::from);
    let axis = (0_usize..3, any::<bool>()).prop_map(|(axis, negative)| {
        let mut dir = Vec3::ZERO;
        dir[axis] = if negative { -1.0 } else { 1.0 };
        dir
    });
    let in_plane = (0_usize..3, random.clone()).prop_map(|(axis, mut dir)| {
        dir[axis] = 0.0;
        dir
    });
    let almost_axis =
        (axis.clone(), random.clone(), -12_i32..-2).prop_map(|(a, r, e)| a + r * 10.0_f32.powi(e));
    prop_oneof![4 => random, 2 => axis, 2 => in_plane, 1 => almost_axis]
        .prop_filter("a direction must not be zero", |dir| *dir != Vec3::ZERO)
        .prop_flat_map(|dir| prop_oneof![3 => Just(dir), 1 => scale().prop_map(move |s| dir * s)])
}
