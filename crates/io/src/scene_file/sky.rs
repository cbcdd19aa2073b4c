//! `sky = { .. }` of `[environment]`: the sky and the sun of a clear day.
//!
//! Radiance is in W/(m² sr) of white light: 1 W are 179 lumens, as in Radiance. A noon sun throws some 500 W/m², so pictures
//! want an `exposure` of about -6; `intensity = 0.02` does the same to the light.
//!
//! # Scene file
//! ```toml
//! [environment.sky]
//! elevation = 20                 # of the sun above the horizon, degrees
//! azimuth = 120                  # of the sun, degrees from north, -z, by way of east, +x; 180 if left out
//! # in place of both, where and when; north is -z:
//! # time = "2026-06-21T20:15:00+02:00"
//! # latitude = 52.5              # degrees, north is above 0
//! # longitude = 13.4             # degrees, east is above 0
//! turbidity = 3                  # 1 air without haze, 2 very clear, 3 clear, 6 hazy, 10 thick haze
//! ground_albedo = 0.2            # share of the light that the ground sends back
//! sun = 1                        # factor of the disc of the sun; 0 leaves the sky alone
//! ```

use super::choice::{choice, exactly_one, without_effect};
use super::number::{NonNegative, Number};
use super::value::Color;
use crate::document::{Fault, Placed};
use glam::DVec3;
use heliostat_scene::Rgb;
use heliostat_scene::scene::Daylight;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the air is like where nothing is said.
const TURBIDITY: f64 = 3.0;
const ALBEDO: f32 = 0.2;
const AZIMUTH: f64 = 180.0;
const MOST_TURBID: f64 = 32.0;

/// The sky and the sun of a clear day.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SkyTable {
    /// Degrees of the sun above the horizon; below 0 it is twilight.
    pub elevation: Option<Placed<Number>>,
    /// Degrees of the sun from north, -z, by way of east, +x; 180 if left out.
    pub azimuth: Option<Placed<Number>>,
    /// Date, time and offset from UTC, as in `2026-06-21T20:15:00+02:00`.
    pub time: Option<Placed<String>>,
    /// Degrees, north is above 0.
    pub latitude: Option<Placed<Number>>,
    /// Degrees, east is above 0.
    pub longitude: Option<Placed<Number>>,
    /// From 1, air without haze, to 32; 3 if left out.
    pub turbidity: Option<Placed<Number>>,
    /// Share of the light that the ground sends back, a number or a colour up to 1; 0.2 if left out.
    pub ground_albedo: Option<Placed<Color>>,
    /// Factor of the disc of the sun; 1 if left out, 0 leaves the sky alone.
    pub sun: Option<NonNegative>,
}

impl Placed<SkyTable> {
    /// The moment, with `intensity` as the factor of its light.
    ///
    /// # Errors
    /// When the sun has no place, or two, or values are out of range.
    pub(super) fn daylight(&self, intensity: Rgb) -> Result<Daylight, Fault> {
        let places = [choice("elevation", self.elevation.as_ref()), choice("time", self.time.as_ref())];
        exactly_one("the sky", "sun", self.span(), &places)?;
        let to_sun = match &self.time {
            Some(time) => self.by_time(time)?,
            None => self.by_angles()?,
        };
        let albedo = self.ground_albedo.as_deref().map_or(Rgb::splat(ALBEDO), Color::rgb);
        if albedo.max_element() > 1.0 {
            return Err(Fault::new("`ground_albedo` must not be above 1")
                .with_help("the ground sends back a share of the light")
                .or_at(self.ground_albedo.as_ref().and_then(Placed::span)));
        }
        let turbidity = self.within("turbidity", self.turbidity.as_ref(), TURBIDITY, 1.0, MOST_TURBID)?;
        Ok(Daylight {
            to_sun: to_sun.as_vec3(),
            turbidity: turbidity as f32,
            ground_albedo: albedo,
            intensity,
            sun: self.sun.map_or(1.0, NonNegative::f32),
        })
    }

    fn by_angles(&self) -> Result<DVec3, Fault> {
        let unused =
            [choice("latitude", self.latitude.as_ref()), choice("longitude", self.longitude.as_ref())];
        without_effect("without `time`", &unused)?;
        let elevation = self.within("elevation", self.elevation.as_ref(), 0.0, -90.0, 90.0)?;
        let azimuth = self.azimuth.as_ref().map_or(AZIMUTH, |azimuth| azimuth.get());
        Ok(direction(elevation, azimuth))
    }

    fn by_time(&self, time: &Placed<String>) -> Result<DVec3, Fault> {
        without_effect("beside `time`", &[choice("azimuth", self.azimuth.as_ref())])?;
        let days = days_since_2000(time).ok_or_else(|| {
            Fault::new("the time is not one that is understood")
                .with_help("write it as in \"2026-06-21T20:15:00+02:00\"; end with Z for UTC")
                .or_at(time.span())
        })?;
        let (Some(latitude), Some(longitude)) = (&self.latitude, &self.longitude) else {
            return Err(Fault::new("`time` needs `latitude` and `longitude`")
                .with_help("say where the sky is seen, in degrees")
                .or_at(time.span()));
        };
        let latitude = self.within("latitude", Some(latitude), 0.0, -90.0, 90.0)?;
        let longitude = self.within("longitude", Some(longitude), 0.0, -180.0, 180.0)?;
        let (elevation, azimuth) = sun_at(days, latitude, longitude);
        Ok(direction(elevation, azimuth))
    }

    fn within(
        &self,
        key: &str,
        value: Option<&Placed<Number>>,
        default: f64,
        least: f64,
        most: f64,
    ) -> Result<f64, Fault> {
        let Some(value) = value else { return Ok(default) };
        if (least..=most).contains(&value.get()) {
            return Ok(value.get());
        }
        Err(Fault::new(format!("`{key}` lies outside its range"))
            .with_help(format!("choose a number from {least} to {most}"))
            .or_at(value.span()))
    }
}

