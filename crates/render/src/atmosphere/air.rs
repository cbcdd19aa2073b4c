//! The Earth's air: how much of the light of the sun comes through, and what is scattered more than once.
//!
//! # Source
//! Bruneton, Neyret, "Precomputed Atmospheric Scattering", EGSR 2008 (transmittance and its table); Hillaire, "A Scalable and
//! Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020, section 5.5 (scattering of higher orders).

use super::spectrum::{BANDS, Spectrum, haze, ozone, rayleigh};
use glam::DVec2;
use rayon::prelude::*;
use std::f64::consts::{FRAC_1_PI, PI, TAU};

/// Radii of the ground and of the top of the air, in metres.
const GROUND: f64 = 6_360_000.0;
const TOP: f64 = 6_420_000.0;
/// Heights over which air and haze thin out by e, in metres.
const AIR_HEIGHT: f64 = 8_000.0;
const HAZE_HEIGHT: f64 = 1_200.0;
/// Share of the light that haze scatters, and the mean cosine of that.
const HAZE_ALBEDO: f32 = 0.9;
const HAZE_G: f64 = 0.8;
/// Half of the angle that the sun covers, in radians.
pub(super) const SUN_RADIUS: f64 = 0.004_675;

/// Sizes of the tables: height and direction.
const PASSED: [usize; 2] = [32, 128];
const SCATTERED: [usize; 2] = [10, 32];
/// Points on a ray, and directions at a point.
const PASSED_STEPS: usize = 48;
const SCATTERED_STEPS: usize = 16;
const DIRECTIONS: usize = 8;

/// The air over a ground of an albedo.
pub(super) struct Air {
    rayleigh: Spectrum,
    haze: Spectrum,
    ozone: Spectrum,
    /// Share of the light that reaches a height from outside.
    passed: Table,
    /// Radiance of what is scattered twice and more, the same in all directions, for an irradiance of 1 from the sun.
    scattered: Table,
}

/// What the air does at a height, per metre.
struct Layer {
    air: f32,
    haze: f32,
    ozone: f32,
}

/// A table of spectra over height and direction.
struct Table {
    size: [usize; 2],
    values: Vec<Spectrum>,
}

/// A point of the air above a place: how high, and how far along; the sun or a ray are given by cosines.
#[derive(Clone, Copy)]
pub(super) struct Aloft {
    /// From the middle of the Earth.
    radius: f64,
    /// Cosine of the angle between the direction to the sun and up.
    sun: f64,
}

impl Air {
    pub(super) fn new(turbidity: f64, albedo: f32) -> Self {
        let haze = haze(turbidity).map(|thickness| thickness / HAZE_HEIGHT as f32);
        let empty = || Table { size: [1, 1], values: vec![[0.0; BANDS]] };
        let (passed, scattered) = (empty(), empty());
        let mut air = Self { rayleigh: rayleigh(), haze, ozone: ozone(), passed, scattered };
        air.passed = Table::new(PASSED, |[height, direction]| {
            let (radius, cos) = passed_at(height, direction);
            air.passed_along(radius, cos)
        });
        air.scattered = Table::new(SCATTERED, |[height, direction]| {
            let radius = GROUND + height * height * (TOP - GROUND);
            air.scattered_again(Aloft { radius, sun: sun_at(direction) }, albedo)
        });
        air
    }

    /// The share of the light of the sun that arrives at the ground from a direction with the cosine `cos` to straight up.
    pub(super) fn passed_to_ground(&self, cos: f64) -> Spectrum {
        if cos < 0.0 { [0.0; BANDS] } else { self.passed(GROUND, cos) }
    }

    /// The radiance that arrives at the ground from the direction with cosine `cos`, for an irradiance of 1 above the air from
    /// a sun with the cosine `sun` to straight up and `between` to the direction.
    pub(super) fn radiance(&self, cos: f64, sun: f64, between: f64, steps: usize) -> Spectrum {
        let phase = [rayleigh_phase(between), haze_phase(between)].map(|phase| phase as f32);
        let length = -GROUND * cos + ((GROUND * cos).powi(2) + TOP * TOP - GROUND * GROUND).sqrt();
        let mut sum = [0.0; BANDS];
        let mut passed = [1.0; BANDS];
        for (t, step) in steps_of(length, steps) {
            let at = aloft(GROUND, cos, sun, between, t);
            let layer = Layer::at(at.radius);
            let (direct, again) = (self.sun_at(at), self.again(at));
            for i in 0..BANDS {
                let (air, haze) = (self.rayleigh[i] * layer.air, HAZE_ALBEDO * self.haze[i] * layer.haze);
                let source = (air * phase[0] + haze * phase[1]) * direct[i] + (air + haze) * again[i];
                sum[i] += passed[i] * self.over_step(i, &layer, step as f32, &mut passed[i]) * source;
            }
        }
        sum
    }

