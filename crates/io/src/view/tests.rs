//! Views against published values and laws.

use super::*;
use glam::Vec3;
use heliostat_scene::color::srgb_to_linear;

fn show(transform: ViewTransform, light: Vec3) -> Vec3 {
    View { transform, exposure: 0.0 }.apply(light)
}

/// Linear display light of a grey.
fn grey(transform: ViewTransform, light: f32) -> f32 {
    srgb_to_linear(show(transform, Vec3::splat(light)).x)
}

#[test]
fn standard_is_the_srgb_transfer_function() {
    // IEC 61966-2-1: linear 0.214041 is sRGB 0.5.
    let shown = show(ViewTransform::Standard, Vec3::new(0.214_041, 1.5, -3.0));
    assert!((shown - Vec3::new(0.5, 1.0, 0.0)).abs().max_element() < 1e-5, "{shown}");
}

#[test]
fn exposure_counts_stops() {
    for transform in ViewTransform::ALL {
        let light = Vec3::new(0.3, 0.1, 0.05);
        let brighter = View { transform, exposure: 2.0 }.apply(light);
        assert_eq!(brighter, show(transform, 4.0 * light));
    }
}

#[test]
fn greys_stay_grey_and_grow() {
    for transform in ViewTransform::ALL {
        let mut last = -1.0;
        for i in 0..=400 {
            let light = 0.18 * f32::exp2(i as f32 / 20.0 - 12.0);
            let shown = show(transform, Vec3::splat(light));
            assert!(shown.max_element() - shown.min_element() < 5e-4, "{transform:?} {light}: {shown}");
            assert!(shown.y >= last, "{transform:?} falls at {light}");
            last = shown.y;
        }
    }
}

#[test]
fn everything_lands_on_the_display() {
    let values =
        [f32::NEG_INFINITY, -1.0, 0.0, f32::MIN_POSITIVE, 0.2, 1.0, 70.0, 1e30, f32::INFINITY, f32::NAN];
    for transform in ViewTransform::ALL {
        for exposure in [-1000.0, 0.0, 1000.0] {
            for light in
                values.iter().flat_map(|&r| values.map(|g| values.map(|b| Vec3::new(r, g, b)))).flatten()
            {
                let shown = View { transform, exposure }.apply(light);
                assert!(shown.cmpge(Vec3::ZERO).all() && shown.cmple(Vec3::ONE).all(), "{light}: {shown}");
            }
        }
    }
}

#[test]
fn black_is_black_and_the_sun_is_white() {
    for transform in ViewTransform::ALL {
        assert!(show(transform, Vec3::ZERO).max_element() < 1e-3, "{transform:?}");
        assert!(show(transform, Vec3::splat(1e4)).min_element() > 0.99, "{transform:?}");
    }
}

#[test]
fn agx_keeps_mid_grey_and_ends_at_six_and_a_half_stops() {
    // The pivot of the curve is 0.18 on both axes (AgXBaseRec2020.py).
    assert!((grey(ViewTransform::Agx, 0.18) - 0.18).abs() < 1e-4);
    assert!((grey(ViewTransform::Agx, 0.18 * 6.5_f32.exp2()) - 1.0).abs() < 1e-4);
    assert!(grey(ViewTransform::Agx, 0.18 * 6.0_f32.exp2()) < 0.999);
    assert!(grey(ViewTransform::Agx, 0.18 * (-10.0_f32).exp2()) < 1e-4);
}

#[test]
fn agx_is_as_steep_as_published_around_mid_grey() {
    // One stop is 1/16.5 of the axis, the slope is 2.4: encoded in power 2.4, near the pivot the curve is straight.
    let encoded = |stops: f32| grey(ViewTransform::Agx, 0.18 * stops.exp2()).powf(1.0 / 2.4);
    let slope = (encoded(0.05) - encoded(-0.05)) / (0.1 / 16.5);
    assert!((slope - 2.4).abs() < 0.02, "{slope}");
}

#[test]
fn agx_shows_bright_saturated_light_as_pale() {
    let shown = show(ViewTransform::Agx, Vec3::new(0.0, 0.0, 50.0));
    assert!(shown.min_element() > 0.5, "{shown}");
}

#[test]
fn aces_shows_mid_grey_as_a_tenth() {
    // The reference shows 0.18 at 4.8 of 48 nits; the fit is known to be within a few per cent.
    let shown = grey(ViewTransform::Aces, 0.18);
    assert!((shown - 0.1).abs() < 0.008, "{shown}");
}

#[test]
fn neutral_shows_authored_colours_until_compression() {
    // The specification: under a white light a base colour c leaves as c, once 0.04 of reflection is added to it.
    for c in [Vec3::new(0.7, 0.3, 0.1), Vec3::new(0.05, 0.5, 0.7), Vec3::splat(0.4)] {
        let shown = show(ViewTransform::Neutral, c + 0.04);
        let back = Vec3::from_array(shown.to_array().map(srgb_to_linear));
        assert!((back - c).abs().max_element() < 1e-5, "{c}: {back}");
    }
}

#[test]
fn neutral_compresses_as_the_formula_says() {
    // Grey 1.04: peak 1, so the new peak is 1 - 0.24^2 / (1 + 0.24 - 0.76) = 0.88.
    assert!((grey(ViewTransform::Neutral, 1.04) - 0.88).abs() < 1e-5);
    // Red 3 with darkest 0: offset 0, new peak 1 - 0.0576 / 2.48 = 0.976774; whiteness 1 - 1 / (1 + 0.15 * 2.023226).
    let shown = show(ViewTransform::Neutral, Vec3::new(3.0, 0.0, 0.0));
    let back = Vec3::from_array(shown.to_array().map(srgb_to_linear));
    let whiteness = 1.0 - 1.0 / (1.0 + 0.15 * 2.023_226);
    assert!((back.x - 0.976_774).abs() < 1e-5 && (back.y - 0.976_774 * whiteness).abs() < 1e-5, "{back}");
}

#[test]
fn names_are_read_back() {
    for transform in ViewTransform::ALL {
        assert_eq!(transform.name().parse(), Ok(transform));
    }
    assert!("filmic".parse::<ViewTransform>().unwrap_err().contains("standard, agx, aces, neutral"));
}
