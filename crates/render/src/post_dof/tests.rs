//! The blur against disks, edges and planes whose answer is known.

use super::*;
use glam::DAffine3;
use heliostat_scene::camera::{Camera, FocusMethod, Projection};
use heliostat_scene::motion::Motion;
use heliostat_scene::settings::PixelRect;

const WIDTH: u32 = 128;
const HEIGHT: u32 = 96;

/// With 96 pixels per unit of slope this lens blurs infinity by 4.8 pixels; the largest disk is 6.
const FOCUS: Focus =
    Focus { distance: 2.0, lens_radius: 0.1, blades: 0, blade_rotation: 0.0, method: FocusMethod::Post };

fn camera(focus: Focus) -> CameraRays {
    let camera = Camera {
        name: "test".into(),
        motion: Motion::still(DAffine3::IDENTITY),
        projection: Projection::Perspective { fov_y: 2.0 * 0.5_f32.atan() },
        focus: Some(focus),
    };
    CameraRays::new(&camera, WIDTH, HEIGHT)
}

fn raster<T>(pixel: impl Fn(u32, u32) -> T) -> Raster<T> {
    let window = PixelRect { x0: 0, y0: 0, x1: WIDTH, y1: HEIGHT };
    let pixels =
        (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect();
    Raster { window, pixels }
}

fn blurred(focus: Focus, rgba: &Raster<[f32; 4]>, depth: &Raster<f32>) -> Raster<[f32; 4]> {
    blur(rgba, depth, &camera(focus), &focus, HEIGHT)
}

fn at(picture: &Raster<[f32; 4]>, x: u32, y: u32) -> [f32; 4] {
    picture.pixels[(y * WIDTH + x) as usize]
}

/// Asserts that two pictures have the same bits, without printing thousands of pixels.
fn assert_same(found: &Raster<[f32; 4]>, want: &Raster<[f32; 4]>) {
    assert_eq!(found.window, want.window);
    for (i, (found, want)) in found.pixels.iter().zip(&want.pixels).enumerate() {
        assert_eq!(found, want, "pixel {i}");
    }
}

/// Something different in each pixel.
fn noise(x: u32, y: u32) -> [f32; 4] {
    let v = (x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(40_503)) % 1000;
    [v as f32 / 100.0, x as f32, y as f32, 1.0]
}

#[test]
fn a_wall_in_the_plane_of_focus_stays_the_same_bits_into_its_corners() {
    let sharp = raster(noise);
    // The perpendicular distance is the same all over; rounding of a real wall is a few ulps.
    let wall = raster(|x, y| if (x + y) % 3 == 0 { 2.0 } else { 2.0_f32.next_up() });
    assert_same(&blurred(FOCUS, &sharp, &wall), &sharp);
}

#[test]
fn a_point_becomes_the_disk_of_the_thin_lens_with_all_of_its_light() {
    for (depth, want_radius) in [(4.0, 2.4), (1.0, 4.8), (1e10, 4.8)] {
        let focus = FOCUS;
        let found = camera(focus).blur_radius(&focus, depth);
        // lens / distance * |1 - distance / depth| * pixels per slope.
        assert!((found - want_radius).abs() < 1e-4, "{depth}: {found}");
        let sharp = raster(|x, y| if (x, y) == (60, 50) { [100.0, 0.0, 0.0, 1.0] } else { [0.0; 4] });
        let picture = blurred(focus, &sharp, &raster(|_, _| depth as f32));
        let light: f64 = picture.pixels.iter().map(|p| f64::from(p[0])).sum();
        assert!((light - 100.0).abs() < 0.05, "{depth}: {light}");
        for y in 40..60 {
            for x in 50..70 {
                let distance = f64::from(x as f32 - 60.0).hypot(f64::from(y as f32 - 50.0));
                let value = at(&picture, x, y)[0];
                let inside = 100.0 / (std::f64::consts::PI * want_radius * want_radius);
                if distance <= want_radius - 0.51 {
                    assert!(
                        (f64::from(value) / inside - 1.0).abs() < 0.06,
                        "{depth} at {x},{y}: {value} {inside}"
                    );
                } else if distance >= want_radius + 0.51 {
                    assert_eq!(value, 0.0, "{depth} at {x},{y}");
                }
            }
        }
    }
}

/// Left of column 64 one colour and depth, from there another.
fn edge(left: f32, right: f32) -> (Raster<[f32; 4]>, Raster<f32>) {
    let colors = raster(|x, _| if x < 64 { [1.0, 0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0, 1.0] });
    (colors, raster(move |x, _| if x < 64 { left } else { right }))
}

#[test]
fn a_sharp_foreground_and_a_blurred_background_do_not_mix() {
    let (colors, depth) = edge(2.0, 1e10);
    assert_same(&blurred(FOCUS, &colors, &depth), &colors);
}

#[test]
fn a_blurred_foreground_reaches_over_a_sharp_background_as_a_half_covered_disk_does() {
    let (colors, depth) = edge(1.0, 2.0);
    let picture = blurred(FOCUS, &colors, &depth);
    // The share of a disk of radius r beyond a chord at distance d from its centre.
    let beyond = |d: f64, r: f64| {
        let c = (d / r).clamp(-1.0, 1.0);
        (c.acos() - c * (1.0 - c * c).sqrt()) / std::f64::consts::PI
    };
    for x in 50..80 {
        let pixel = at(&picture, x, 48);
        let want = beyond(f64::from(x) + 0.5 - 64.0, 4.8);
        assert!((f64::from(pixel[0]) - want).abs() < 0.03, "{x}: {} for {want}", pixel[0]);
        assert!((pixel[0] + pixel[1] - 1.0).abs() < 1e-4);
        assert_eq!(pixel[3], 1.0);
    }
}

#[test]
fn a_blurred_transparent_background_keeps_colour_premultiplied() {
    // An object out of focus before nothing: colour and alpha fade together.
    let colors = raster(|x, _| if x < 64 { [0.5, 0.5, 0.5, 1.0] } else { [0.0; 4] });
    let depth = raster(|x, _| if x < 64 { 1.0 } else { 1e10 });
    let picture = blurred(FOCUS, &colors, &depth);
    let mut fading = 0;
    for x in 0..WIDTH {
        let pixel = at(&picture, x, 48);
        assert!((pixel[0] - 0.5 * pixel[3]).abs() < 1e-5, "{x}: {pixel:?}");
        fading += u32::from(pixel[3] > 0.05 && pixel[3] < 0.95);
    }
    assert!((6..=10).contains(&fading), "the border of a disk of radius 4.8 is as wide: {fading}");
}

#[test]
fn an_even_picture_stays_even_whatever_its_depths() {
    let hilly = raster(|x, y| 0.5 + noise(x, y)[0]);
    for depth in [hilly, raster(|x, _| 0.3 + x as f32 / 20.0), raster(|_, y| if y < 40 { 1.0 } else { 1e10 })]
    {
        let picture = blurred(FOCUS, &raster(|_, _| [0.25, 0.5, 2.0, 1.0]), &depth);
        for pixel in picture.pixels {
            let error = (0..4).map(|c| (pixel[c] / [0.25, 0.5, 2.0, 1.0][c] - 1.0).abs()).fold(0.0, f32::max);
            assert!(error < 1e-4, "{pixel:?}");
        }
    }
}

#[test]
fn a_tilted_ground_is_a_mean_of_its_surroundings() {
    // A ramp of brightness over a ramp of depth: a symmetric disk keeps a linear ramp.
    let depth = raster(|_, y| 6.0 + y as f32 / 96.0);
    let picture = blurred(FOCUS, &raster(|_, y| [y as f32; 4]), &depth);
    for y in 10..80 {
        let value = at(&picture, 64, y)[0];
        assert!((value - y as f32).abs() < 0.3, "{y}: {value}");
    }
}

#[test]
fn blades_make_a_polygon_that_stands_on_its_head_before_the_focus() {
    let focus = Focus { blades: 3, blade_rotation: std::f32::consts::FRAC_PI_2, lens_radius: 0.125, ..FOCUS };
    let sharp = raster(|x, y| if (x, y) == (60, 50) { [100.0; 4] } else { [0.0; 4] });
    // A triangle with a corner up: its centre row is wide, its top row narrow, and it reaches twice as far up.
    let extent = |depth: f32| {
        let picture = blurred(focus, &sharp, &raster(|_, _| depth));
        let lit = |y: u32| (0..WIDTH).any(|x| at(&picture, x, y)[0] > 0.01);
        let up = (0..50).filter(|&y| lit(y)).count();
        let down = (51..HEIGHT).filter(|&y| lit(y)).count();
        (up, down)
    };
    let (far, near) = (extent(1e10), extent(1.0));
    assert_eq!(far, (near.1, near.0));
    assert!(far.0 >= far.1 + 2, "{far:?}");
}

#[test]
fn a_part_of_the_picture_with_its_margin_is_the_whole_picture_there() {
    let depth = raster(|x, y| 0.4 + ((x / 9 + y / 7) % 5) as f32);
    let whole = blurred(FOCUS, &raster(noise), &depth);
    let inner = PixelRect { x0: 40, y0: 33, x1: 70, y1: 51 };
    let m = margin(HEIGHT);
    let outer = PixelRect { x0: inner.x0 - m, y0: inner.y0 - m, x1: inner.x1 + m, y1: inner.y1 + m };
    let part = blur(&raster(noise).crop(outer), &depth.crop(outer), &camera(FOCUS), &FOCUS, HEIGHT);
    assert_same(&part.crop(inner), &whole.crop(inner));
}
