//! AgX, the picture formation of Troy Sobotka, in the version that Blender uses.
//!
//! In Rec.2020 the primaries are moved inwards and turned (the inset), each channel goes through a sigmoid over its
//! logarithm, and the outset undoes part of the inset. Left out of Blender's version: its guard rails (light outside
//! Rec.709 is clipped) and the mixing of 60 % of the hue from before the curve.
//!
//! # Source
//! T. Sobotka, "SB2383-Configuration-Generation" (method, curve); E. Chow, `AgX_LUT_Gen`, `AgXBaseRec2020.py`
//! (matrices, slope 2.4, powers 1.5, -10 to +6.5 stops around 0.18); the matrices between the two sets of primaries are
//! those of ITU-R BT.2087-0.

use glam::{Mat3, Vec3};
use std::sync::LazyLock;

const REC709_TO_REC2020: Mat3 = Mat3::from_cols(
    Vec3::new(0.627_403_9, 0.069_097_29, 0.016_391_44),
    Vec3::new(0.329_283_04, 0.919_540_4, 0.088_013_31),
    Vec3::new(0.043_313_067, 0.011_362_316, 0.895_595_25),
);

const REC2020_TO_REC709: Mat3 = Mat3::from_cols(
    Vec3::new(1.660_491, -0.124_550_47, -0.018_150_763),
    Vec3::new(-0.587_641_1, 1.132_899_9, -0.100_578_9),
    Vec3::new(-0.072_849_86, -0.008_349_423, 1.118_729_7),
);

const INSET: Mat3 = Mat3::from_cols(
    Vec3::new(0.856_627_15, 0.137_318_97, 0.111_898_21),
    Vec3::new(0.095_121_24, 0.761_242, 0.076_799_415),
    Vec3::new(0.048_251_607, 0.101_439_04, 0.811_302_36),
);

const OUTSET: Mat3 = Mat3::from_cols(
    Vec3::new(1.127_100_6, -0.141_329_76, -0.141_329_76),
    Vec3::new(-0.110_606_64, 1.157_823_7, -0.110_606_64),
    Vec3::new(-0.016_493_939, -0.016_493_939, 1.251_936_4),
);

const MID_GREY: f32 = 0.18;
/// Darkest stop below mid-grey.
const STOPS_BELOW: f32 = 10.0;
/// Brightest stop above mid-grey.
const STOPS_ABOVE: f32 = 6.5;
/// Steepness of the curve at mid-grey, and the power that its output is encoded with.
const SLOPE: f32 = 2.4;
/// How suddenly the curve bends into toe and shoulder.
const POWER: f32 = 1.5;

/// The sigmoid: a straight line through the pivot that bends to 0 on the left and to 1 on the right.
struct Sigmoid {
    pivot: [f32; 2],
    /// Length over which the toe bends.
    toe: f32,
    /// Length over which the shoulder bends.
    shoulder: f32,
}

static SIGMOID: LazyLock<Sigmoid> = LazyLock::new(|| {
    let [x, y] = [STOPS_BELOW / (STOPS_BELOW + STOPS_ABOVE), MID_GREY.powf(1.0 / SLOPE)];
    Sigmoid { pivot: [x, y], toe: bend(x, y), shoulder: bend(1.0 - x, 1.0 - y) }
});

/// The length that lets a half of the curve end exactly at `width`, `height` from the pivot.
fn bend(width: f32, height: f32) -> f32 {
    let straight = (SLOPE * width).powf(-POWER);
    let excess = (SLOPE * width / height).powf(POWER) - 1.0;
    (straight * excess).powf(-1.0 / POWER)
}

impl Sigmoid {
    fn at(&self, x: f32) -> f32 {
        let [px, py] = self.pivot;
        let length = if x < px { -self.toe } else { self.shoulder };
        let t = SLOPE * (x - px) / length;
        py + length * t / (1.0 + t.powf(POWER)).powf(1.0 / POWER)
    }
}

/// Linear light (not negative) to linear display light, not yet clipped.
pub(super) fn form(light: Vec3) -> Vec3 {
    let inset = INSET * (REC709_TO_REC2020 * light);
    let formed = inset.to_array().map(|v| {
        let stops = (v.max(f32::MIN_POSITIVE) / MID_GREY).log2();
        let x = (stops + STOPS_BELOW) / (STOPS_BELOW + STOPS_ABOVE);
        SIGMOID.at(x.clamp(0.0, 1.0)).max(0.0).powf(SLOPE)
    });
    REC2020_TO_REC709 * (OUTSET * Vec3::from_array(formed))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_the_one_others_derived() {
        // A. Pestaluky's port "earychow-agx-simplified.glsl" writes the same curve as
        // y + 2.4 (x - px) / (1 + k |a x + b|^1.5)^(2/3), with these k and a for the two halves.
        let k = 0.019_613_087_f32.powf(1.0 / POWER);
        assert!((SIGMOID.toe - SLOPE / (58.337_322 * k)).abs() < 1e-5, "{}", SIGMOID.toe);
        assert!((SIGMOID.shoulder - SLOPE / (46.141_05 * k)).abs() < 1e-5, "{}", SIGMOID.shoulder);
    }

    #[test]
    fn the_matrices_keep_white_and_undo_each_other() {
        for white in [REC709_TO_REC2020, REC2020_TO_REC709, INSET, OUTSET].map(|m| m * Vec3::ONE) {
            assert!((white - 1.0).abs().max_element() < 1e-6, "{white}");
        }
        let there_and_back = REC2020_TO_REC709 * REC709_TO_REC2020;
        assert!(there_and_back.abs_diff_eq(Mat3::IDENTITY, 1e-6), "{there_and_back}");
    }
}
