//! The sky as a light: the background, and ambient light, which comes from a sky that nobody sees.
//!
//! Only what is brighter than the mean is worth asking for: the rest is found by rays that surfaces scatter. Where the sky is
//! nearly the same everywhere, those do it alone, and with less noise than both together.
//!
//! # Source
//! Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 12.5.2; Karlík et al., "MIS Compensation:
//! Optimizing Sampling Techniques in Multiple Importance Sampling", SIGGRAPH Asia 2019.

use super::table2d::Table2d;
use super::{LightSample, Target, Use};
use crate::atmosphere::{self, DaySky, SunDisk};
use crate::background::{self, direction, equirectangular};
use glam::{Vec2, Vec3};
use heliostat_scene::color::luminance;
use heliostat_scene::scene::Background;
use heliostat_scene::{Image, Rgb};
use std::f32::consts::{FRAC_1_PI, PI};

/// Rows of the table of a gradient.
const GRADIENT_ROWS: usize = 64;

/// Rows of the table of daylight.
const DAY_ROWS: usize = 128;

/// A sky is asked where the square of its deviation from its mean is so many times the square of the mean, over the sphere.
const LEAST_CONTRAST: f64 = 1.0;

/// Light from infinitely far, from all around.
#[derive(Debug)]
pub(crate) struct Sky<'s> {
    background: &'s Background,
    /// Radiance of ambient light.
    unseen: Rgb,
    /// Mean luminance.
    mean: f32,
    table: Option<Table2d>,
    /// What the air makes, where it does.
    day: Option<DaySky>,
}

/// Luminances of the sky, row by row from the top, as an equirectangular image.
struct Grid {
    columns: usize,
    luminances: Vec<f32>,
}

impl<'s> Sky<'s> {
    /// The sky of a background, with its sun, and of ambient light that throws the irradiance `ambient` on an open surface.
    pub(super) fn new(background: &'s Background, ambient: Rgb, used: Use) -> (Self, Option<SunDisk>) {
        let unseen = FRAC_1_PI * ambient;
        let mut sky = Self { background, unseen, mean: luminance(unseen), table: None, day: None };
        let mut sun = None;
        let grid = match background {
            Background::Constant(color) => {
                sky.mean += luminance(*color);
                return (sky, None);
            }
            Background::Gradient { .. } => Grid::of_gradient(background),
            Background::Image { image, intensity, .. } => Grid::of_image(image, *intensity),
            Background::Daylight(day) => {
                let (day, disk) = atmosphere::daylight(day);
                let grid = Grid::of_day(&day);
                (sky.day, sun) = (Some(day), disk);
                grid
            }
        };
        if used == Use::Paths {
            let mean = grid.mean(|l| l);
            sky.mean += mean as f32;
            if grid.mean(|l| (l - mean) * (l - mean)) > LEAST_CONTRAST * mean * mean {
                sky.table = grid.table(mean);
            }
        }
        (sky, sun)
    }

    /// What is seen in the unit direction `dir`.
    #[inline]
    pub(crate) fn seen(&self, dir: Vec3) -> Rgb {
        match &self.day {
            Some(day) => day.radiance(dir),
            None => background::radiance(self.background, dir),
        }
    }

    /// What lights surfaces from the unit direction `dir`.
    #[inline]
    pub(crate) fn radiance(&self, dir: Vec3) -> Rgb {
        self.seen(dir) + self.unseen
    }

    /// Whether it is worth asking.
    pub(super) fn is_sampled(&self) -> bool {
        self.table.is_some()
    }

    /// About the irradiance of all of it.
    pub(super) fn irradiance(&self) -> f32 {
        PI * self.mean
    }

    /// Light from a direction that is worth asking for.
    #[inline]
    pub(super) fn sample(&self, u: Vec2) -> Option<LightSample> {
        let (at, density) = self.table.as_ref()?.sample(u);
        let (dir, sin) = direction(at, self.rotation());
        let pdf = density / (2.0 * PI * PI * sin);
        let is_drawn = pdf > 0.0 && pdf.is_finite();
        is_drawn.then(|| LightSample {
            to_light: dir,
            arriving: self.radiance(dir) / pdf,
            pdf,
            target: Target::Sky,
        })
    }

