//! Files with other primaries than Rec.709: their colour layers are brought to Rec.709 when read.
//!
//! A different white point is adapted with the Bradford method, except for files in CIE XYZ itself (primaries at
//! (1, 0), (0, 1), (0, 0)), whose numbers are absolute.
//!
//! # Source
//! SMPTE RP 177 (matrix from chromaticities); ICC.1:2022, annex E (Bradford adaptation); ITU-R BT.709-6 (primaries).

use super::header::{Cursor, Part};
use glam::{DMat3, DVec2, DVec3};
use heliostat_scene::frame::{Frame, Meta};
use std::collections::BTreeSet;

/// Red, green, blue and white in the CIE 1931 diagram.
type Chromaticities = [DVec2; 4];

const REC709: Chromaticities =
    [DVec2::new(0.64, 0.33), DVec2::new(0.3, 0.6), DVec2::new(0.15, 0.06), DVec2::new(0.3127, 0.329)];

const XYZ_PRIMARIES: [DVec2; 3] = [DVec2::new(1.0, 0.0), DVec2::new(0.0, 1.0), DVec2::new(0.0, 0.0)];

/// From XYZ to sharpened cone responses, column by column.
const BRADFORD: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);

/// The value to be written: Rec.709.
pub(super) fn rec709_bytes() -> Vec<u8> {
    REC709.iter().flat_map(|c| [c.x as f32, c.y as f32]).flat_map(f32::to_le_bytes).collect()
}

/// Converts the colour layers of a frame just read from a file with this header.
pub(super) fn to_rec709(part: &Part<'_>, frame: &mut Frame) -> Result<(), String> {
    let Some(value) = part.value("chromaticities", "chromaticities") else { return Ok(()) };
    if value == rec709_bytes() {
        return Ok(());
    }
    let matrix = parse(value).and_then(|from| conversion(&from)).ok_or("has impossible chromaticities")?;
    for layer in color_layers(frame) {
        convert(frame, &layer, matrix);
    }
    Ok(())
}

fn parse(value: &[u8]) -> Option<Chromaticities> {
    let mut cursor = Cursor::new(value);
    let mut number = || cursor.array().ok().map(f32::from_le_bytes).map(f64::from);
    let mut chromaticities = Chromaticities::default();
    for c in &mut chromaticities {
        *c = DVec2::new(number()?, number()?);
    }
    Some(chromaticities)
}

/// XYZ of a chromaticity with Y = 1.
fn xyz(c: DVec2) -> DVec3 {
    DVec3::new(c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y)
}

/// The matrix from RGB to XYZ that sends (1, 1, 1) to white.
fn to_xyz([red, green, blue, white]: &Chromaticities) -> DMat3 {
    let column = |c: &DVec2| DVec3::new(c.x, c.y, 1.0 - c.x - c.y);
    let primaries = DMat3::from_cols(column(red), column(green), column(blue));
    primaries * DMat3::from_diagonal(primaries.inverse() * xyz(*white))
}

/// The matrix to linear Rec.709; nothing where the primaries lie on a line.
fn conversion(from: &Chromaticities) -> Option<DMat3> {
    let to_rec709 = to_xyz(&REC709).inverse();
    let matrix = if from[..3] == XYZ_PRIMARIES {
        to_rec709
    } else {
        let cones = |white: DVec2| BRADFORD * xyz(white);
        let adaptation = DMat3::from_diagonal(cones(REC709[3]) / cones(from[3]));
        to_rec709 * BRADFORD.inverse() * adaptation * BRADFORD * to_xyz(from)
    };
    matrix.is_finite().then_some(matrix)
}

/// Prefixes (`""` or `layer.`) of the layers with channels R, G and B, without those that hold Cryptomatte ids.
fn color_layers(frame: &Frame) -> BTreeSet<String> {
    let is_id_name = |(key, meta): (&String, &Meta)| match meta {
        Meta::Text(name) if key.starts_with("cryptomatte/") && key.ends_with("/name") => Some(name.clone()),
        _ => None,
    };
    let id_names: Vec<_> = frame.meta.iter().filter_map(is_id_name).collect();
    let reds = frame.channels.iter().filter_map(|c| c.name.strip_suffix('R'));
    reds.filter(|prefix| prefix.is_empty() || prefix.ends_with('.'))
        .filter(|prefix| ["G", "B"].iter().all(|c| frame.channel(&format!("{prefix}{c}")).is_some()))
        .filter(|prefix| !id_names.iter().any(|name| prefix.starts_with(name.as_str())))
        .map(str::to_owned)
        .collect()
}

fn convert(frame: &mut Frame, prefix: &str, matrix: DMat3) {
    let index = |c: &str| frame.channels.iter().position(|channel| channel.name == format!("{prefix}{c}"));
    let (Some(r), Some(g), Some(b)) = (index("R"), index("G"), index("B")) else { return };
    for i in 0..frame.pixel_count() {
        let stored = [r, g, b].map(|c| f64::from(frame.channels[c].values[i]));
        let converted = matrix * DVec3::from_array(stored);
        for (c, v) in [r, g, b].into_iter().zip(converted.to_array()) {
            frame.channels[c].values[i] = v as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rec709_has_the_matrix_of_srgb() {
        // IEC 61966-2-1, row by row.
        let published = DMat3::from_cols(
            DVec3::new(0.4124, 0.2126, 0.0193),
            DVec3::new(0.3576, 0.7152, 0.1192),
            DVec3::new(0.1805, 0.0722, 0.9505),
        );
        assert!(to_xyz(&REC709).abs_diff_eq(published, 2e-4), "{}", to_xyz(&REC709));
    }

    #[test]
    fn acescg_becomes_rec709_as_published() {
        let ap1 = [(0.713, 0.293), (0.165, 0.83), (0.128, 0.044), (0.32168, 0.33767)].map(DVec2::from);
        let matrix = conversion(&ap1).unwrap();
        // The matrix that compositing programs list for ACEScg to linear sRGB (Bradford).
        let published = DMat3::from_cols(
            DVec3::new(1.705_05, -0.130_26, -0.024_00),
            DVec3::new(-0.621_79, 1.140_80, -0.128_97),
            DVec3::new(-0.083_26, -0.010_55, 1.152_97),
        );
        assert!(matrix.abs_diff_eq(published, 1e-3), "{matrix}");
        assert!((matrix * DVec3::ONE - 1.0).abs().max_element() < 1e-9);
    }

    #[test]
    fn primaries_on_a_line_are_refused() {
        let line = [(0.1, 0.1), (0.2, 0.2), (0.3, 0.3), (0.3, 0.3)].map(DVec2::from);
        assert!(conversion(&line).is_none());
        assert!(conversion(&[(0.64, 0.33), (0.3, 0.6), (0.15, 0.06), (0.3, 0.0)].map(DVec2::from)).is_none());
    }
}
