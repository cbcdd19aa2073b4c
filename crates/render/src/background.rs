//! What rays see that leave the scene.

use glam::{Quat, Vec2, Vec3};
use heliostat_scene::scene::Background;
use heliostat_scene::{Image, Rgb};
use std::f32::consts::{FRAC_1_PI, PI, TAU};

/// The radiance from the unit direction `dir`.
pub(crate) fn radiance(background: &Background, dir: Vec3) -> Rgb {
    match background {
        Background::Constant(color) => *color,
        Background::Gradient { top, horizon, bottom } => {
            let end = if dir.y >= 0.0 { top } else { bottom };
            horizon.lerp(*end, dir.y.abs())
        }
        Background::Image { image, intensity, rotation } => {
            *intensity * bilinear(image, equirectangular(dir, *rotation))
        }
        // Its table belongs to the lights: see `light::sky`.
        Background::Daylight(_) => Rgb::ZERO,
    }
}

/// Where a unit direction lies in an equirectangular image that is turned about y: the middle is `-z`, `+x` lies to the right of
/// it, up is 0.
pub(crate) fn equirectangular(dir: Vec3, rotation: f32) -> Vec2 {
    let dir = Quat::from_rotation_y(-rotation) * dir;
    let around = dir.x.atan2(-dir.z);
    Vec2::new(0.5 + around / TAU, dir.y.clamp(-1.0, 1.0).acos() * FRAC_1_PI)
}

/// The inverse of [`equirectangular`], and the sine of the angle between the direction and straight up.
pub(crate) fn direction(at: Vec2, rotation: f32) -> (Vec3, f32) {
    let (sin_around, cos_around) = (TAU * (at.x - 0.5)).sin_cos();
    let (sin, cos) = (PI * at.y).sin_cos();
    let dir = Vec3::new(sin * sin_around, cos, -sin * cos_around);
    (Quat::from_rotation_y(rotation) * dir, sin)
}

/// Linear between four pixels: wrapped in x, held at the poles.
fn bilinear(image: &Image, at: Vec2) -> Rgb {
    let (width, height) = (i64::from(image.width), i64::from(image.height));
    let (x, y) = (at.x * width as f32 - 0.5, at.y * height as f32 - 0.5);
    let (x0, y0) = (x.floor(), y.floor());
    let pixel = |dx: i64, dy: i64| {
        let column = (x0 as i64 + dx).rem_euclid(width) as u32;
        let row = (y0 as i64 + dy).clamp(0, height - 1) as u32;
        image.pixel(column, row).truncate()
    };
    let upper = pixel(0, 0).lerp(pixel(1, 0), x - x0);
    let lower = pixel(0, 1).lerp(pixel(1, 1), x - x0);
    upper.lerp(lower, y - y0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::image::{Encoding, Samples};
    use std::sync::Arc;

    #[test]
    fn gradient_runs_from_bottom_through_horizon_to_top() {
        let sky = Background::Gradient { top: Rgb::X, horizon: Rgb::Y, bottom: Rgb::Z };
        assert_eq!(radiance(&sky, Vec3::Y), Rgb::X);
        assert_eq!(radiance(&sky, Vec3::NEG_Z), Rgb::Y);
        assert_eq!(radiance(&sky, Vec3::NEG_Y), Rgb::Z);
        let between = radiance(&sky, Vec3::new(0.8, 0.6, 0.0));
        assert!(between.abs_diff_eq(Rgb::new(0.6, 0.4, 0.0), f32::EPSILON), "{between}");
    }

    /// Four columns, two rows: value = column + 10 row.
    fn image() -> Arc<Image> {
        let samples = Samples::F32(vec![0.0, 1.0, 2.0, 3.0, 10.0, 11.0, 12.0, 13.0]);
        Arc::new(Image::new(4, 2, 1, Encoding::Linear, samples))
    }

    /// The unit direction that an equirectangular image of 4 by 2 pixels shows at the centre of a pixel.
    fn centre(column: f32, row: f32) -> Vec3 {
        let (phi, theta) = ((column + 0.5) / 4.0 * TAU - PI, (row + 0.5) / 2.0 * PI);
        Vec3::new(theta.sin() * phi.sin(), theta.cos(), -theta.sin() * phi.cos())
    }

    #[test]
    fn image_pixels_lie_where_the_projection_puts_them() {
        let sky = Background::Image { image: image(), intensity: Rgb::ONE, rotation: 0.0 };
        for (row, column) in [(0, 0), (0, 1), (0, 3), (1, 0), (1, 2)] {
            let seen = radiance(&sky, centre(column as f32, row as f32)).x;
            let planted = (column + 10 * row) as f32;
            assert!((seen - planted).abs() < 1e-4, "column {column} row {row}: {seen}");
        }
    }

    #[test]
    fn a_quarter_turn_counter_clockwise_moves_the_middle_to_minus_x() {
        // Counter-clockwise seen from above takes -z to -x.
        let still = Background::Image { image: image(), intensity: Rgb::ONE, rotation: 0.0 };
        let turned = Background::Image { image: image(), intensity: Rgb::splat(2.0), rotation: 0.5 * PI };
        let before = radiance(&still, Vec3::new(0.1, 0.3, -1.0).normalize());
        let after = radiance(&turned, Vec3::new(-1.0, 0.3, -0.1).normalize());
        assert!((after - 2.0 * before).abs().max_element() < 1e-4, "{before} {after}");
    }
}