    /// The length over which a source counts in full, of a step; dims what lies behind.
    #[inline]
    fn over_step(&self, i: usize, layer: &Layer, step: f32, passed: &mut f32) -> f32 {
        let loss = self.loss(i, layer);
        let left = (-loss * step).exp();
        let before = *passed;
        *passed = before * left;
        // Without loss the exponential is 1 to its last digit.
        if left < 1.0 { (1.0 - left) / loss } else { step }
    }

    #[inline]
    fn loss(&self, i: usize, layer: &Layer) -> f32 {
        self.rayleigh[i] * layer.air + self.haze[i] * layer.haze + self.ozone[i] * layer.ozone
    }

    /// The share of light that comes along a ray from outside, by summing up.
    fn passed_along(&self, radius: f64, cos: f64) -> Spectrum {
        let length = to_top(radius, cos);
        let mut depth = [0.0; BANDS];
        for (t, step) in steps_of(length, PASSED_STEPS) {
            let layer = Layer::at(further(radius, cos, t));
            for (i, depth) in depth.iter_mut().enumerate() {
                *depth += self.loss(i, &layer) * step as f32;
            }
        }
        depth.map(|depth| (-depth).exp())
    }

    /// [`Self::passed_along`] from the table.
    fn passed(&self, radius: f64, cos: f64) -> Spectrum {
        let horizon = (TOP * TOP - GROUND * GROUND).sqrt();
        let height = (radius * radius - GROUND * GROUND).max(0.0).sqrt();
        let (least, most) = (TOP - radius, height + horizon);
        self.passed.at([height / horizon, (to_top(radius, cos) - least) / (most - least)])
    }

    /// The share of the sun that a point sees, dimmed by the air.
    fn sun_at(&self, at: Aloft) -> Spectrum {
        let sin = (GROUND / at.radius).min(1.0);
        let horizon = -(1.0 - sin * sin).sqrt();
        // How much of the disc is above the horizon.
        let x = (0.5 + 0.5 * (at.sun - horizon) / (sin * SUN_RADIUS)).clamp(0.0, 1.0);
        let share = (x * x * (3.0 - 2.0 * x)) as f32;
        if share == 0.0 { [0.0; BANDS] } else { self.passed(at.radius, at.sun).map(|passed| share * passed) }
    }

    fn again(&self, at: Aloft) -> Spectrum {
        let height = ((at.radius - GROUND).max(0.0) / (TOP - GROUND)).sqrt();
        self.scattered.at([height, 0.5 * (1.0 + at.sun.cbrt())])
    }

    /// Light of the second order at a point, and all orders after it as a geometric series.
    fn scattered_again(&self, at: Aloft, albedo: f32) -> Spectrum {
        let (mut second, mut handed_on) = ([0.0; BANDS], [0.0; BANDS]);
        for k in 0..DIRECTIONS * DIRECTIONS {
            let u = (DVec2::new((k % DIRECTIONS) as f64, (k / DIRECTIONS) as f64) + 0.5) / DIRECTIONS as f64;
            self.gather(at, 1.0 - 2.0 * u.x, TAU * u.y, albedo, &mut second, &mut handed_on);
        }
        let mean = 1.0 / (DIRECTIONS * DIRECTIONS) as f32;
        std::array::from_fn(|i| mean * second[i] / (1.0 - mean * handed_on[i]))
    }

    /// Adds, for one direction, light that was scattered once on the way here, and what an even light of 1 would have sent.
    fn gather(
        &self,
        at: Aloft,
        cos: f64,
        turn: f64,
        albedo: f32,
        second: &mut Spectrum,
        handed_on: &mut Spectrum,
    ) {
        let between = cos * at.sun + ((1.0 - cos * cos) * (1.0 - at.sun * at.sun)).sqrt() * turn.cos();
        let ground = to_ground(at.radius, cos);
        let mut passed = [1.0; BANDS];
        for (t, step) in steps_of(ground.unwrap_or_else(|| to_top(at.radius, cos)), SCATTERED_STEPS) {
            let point = aloft(at.radius, cos, at.sun, between, t);
            let layer = Layer::at(point.radius);
            let direct = self.sun_at(point);
            for i in 0..BANDS {
                let scattering = self.rayleigh[i] * layer.air + HAZE_ALBEDO * self.haze[i] * layer.haze;
                let sent = passed[i] * self.over_step(i, &layer, step as f32, &mut passed[i]) * scattering;
                second[i] += sent * direct[i] * (0.25 * FRAC_1_PI) as f32;
                handed_on[i] += sent;
            }
        }
        if let Some(t) = ground {
            let point = aloft(at.radius, cos, at.sun, between, t);
            let direct = self.sun_at(Aloft { radius: GROUND, ..point });
            let share = albedo * (FRAC_1_PI * point.sun.max(0.0)) as f32;
            (0..BANDS).for_each(|i| second[i] += passed[i] * share * direct[i]);
        }
    }
}