    /// The density by solid angle with which [`Sky::sample`] draws the unit direction `dir`.
    #[inline]
    pub(super) fn density(&self, dir: Vec3) -> f32 {
        let Some(table) = &self.table else { return 0.0 };
        let sin = (1.0 - dir.y * dir.y).max(0.0).sqrt();
        let density = table.density(equirectangular(dir, self.rotation())) / (2.0 * PI * PI * sin);
        if density.is_finite() { density } else { 0.0 }
    }

    fn rotation(&self) -> f32 {
        match self.background {
            Background::Image { rotation, .. } => *rotation,
            Background::Constant(_) | Background::Gradient { .. } | Background::Daylight(_) => 0.0,
        }
    }
}

impl Grid {
    fn of_gradient(background: &Background) -> Self {
        let row = |i: usize| {
            let at = Vec2::new(0.5, (i as f32 + 0.5) / GRADIENT_ROWS as f32);
            luminance(background::radiance(background, direction(at, 0.0).0))
        };
        Self { columns: 1, luminances: (0..GRADIENT_ROWS).map(row).collect() }
    }

    fn of_day(day: &DaySky) -> Self {
        let (columns, rows) = (2 * DAY_ROWS, DAY_ROWS);
        let cell = |i: usize| {
            let at = Vec2::new((i % columns) as f32 + 0.5, (i / columns) as f32 + 0.5);
            luminance(day.radiance(direction(at / Vec2::new(columns as f32, rows as f32), 0.0).0))
        };
        Self { columns, luminances: (0..columns * rows).map(cell).collect() }
    }

    /// The mean over each pixel of what linear interpolation between pixels makes of them.
    fn of_image(image: &Image, intensity: Rgb) -> Self {
        let (columns, rows) = (image.width as usize, image.height as usize);
        let pixel = |i: usize| {
            luminance(intensity * image.pixel((i % columns) as u32, (i / columns) as u32).truncate())
        };
        let plain: Vec<f32> = (0..columns * rows).map(pixel).collect();
        // Along the row, then across: an eighth comes from each neighbour.
        let smooth = |before: f32, here: f32, after: f32| 0.125 * before + 0.75 * here + 0.125 * after;
        let along: Vec<f32> = plain
            .chunks_exact(columns)
            .flat_map(|row| {
                (0..columns).map(|x| smooth(row[(x + columns - 1) % columns], row[x], row[(x + 1) % columns]))
            })
            .collect();
        let cell = |i: usize| {
            let (x, y) = (i % columns, i / columns);
            let at = |y: usize| along[y * columns + x];
            smooth(at(y.saturating_sub(1)), at(y), at((y + 1).min(rows - 1)))
        };
        Self { columns, luminances: (0..columns * rows).map(cell).collect() }
    }

    /// The share of the sphere that each cell of a row covers.
    fn cell_share(&self, row: usize) -> f64 {
        let rows = (self.luminances.len() / self.columns) as f64;
        let cos = |row: usize| (std::f64::consts::PI * row as f64 / rows).cos();
        0.5 * (cos(row) - cos(row + 1)) / self.columns as f64
    }

    /// The mean over the sphere of something of the luminance.
    fn mean(&self, of: impl Fn(f64) -> f64) -> f64 {
        let row_sum = |row: &[f32]| row.iter().map(|&l| of(f64::from(l))).sum::<f64>();
        self.luminances
            .chunks_exact(self.columns)
            .enumerate()
            .map(|(i, row)| self.cell_share(i) * row_sum(row))
            .sum()
    }

