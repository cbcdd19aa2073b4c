//! Colour spaces of FLIP: the opponent space `YCxCz` and L*a*b* with Hunt's adjustment, both for white D65.
//!
//! # Source
//! HPG 2020, sections 4.1.1 and 4.1.2; IEC 61966-2-1 (primaries); CIE 15 (L*a*b*).

use glam::{Mat3, Vec3};
use std::sync::LazyLock;

/// Linear sRGB to XYZ.
const TO_XYZ: Mat3 = Mat3::from_cols(
    Vec3::new(10_135_552.0 / 24_577_794.0, 2_613_072.0 / 12_288_897.0, 1_425_312.0 / 73_733_382.0),
    Vec3::new(8_788_810.0 / 24_577_794.0, 8_788_810.0 / 12_288_897.0, 8_788_810.0 / 73_733_382.0),
    Vec3::new(4_435_075.0 / 24_577_794.0, 887_015.0 / 12_288_897.0, 70_074_185.0 / 73_733_382.0),
);

/// XYZ of white: the sums of the rows.
const WHITE: Vec3 = Vec3::new(0.950_428_55, 1.0, 1.088_900_4);

static FROM_XYZ: LazyLock<Mat3> = LazyLock::new(|| TO_XYZ.inverse());

/// `YCxCz` of linear light.
pub(super) fn opponent(light: Vec3) -> Vec3 {
    let v = TO_XYZ * light / WHITE;
    Vec3::new(116.0 * v.y - 16.0, 500.0 * (v.x - v.y), 200.0 * (v.y - v.z))
}

/// Linear light of `YCxCz`.
pub(super) fn unopponent(c: Vec3) -> Vec3 {
    let y = (c.x + 16.0) / 116.0;
    *FROM_XYZ * (Vec3::new(y + c.y / 500.0, y, y - c.z / 200.0) * WHITE)
}

/// L*a*b* of linear light; chroma counts less in the dark (Hunt's effect).
pub(super) fn hunt_lab(light: Vec3) -> Vec3 {
    const DELTA: f32 = 6.0 / 29.0;
    let root = |v: f32| {
        if v > DELTA * DELTA * DELTA { v.cbrt() } else { v / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
    };
    let v = Vec3::from_array((TO_XYZ * light / WHITE).to_array().map(root));
    let lightness = 116.0 * v.y - 16.0;
    let chroma = 0.01 * lightness;
    Vec3::new(lightness, chroma * 500.0 * (v.x - v.y), chroma * 200.0 * (v.y - v.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_grey_have_no_chroma() {
        assert!((hunt_lab(Vec3::ONE) - Vec3::new(100.0, 0.0, 0.0)).abs().max_element() < 1e-3);
        assert!((opponent(Vec3::ONE) - Vec3::new(100.0, 0.0, 0.0)).abs().max_element() < 1e-3);
        // CIE 15: Y = 0.18418 is L* = 50.
        assert!((hunt_lab(Vec3::splat(0.184_187)).x - 50.0).abs() < 1e-3);
    }

    #[test]
    fn the_opponent_space_is_undone() {
        for light in [Vec3::ZERO, Vec3::X, Vec3::new(0.2, 0.9, 0.4)] {
            assert!((unopponent(opponent(light)) - light).abs().max_element() < 1e-5, "{light}");
        }
    }
}