/// The unit direction of a place in the sky, in degrees.
fn direction(elevation: f64, azimuth: f64) -> DVec3 {
    let ((sin, cos), (east, north)) = (elevation.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
    DVec3::new(cos * east, sin, -cos * north)
}

/// Days from noon of 1 January 2000, UTC, to a time as in RFC 3339; `None` where it is not one.
fn days_since_2000(time: &str) -> Option<f64> {
    let digits = |range: std::ops::Range<usize>| -> Option<i64> {
        let text = time.get(range)?;
        text.bytes().all(|b| b.is_ascii_digit()).then(|| text.parse().ok())?
    };
    let is = |at: usize, mark: &str| time.get(at..at + 1).is_some_and(|found| mark.contains(found));
    let (year, month, day) = (digits(0..4)?, digits(5..7)?, digits(8..10)?);
    let (hour, minute) = (digits(11..13)?, digits(14..16)?);
    let has_second = is(16, ":");
    let second = if has_second { digits(17..19)? } else { 0 };
    let end = if has_second { 19 } else { 16 };
    let marks = is(4, "-") && is(7, "-") && is(10, "Tt ") && is(13, ":");
    let ranges =
        (1..=12).contains(&month) && (1..=31).contains(&day) && hour < 24 && minute < 60 && second < 61;
    let offset = match time.get(end..)? {
        "Z" | "z" => 0,
        zone => {
            let sign = if zone.starts_with('+') { 1 } else { -1 };
            let is_zone = zone.len() == 6 && (is(end, "+") || is(end, "-")) && is(end + 3, ":");
            let minutes = 60 * digits(end + 1..end + 3)? + digits(end + 4..end + 6)?;
            is_zone.then_some(sign * minutes)?
        }
    };
    // Fliegel, van Flandern, "A Machine Algorithm for Processing Calendar Dates", 1968.
    let early = (month - 14) / 12;
    let julian = day - 32_075 + 1461 * (year + 4800 + early) / 4 + 367 * (month - 2 - 12 * early) / 12
        - 3 * ((year + 4900 + early) / 100) / 4;
    let minutes = (60 * hour + minute - offset) as f64 + second as f64 / 60.0;
    (marks && ranges).then(|| (julian - 2_451_545) as f64 - 0.5 + minutes / 1440.0)
}

/// Elevation and azimuth of the sun in degrees, to a hundredth between 1950 and 2050.
///
/// # Source
/// Michalsky, "The Astronomical Almanac's Algorithm for Approximate Solar Position (1950-2050)", Solar Energy 40, 1988.
fn sun_at(days: f64, latitude: f64, longitude: f64) -> (f64, f64) {
    let mean = 280.460 + 0.985_647_4 * days;
    let anomaly = (357.528 + 0.985_600_3 * days).to_radians();
    let ecliptic = (mean + 1.915 * anomaly.sin() + 0.020 * (2.0 * anomaly).sin()).to_radians();
    let tilt = (23.439 - 0.000_000_4 * days).to_radians();
    let ascension = (tilt.cos() * ecliptic.sin()).atan2(ecliptic.cos());
    let declination = (tilt.sin() * ecliptic.sin()).asin();
    let hour = 24.0 * (days + 0.5).rem_euclid(1.0);
    let sidereal = 6.697_375 + 0.065_709_824_2 * days + hour;
    let turn = (15.0 * sidereal + longitude).to_radians() - ascension;
    let latitude = latitude.to_radians();
    let up = latitude.sin() * declination.sin() + latitude.cos() * declination.cos() * turn.cos();
    let east = -declination.cos() * turn.sin();
    let north = latitude.cos() * declination.sin() - latitude.sin() * declination.cos() * turn.cos();
    (up.clamp(-1.0, 1.0).asin().to_degrees(), east.atan2(north).to_degrees().rem_euclid(360.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_with_their_zone() {
        assert_eq!(days_since_2000("2000-01-01T12:00:00Z"), Some(0.0));
        assert_eq!(days_since_2000("2000-01-02T00:30+00:30"), Some(0.5));
        assert_eq!(days_since_2000("1999-12-31T12:00:00-24:00"), Some(0.0));
        for wrong in ["", "2000-01-01", "2000-13-01T00:00Z", "2000-01-01T12:00", "2000-01-01T1é:00Z", "x"] {
            assert_eq!(days_since_2000(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn the_sun_stands_where_almanacs_say() {
        let at =
            |time: &str, latitude, longitude| sun_at(days_since_2000(time).unwrap(), latitude, longitude);
        // NREL's SPA report: Golden, Colorado, 17 October 2003, 12:30:30 MST: zenith 50.11, azimuth 194.34.
        let (elevation, azimuth) = at("2003-10-17T12:30:30-07:00", 39.742_476, -105.178_6);
        assert!(
            (elevation - 39.888).abs() < 0.05 && (azimuth - 194.340).abs() < 0.05,
            "{elevation} {azimuth}"
        );
        // Overhead at the tropic on midsummer noon.
        let (elevation, _) = at("2026-06-21T12:02:00Z", 23.44, 0.0);
        assert!(elevation > 89.5, "{elevation}");
    }

    #[test]
    fn north_is_minus_z_and_east_is_x() {
        assert!(direction(0.0, 0.0).distance(DVec3::NEG_Z) < 1e-12);
        assert!(direction(0.0, 90.0).distance(DVec3::X) < 1e-12);
        assert!(direction(90.0, 10.0).distance(DVec3::Y) < 1e-12);
    }
}
