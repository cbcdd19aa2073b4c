//! Daylight: the sky over flat ground, and the sun in it, worked out from what is known of the air.
//!
//! Light of the first order is summed up along each ray in twenty bands of the spectrum; higher orders come from a table that
//! takes them for even. So noon, sunset and twilight come from the same few constants, without fitted data. The unit is
//! W/(m² sr) of white light: a luminance of 1 is 179 cd/m².
//!
//! # Source
//! Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020; for the rest see
//! [`spectrum`] and [`air`].

mod air;
mod spectrum;
#[cfg(test)]
mod tests;

use air::{Air, SUN_RADIUS};
use glam::Vec3;
use heliostat_geometry::OrthonormalFrame;
use heliostat_geometry::warp::{cone_pdf, square_to_cone};
use heliostat_scene::Rgb;
use heliostat_scene::color::luminance;
use heliostat_scene::scene::Daylight;
use rayon::prelude::*;
use spectrum::{Observer, SUN};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_2, PI};

/// Size of the table of the sky: heights and turns away from the sun.
const HEIGHTS: usize = 96;
const TURNS: usize = 96;
/// Points on each ray.
const STEPS: usize = 32;
/// Places on the disc of the sun, from below to above, where its colour is worked out.
const BELTS: usize = 33;
/// How much light fades towards the rim of the sun: exponents of the cosine, by channel.
///
/// # Source
/// Hestroffer, Magnan, "Wavelength dependency of the Solar limb darkening", 1998.
const RIM: Rgb = Rgb::new(0.397, 0.503, 0.652);

/// The sky of a moment.
#[derive(Debug)]
pub(crate) struct DaySky {
    /// The direction along the ground towards the sun; any where it stands overhead.
    towards: Vec3,
    /// Radiance, by rows of one height from the horizon up.
    table: Vec<Rgb>,
    /// Radiance of the ground.
    ground: Rgb,
}

/// The disc of the sun.
#[derive(Debug)]
pub(crate) struct SunDisk {
    /// Around the direction to the sun.
    frame: OrthonormalFrame,
    /// Mean radiance across belts of the disc, from below to above.
    belts: Vec<Rgb>,
    /// One over its solid angle.
    pdf: f32,
}

/// Sky and sun.
pub(crate) fn daylight(day: &Daylight) -> (DaySky, Option<SunDisk>) {
    let to_sun = day.to_sun.normalize_or(Vec3::Y);
    let air = Air::new(f64::from(day.turbidity), day.ground_albedo.element_sum() / 3.0);
    let observer = Observer::new();
    let disk = SunDisk::new(&air, &observer, to_sun, day.sun * day.intensity);
    let mut sky = DaySky::new(&air, &observer, to_sun, day.intensity);
    let full = SunDisk::new(&air, &observer, to_sun, day.intensity);
    let lit = sky.irradiance() + full.map_or(Rgb::ZERO, |sun| to_sun.y.max(0.0) * sun.irradiance());
    sky.ground = FRAC_1_PI * day.ground_albedo * lit;
    (sky, disk)
}

impl DaySky {
    fn new(air: &Air, observer: &Observer, to_sun: Vec3, intensity: Rgb) -> Self {
        let towards = Vec3::new(to_sun.x, 0.0, to_sun.z).normalize_or(Vec3::X);
        let sun = f64::from(to_sun.y);
        let value = |i: usize| {
            let (cos, turn) = (f64::from(height_at(i / TURNS).sin()), f64::from(turn_at(i % TURNS)));
            let between = cos * sun + ((1.0 - cos * cos) * (1.0 - sun * sun)).sqrt() * turn.cos();
            let radiance = air.radiance(cos, sun, between.clamp(-1.0, 1.0), STEPS);
            intensity * observer.color(&std::array::from_fn(|i| SUN[i] * radiance[i]))
        };
        let table = (0..HEIGHTS * TURNS).into_par_iter().map(value).collect();
        Self { towards, table, ground: Rgb::ZERO }
    }

    /// Radiance from a unit direction, the disc of the sun left out.
    pub(crate) fn radiance(&self, dir: Vec3) -> Rgb {
        if dir.y < 0.0 {
            return self.ground;
        }
        let level = Vec3::new(dir.x, 0.0, dir.z).normalize_or(self.towards);
        // The angle from its chord keeps its digits near the sun.
        let turn = 2.0 * (0.5 * level.distance(self.towards)).min(1.0).asin();
        let height = dir.y.min(1.0).asin();
        let split = |place: f32, count: usize| {
            let x = place.clamp(0.0, 1.0) * (count - 1) as f32;
            let i = (x as usize).min(count - 2);
            (i, x - i as f32)
        };
        let (row, y) = split((height / FRAC_PI_2).sqrt(), HEIGHTS);
        let (column, x) = split((turn / PI).sqrt(), TURNS);
        let at = |dy: usize, dx: usize| self.table[(row + dy) * TURNS + column + dx];
        at(0, 0).lerp(at(0, 1), x).lerp(at(1, 0).lerp(at(1, 1), x), y)
    }

