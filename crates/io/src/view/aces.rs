//! The ACES look: Stephen Hill's fit of the reference rendering and output device transforms for an sRGB display.
//!
//! The light goes in as it is: some programs divide by 0.6 first to look as bright as an older fit; the reference
//! itself shows mid-grey 0.18 as 0.1 of white (4.8 of 48 nits).
//!
//! # Source
//! Stephen Hill's fit as published in M. Pettineo, D. Neubelt, "Baking Lab", `ACES.hlsl` (MIT).

use glam::{Mat3, Vec3};

/// sRGB to the ACES rendering space AP1, with the desaturation of the reference rendering transform.
const INPUT: Mat3 = Mat3::from_cols(
    Vec3::new(0.59719, 0.07600, 0.02840),
    Vec3::new(0.35458, 0.90834, 0.13383),
    Vec3::new(0.04823, 0.01566, 0.83777),
);

/// With the desaturation of the output transform, from AP1 to sRGB.
const OUTPUT: Mat3 = Mat3::from_cols(
    Vec3::new(1.60475, -0.10208, -0.00327),
    Vec3::new(-0.53108, 1.10813, -0.07276),
    Vec3::new(-0.07367, -0.00605, 1.07602),
);

/// Linear light (not negative) to linear display light, not yet clipped.
pub(super) fn form(light: Vec3) -> Vec3 {
    let v = INPUT * light;
    let a = v * (v + 0.024_578_6) - 0.000_090_537;
    let b = v * (0.983_729 * v + 0.432_951) + 0.238_081;
    OUTPUT * (a / b)
}
