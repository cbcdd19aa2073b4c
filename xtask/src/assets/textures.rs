//! Tileable textures from noise: wood, brick with its height, marble, studs as a normal map, and a chart that shows
//! orientation.

use super::noise::{fractal, hash};
use glam::{DVec3, IVec3, dvec3};
use image::{DynamicImage, Rgb, RgbImage};

/// Pixels along each side.
const SIZE: u32 = 512;

/// All textures with their file names.
pub(super) fn all() -> Vec<(&'static str, DynamicImage)> {
    vec![
        ("wood.png", picture(wood)),
        ("brick.png", picture(|u, v| brick(u, v).0)),
        (
            "brick_height.png",
            DynamicImage::ImageLuma8(picture(|u, v| DVec3::splat(brick(u, v).1)).to_luma8()),
        ),
        ("marble.png", picture(marble)),
        ("studs_normal.png", picture(studs)),
        ("chart.png", picture(chart)),
        ("rings.1001.png", picture(rings)),
        ("rings.1002.png", picture(|u, v| rings(u + 1.0, v))),
        ("rings.1011.png", picture(|u, v| rings(u, v + 1.0))),
        ("rings.1012.png", picture(|u, v| rings(u + 1.0, v + 1.0))),
    ]
}

/// An 8-bit image of a function of `(u, v)` in `[0, 1)`, `v` up; values are stored as they are.
fn picture(color: impl Fn(f64, f64) -> DVec3) -> DynamicImage {
    DynamicImage::ImageRgb8(RgbImage::from_fn(SIZE, SIZE, |x, y| {
        let at = |i: u32| (f64::from(i) + 0.5) / f64::from(SIZE);
        let c = color(at(x), 1.0 - at(y)).clamp(DVec3::ZERO, DVec3::ONE) * 255.0;
        Rgb(c.round().to_array().map(|v| v as u8))
    }))
}

/// Long boards with rings, seams and a little grain.
fn wood(u: f64, v: f64) -> DVec3 {
    let board = (v * 4.0).floor();
    let seed = hash(IVec3::new(board as i32, 7, 3));
    let stretched = dvec3(u * 4.0, v * 32.0, seed * 57.0);
    let warp = fractal(dvec3(u * 4.0, v * 8.0, board), 8, 3);
    let rings = 0.5 + 0.5 * ((v * 26.0 + warp * 3.0 + seed * 9.0) * std::f64::consts::TAU * 0.5).sin();
    let grain = 0.5 + 0.5 * fractal(dvec3(stretched.x * 2.0, stretched.y * 4.0, stretched.z), 128, 3);
    let light = dvec3(0.78, 0.57, 0.36);
    let dark = dvec3(0.50, 0.31, 0.17);
    let seam = (v * 4.0).fract().min(1.0 - (v * 4.0).fract());
    let tone = 0.82 + 0.28 * seed;
    let gap = 0.35 + 0.65 * (seam * 60.0).min(1.0);
    light.lerp(dark, 0.55 * rings + 0.35 * grain * rings) * tone * gap * (0.92 + 0.16 * grain)
}

/// Colour and height of a running bond: four bricks across, eight courses.
fn brick(u: f64, v: f64) -> (DVec3, f64) {
    let course = (v * 8.0).floor();
    let shift = if course as i64 % 2 == 0 { 0.0 } else { 0.5 };
    let column = (u * 4.0 + shift).floor().rem_euclid(4.0);
    let (x, y) = ((u * 4.0 + shift).fract(), (v * 8.0).fract());
    let rough = fractal(dvec3(u * 16.0, v * 16.0, 1.5), 16, 4);
    let edge = (x.min(1.0 - x) * 2.0).min(y.min(1.0 - y)) + 0.012 * rough;
    let solid = ((edge - 0.045) / 0.05).clamp(0.0, 1.0);
    let seed = hash(IVec3::new(column as i32, course as i32, 11));
    let clay = dvec3(0.62, 0.27, 0.19).lerp(dvec3(0.46, 0.19, 0.15), seed) * (0.95 + 0.22 * rough);
    let mortar = dvec3(0.68, 0.65, 0.60) * (0.95 + 0.15 * rough);
    (mortar.lerp(clay, solid), 0.25 + 0.6 * solid + 0.15 * rough * (0.4 + 0.6 * solid))
}

/// White stone with dark veins where folded noise crosses zero.
fn marble(u: f64, v: f64) -> DVec3 {
    let p = dvec3(u * 4.0, v * 4.0, 0.7);
    let fold = fractal(p, 4, 5);
    let vein = fractal(p + DVec3::splat(3.0) + 0.9 * fold, 4, 4).abs();
    let thin = (1.0 - vein * 9.0).clamp(0.0, 1.0).powi(2);
    let cloud = 0.5 + 0.5 * fold;
    dvec3(0.93, 0.92, 0.90)
        .lerp(dvec3(0.80, 0.80, 0.82), cloud * 0.6)
        .lerp(dvec3(0.30, 0.31, 0.36), thin * 0.85)
}

/// A tangent-space normal map of round studs, eight by eight.
fn studs(u: f64, v: f64) -> DVec3 {
    let (x, y) = ((u * 8.0).fract() * 2.0 - 1.0, (v * 8.0).fract() * 2.0 - 1.0);
    let r = x.hypot(y);
    // A dome of radius 0.8 that meets the plane at a slope of 1.
    let slope = if r < 0.8 { 1.2 * (r / 0.8).powi(2) } else { 0.0 };
    let n = if r > 0.0 { dvec3(x / r * slope, y / r * slope, 1.0).normalize() } else { DVec3::Z };
    0.5 * n + DVec3::splat(0.5)
}

/// Rings around the corner where four UDIM tiles meet; each tile has its own colour between them.
fn rings(u: f64, v: f64) -> DVec3 {
    let distance = (u - 1.0).hypot(v - 1.0);
    let tile = dvec3(0.35 + 0.5 * u.floor(), 0.75 - 0.45 * v.floor(), 0.30 + 0.4 * v.floor());
    if (distance * 8.0).fract() < 0.5 { tile } else { DVec3::splat(0.92) }
}

/// A checker of 8 by 8 whose corners differ: red grows with u, green with v; the lower left square is white.
fn chart(u: f64, v: f64) -> DVec3 {
    let (i, j) = ((u * 8.0) as i64, (v * 8.0) as i64);
    if (i, j) == (0, 0) {
        return DVec3::ONE;
    }
    let color = dvec3(0.15 + 0.8 * u, 0.15 + 0.8 * v, 0.35);
    if (i + j) % 2 == 0 { color } else { color * 0.45 + DVec3::splat(0.4) }
}