    /// What is brighter than `mean`; `None` where nothing is.
    fn table(&self, mean: f64) -> Option<Table2d> {
        let rows = self.luminances.chunks_exact(self.columns).enumerate();
        let share = |(i, row): (usize, &[f32])| {
            let size = self.cell_share(i);
            row.iter().map(|&l| size * (f64::from(l) - mean).max(0.0)).collect::<Vec<_>>()
        };
        Table2d::new(self.columns, &rows.flat_map(share).collect::<Vec<_>>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;
    use heliostat_geometry::warp::{SPHERE_PDF, square_to_sphere};
    use heliostat_scene::image::{Encoding, Samples};
    use std::sync::Arc;

    /// A dim sky of 16 x 8 pixels with one bright pixel and one that is a little brighter.
    fn background() -> Background {
        let mut values = vec![0.1; 16 * 8];
        (values[3 * 16 + 5], values[5 * 16 + 15]) = (50.0, 3.0);
        let samples = Samples::F32(values);
        let image = Image::new(16, 8, 1, Encoding::Linear, samples);
        Background::Image { image: Arc::new(image), intensity: Rgb::ONE, rotation: 0.7 }
    }

    fn square(n: u32) -> impl Iterator<Item = Vec2> {
        (0..n * n).map(move |i| (Vec2::new((i % n) as f32, (i / n) as f32) + 0.5) / n as f32)
    }

    #[test]
    fn samples_and_density_agree_and_the_density_is_one() {
        let background = background();
        let sky = Sky::new(&background, Rgb::ZERO, Use::Paths).0;
        let mut sum = 0.0;
        for u in square(256) {
            sum += f64::from(sky.density(square_to_sphere(u)) / SPHERE_PDF) / f64::from(256 * 256);
        }
        assert!((sum - 1.0).abs() < 5e-3, "{sum}");
        for sample in square(37).filter_map(|u| sky.sample(u)) {
            assert!((sky.density(sample.to_light) / sample.pdf - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn the_density_of_daylight_is_one() {
        let day = Background::Daylight(heliostat_scene::scene::Daylight {
            to_sun: Vec3::new(0.9, 0.1, 0.3).normalize(),
            turbidity: 3.0,
            ground_albedo: Rgb::splat(0.2),
            intensity: Rgb::ONE,
            sun: 1.0,
        });
        let sky = Sky::new(&day, Rgb::ZERO, Use::Paths).0;
        let densities = square(512).map(|u| f64::from(sky.density(square_to_sphere(u)) / SPHERE_PDF));
        let sum = densities.sum::<f64>() / f64::from(512 * 512);
        assert!((sum - 1.0).abs() < 5e-3, "{sum}");
        for sample in square(37).filter_map(|u| sky.sample(u)) {
            assert!((sky.density(sample.to_light) / sample.pdf - 1.0).abs() < 1e-3);
            assert!(sample.arriving.is_finite());
        }
    }

    #[test]
    fn what_is_brighter_than_the_mean_is_drawn_in_full() {
        let background = background();
        let sky = Sky::new(&background, Rgb::ZERO, Use::Paths).0;
        let n = 1024;
        let is_drawn = |dir: Vec3| sky.density(dir) > 0.0;
        let expected: f64 = square(n)
            .map(square_to_sphere)
            .filter(|&dir| is_drawn(dir))
            .map(|dir| f64::from(sky.radiance(dir).x / SPHERE_PDF))
            .sum::<f64>()
            / f64::from(n * n);
        let count = 1 << 18;
        let numbers = (0..count).map(|i| Sampler::new(1, [0, 0], i).next_2d());
        let drawn = numbers.filter_map(|u| sky.sample(u)).map(|s| f64::from(s.arriving.x)).sum::<f64>()
            / f64::from(count);
        assert!((drawn / expected - 1.0).abs() < 5e-3, "{drawn} for {expected}");
    }

    #[test]
    fn an_even_sky_is_left_to_the_surfaces() {
        let even = Background::Constant(Rgb::ONE);
        assert!(!Sky::new(&even, Rgb::ONE, Use::Paths).0.is_sampled());
    }
}