impl Layer {
    /// At a distance from the middle of the Earth.
    fn at(radius: f64) -> Self {
        let height = (radius - GROUND).max(0.0);
        Self {
            air: (-height / AIR_HEIGHT).exp() as f32,
            haze: (-height / HAZE_HEIGHT).exp() as f32,
            // From 10 to 40 km, densest at 25.
            ozone: (1.0 - (height - 25_000.0).abs() / 15_000.0).max(0.0) as f32,
        }
    }
}

impl Table {
    /// Worked out at the grid points of the unit square, border included.
    fn new(size: [usize; 2], value: impl Fn([f64; 2]) -> Spectrum + Sync) -> Self {
        let at = |i: usize| {
            let place = |i: usize, count: usize| i as f64 / (count - 1) as f64;
            value([place(i / size[1], size[0]), place(i % size[1], size[1])])
        };
        Self { size, values: (0..size[0] * size[1]).into_par_iter().map(at).collect() }
    }

    /// Linear in both directions.
    fn at(&self, place: [f64; 2]) -> Spectrum {
        let split = |place: f64, count: usize| {
            let x = place.clamp(0.0, 1.0) * (count - 1) as f64;
            let i = (x as usize).min(count.saturating_sub(2));
            (i, (x - i as f64) as f32)
        };
        let ((row, y), (column, x)) = (split(place[0], self.size[0]), split(place[1], self.size[1]));
        let corner = |dy: usize, dx: usize| {
            let (row, column) = ((row + dy).min(self.size[0] - 1), (column + dx).min(self.size[1] - 1));
            &self.values[row * self.size[1] + column]
        };
        let corners = [corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)];
        let weights = [(1.0 - y) * (1.0 - x), (1.0 - y) * x, y * (1.0 - x), y * x];
        std::array::from_fn(|i| (0..4).map(|k| weights[k] * corners[k][i]).sum())
    }
}

/// Radius and cosine at a place of the table of what comes through.
fn passed_at(height: f64, direction: f64) -> (f64, f64) {
    let horizon = (TOP * TOP - GROUND * GROUND).sqrt();
    let radius = ((height * horizon).powi(2) + GROUND * GROUND).sqrt().min(TOP);
    let (least, most) = (TOP - radius, height * horizon + horizon);
    let length = least + direction * (most - least);
    let cos = (horizon * horizon - (height * horizon).powi(2) - length * length) / (2.0 * radius * length);
    (radius, if length > 0.0 { cos.clamp(-1.0, 1.0) } else { 1.0 })
}

/// The cosine of the sun at a place of the table of what is scattered again: dense around the horizon.
fn sun_at(direction: f64) -> f64 {
    (2.0 * direction - 1.0).powi(3)
}

/// Middles and lengths of steps that grow along a ray.
fn steps_of(length: f64, count: usize) -> impl Iterator<Item = (f64, f64)> {
    let end = move |i: usize| length * (i as f64 / count as f64).powi(2);
    (0..count).map(move |i| (0.5 * (end(i) + end(i + 1)), end(i + 1) - end(i)))
}

/// The radius of a point on a ray.
fn further(radius: f64, cos: f64, t: f64) -> f64 {
    (t * t + 2.0 * radius * cos * t + radius * radius).sqrt()
}

/// A point on a ray.
fn aloft(radius: f64, cos: f64, sun: f64, between: f64, t: f64) -> Aloft {
    let there = further(radius, cos, t);
    Aloft { radius: there.clamp(GROUND, TOP), sun: ((radius * sun + t * between) / there).clamp(-1.0, 1.0) }
}

fn to_top(radius: f64, cos: f64) -> f64 {
    let discriminant = radius * radius * (cos * cos - 1.0) + TOP * TOP;
    (-radius * cos + discriminant.max(0.0).sqrt()).max(0.0)
}

/// The way to the ground, where a ray meets it.
fn to_ground(radius: f64, cos: f64) -> Option<f64> {
    let discriminant = radius * radius * (cos * cos - 1.0) + GROUND * GROUND;
    (cos < 0.0 && discriminant >= 0.0).then(|| (-radius * cos - discriminant.sqrt()).max(0.0))
}

fn rayleigh_phase(cos: f64) -> f64 {
    3.0 / (16.0 * PI) * (1.0 + cos * cos)
}

/// Cornette, Shanks, "Physically Reasonable Analytic Expression for the Single-Scattering Phase Function", 1992.
fn haze_phase(cos: f64) -> f64 {
    let g2 = HAZE_G * HAZE_G;
    3.0 / (8.0 * PI) * (1.0 - g2) * (1.0 + cos * cos)
        / ((2.0 + g2) * (1.0 + g2 - 2.0 * HAZE_G * cos).powf(1.5))
}
