//! Daylight is what is published of it.

use super::*;
use crate::sampler::Sampler;
use heliostat_geometry::warp::square_to_sphere;

fn day(elevation: f32, turbidity: f32) -> (DaySky, Option<SunDisk>) {
    let (sin, cos) = elevation.to_radians().sin_cos();
    daylight(&Daylight {
        to_sun: Vec3::new(0.6 * cos, sin, -0.8 * cos),
        turbidity,
        ground_albedo: Rgb::splat(0.2),
        intensity: Rgb::ONE,
        sun: 1.0,
    })
}

/// In kilolux.
fn klx(irradiance: Rgb) -> f32 {
    0.179 * luminance(irradiance)
}

#[test]
fn clear_sky_and_sun_throw_the_published_light() {
    // IES Lighting Handbook, daylight availability, at 60 degrees: 0.8 + 15.5 sin^0.5 = 15 klx from the clear sky on level
    // ground, 128 exp(-0.21 / sin) = 100 klx from the sun on a surface that faces it. Skies differ by half as much again.
    let (sky, sun) = day(60.0, 2.2);
    let (sky, sun) = (klx(sky.irradiance()), klx(sun.unwrap().irradiance()));
    assert!((10.0..23.0).contains(&sky), "sky {sky}");
    assert!((85.0..115.0).contains(&sun), "sun {sun}");
}

#[test]
fn twilight_is_as_dark_as_it_is() {
    // Published: some 400 lx at sunset give way to 3.4 lx at 6 degrees below the horizon.
    let dusk = 1000.0 * klx(day(-0.8, 2.5).0.irradiance());
    assert!((150.0..1500.0).contains(&dusk), "{dusk}");
    let civil = 1000.0 * klx(day(-6.0, 2.5).0.irradiance());
    assert!((0.5..12.0).contains(&civil), "{civil}");
}

#[test]
fn the_sky_is_blue_and_the_evening_red() {
    let up = day(50.0, 2.0).0.radiance(Vec3::Y);
    assert!(up.z > 1.5 * up.x && up.z > up.y, "{up}");
    let redness = |elevation| {
        let sun = day(elevation, 2.5).1.unwrap().irradiance();
        sun.x / sun.z
    };
    assert!(redness(2.0) > 4.0 * redness(60.0), "{} {}", redness(2.0), redness(60.0));
    // Low in the sky it is redder towards the sun than away from it.
    let (sky, _) = day(0.5, 2.5);
    let seen = |side: f32| sky.radiance(Vec3::new(0.6 * side, 0.05, -0.8 * side).normalize());
    assert!(seen(1.0).x / seen(1.0).z > seen(-1.0).x / seen(-1.0).z);
}

#[test]
fn haze_dims_the_sun_and_lights_the_sky() {
    let (clear, hazy) = (day(40.0, 2.0), day(40.0, 6.0));
    assert!(hazy.1.unwrap().brightness() < 0.8 * clear.1.unwrap().brightness());
    assert!(luminance(hazy.0.irradiance()) > luminance(clear.0.irradiance()));
}

#[test]
fn nothing_is_missing_at_any_height_of_the_sun() {
    for elevation in [-90.0, -18.0, -1.0, -0.2, 0.0, 30.0, 90.0] {
        let (sky, sun) = day(elevation, 3.0);
        for i in 0..500 {
            let mut draws = Sampler::new(4, [0, 0], i);
            let mut dir = square_to_sphere(draws.next_2d());
            if i % 3 == 0 {
                dir = Vec3::new(dir.x, 0.0, dir.z).normalize();
            }
            let seen = sky.radiance(dir);
            assert!(seen.is_finite() && seen.min_element() >= 0.0, "{elevation} {dir} {seen}");
            if let Some(sun) = &sun {
                let (dir, radiance, pdf) = sun.sample(draws.next_2d());
                assert!(
                    radiance.is_finite() && radiance.min_element() >= 0.0 && pdf > 0.0,
                    "{elevation} {dir}"
                );
            }
        }
        assert_eq!(sun.is_some(), elevation > -0.26, "{elevation}");
    }
}

#[test]
fn samples_of_the_disc_are_what_rays_see_and_add_up_to_its_light() {
    let (_, sun) = day(35.0, 2.5);
    let sun = sun.unwrap();
    let (mut sum, count) = (Rgb::ZERO, 4096);
    for i in 0..count {
        let (dir, radiance, pdf) = sun.sample(Sampler::new(1, [0, 0], i).next_2d());
        // A rounding of the direction may step over the rim, where it is dark.
        if let Some(seen) = sun.seen(dir) {
            assert_eq!(seen, (radiance, pdf));
        }
        sum += radiance / (pdf * count as f32);
    }
    assert!((sum / sun.irradiance() - 1.0).abs().max_element() < 0.01, "{sum} {}", sun.irradiance());
}