    /// Irradiance on level ground.
    fn irradiance(&self) -> Rgb {
        const ROWS: usize = 128;
        const COLUMNS: usize = 64;
        let point = |i: usize| {
            // Equal areas of the ground plane under the dome.
            let radius = (((i / COLUMNS) as f32 + 0.5) / ROWS as f32).sqrt();
            let turn = PI * ((i % COLUMNS) as f32 + 0.5) / COLUMNS as f32;
            let across = Vec3::Y.cross(self.towards);
            let level = radius * (turn.cos() * self.towards + turn.sin() * across);
            self.radiance((level + (1.0 - radius * radius).sqrt() * Vec3::Y).normalize())
        };
        PI / (ROWS * COLUMNS) as f32 * (0..ROWS * COLUMNS).map(point).sum::<Rgb>()
    }
}

impl SunDisk {
    /// `None` where nothing of it is to be seen.
    fn new(air: &Air, observer: &Observer, to_sun: Vec3, intensity: Rgb) -> Option<Self> {
        let height = f64::from(to_sun.y.clamp(-1.0, 1.0)).asin();
        let pdf = cone_pdf(SUN_RADIUS as f32);
        let belt = |i: usize| {
            let above = SUN_RADIUS * (2.0 * i as f64 / (BELTS - 1) as f64 - 1.0);
            let passed = air.passed_to_ground((height + above).sin());
            pdf * intensity * observer.color(&std::array::from_fn(|i| SUN[i] * passed[i]))
        };
        let belts: Vec<Rgb> = (0..BELTS).map(belt).collect();
        let frame = OrthonormalFrame::around(to_sun);
        let is_dark = belts.iter().all(|&belt| belt == Rgb::ZERO);
        (!is_dark).then_some(Self { frame, belts, pdf })
    }

    /// The radiance from a unit direction, and the density with which it is drawn; `None` beside the disc.
    #[inline]
    pub(crate) fn seen(&self, dir: Vec3) -> Option<(Rgb, f32)> {
        // The square of the distance from the middle of the disc, in radii; chords keep their digits.
        let chord = 2.0 * (0.5 * SUN_RADIUS as f32).sin();
        let x2 = dir.distance_squared(self.frame.z) / (chord * chord);
        (x2 <= 1.0).then(|| (self.radiance(dir, x2), self.pdf))
    }

    /// Radiance in a direction `x2` squared radii from the middle.
    fn radiance(&self, dir: Vec3, x2: f32) -> Rgb {
        if dir.y < 0.0 {
            return Rgb::ZERO;
        }
        let above = (dir.y.min(1.0).asin() - self.frame.z.y.clamp(-1.0, 1.0).asin()) / SUN_RADIUS as f32;
        let place = (0.5 * (above + 1.0)).clamp(0.0, 1.0) * (BELTS - 1) as f32;
        let i = (place as usize).min(BELTS - 2);
        let belt = self.belts[i].lerp(self.belts[i + 1], place - i as f32);
        // The mean of the power over the disc is 1.
        let cos = (1.0 - x2).max(0.0).sqrt();
        belt * 0.5 * (RIM + 2.0) * powers(cos, RIM)
    }

    /// A direction, uniform over the disc, with its radiance and density.
    #[inline]
    pub(crate) fn sample(&self, u: glam::Vec2) -> (Vec3, Rgb, f32) {
        let dir = self.frame.to_world(square_to_cone(u, SUN_RADIUS as f32));
        let radiance = self.seen(dir).map_or(Rgb::ZERO, |(radiance, _)| radiance);
        (dir, radiance, self.pdf)
    }

    /// About the irradiance on a surface that faces it.
    pub(crate) fn irradiance(&self) -> Rgb {
        self.belts.iter().sum::<Rgb>() / (BELTS as f32 * self.pdf)
    }

    /// [`Self::irradiance`], as one number.
    pub(crate) fn brightness(&self) -> f32 {
        luminance(self.irradiance())
    }
}

/// A number to three powers.
fn powers(base: f32, exponents: Rgb) -> Rgb {
    exponents.map(|exponent| base.powf(exponent))
}

/// The height of a row: dense at the horizon.
fn height_at(row: usize) -> f32 {
    FRAC_PI_2 * (row as f32 / (HEIGHTS - 1) as f32).powi(2)
}

/// The turn away from the sun of a column: dense around it.
fn turn_at(column: usize) -> f32 {
    PI * (column as f32 / (TURNS - 1) as f32).powi(2)
}
