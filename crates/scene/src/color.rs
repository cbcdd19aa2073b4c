//! Linear Rec.709 colour and the sRGB transfer function.

use glam::Vec3;

/// Linear Rec.709 red, green and blue; unbounded above.
pub type Rgb = Vec3;

/// Relative luminance of a linear Rec.709 colour.
///
/// # Source
/// ITU-R BT.709-6, section 3.
pub fn luminance(c: Rgb) -> f32 {
    c.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// From an sRGB value in `[0, 1]` to linear light.
///
/// # Source
/// IEC 61966-2-1.
pub fn srgb_to_linear(v: f32) -> f32 {
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// From linear light to an sRGB value; monotone above 1, odd below 0.
///
/// # Source
/// IEC 61966-2-1.
pub fn linear_to_srgb(v: f32) -> f32 {
    let a = v.abs();
    let encoded = if a <= 0.003_130_8 { 12.92 * a } else { 1.055 * a.powf(1.0 / 2.4) - 0.055 };
    encoded.copysign(v)
}
