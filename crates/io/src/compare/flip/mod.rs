//! FLIP: what a viewer sees when two pictures alternate in place.
//!
//! Colours are filtered as the eye would at a viewing distance, and compared in a perceptually even space; edges and
//! points that one picture has and the other lacks raise the error. Light without an upper end is tone mapped at all
//! sensible exposures and the largest error counts.
//!
//! # Source
//! P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild, "FLIP: A Difference Evaluator
//! for Alternating Images", HPG 2020; P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Möller, "Visualizing Errors in
//! Rendered High Dynamic Range Images", Eurographics 2021. Constants are theirs.

mod color;
mod exposure;
mod filter;

use crate::parallel::{map_in_order, threads};
use color::{hunt_lab, opponent, unopponent};
use filter::{Kernels, Plane, convolve};
use glam::Vec3;
use std::sync::LazyLock;

/// Pixels per degree of the visual field: a screen 0.7 m and 3840 pixels wide, seen from 0.7 m.
pub const PIXELS_PER_DEGREE: f32 = 3840.0 * std::f32::consts::PI / 180.0;

/// Exponent of colour differences.
const COLOR_POWER: f32 = 0.7;
/// Part of the largest colour difference below which errors are spread over [`COMMON_PART`] of the range.
const COMMON_LIMIT: f32 = 0.4;
/// Part of the range for common errors.
const COMMON_PART: f32 = 0.95;

/// The largest colour difference: of pure green and pure blue.
static LARGEST: LazyLock<f32> =
    LazyLock::new(|| hyab(hunt_lab(Vec3::Y), hunt_lab(Vec3::Z)).powf(COLOR_POWER));

/// FLIP errors in `[0, 1]` of two pictures for a display: linear light, clipped to `[0, 1]`, of `[width, height]` pixels.
///
/// # Panics
/// When the slices do not have `width * height` pixels, or there are none.
pub fn ldr(
    reference: &[Vec3],
    test: &[Vec3],
    [width, height]: [usize; 2],
    pixels_per_degree: f32,
) -> Vec<f32> {
    assert!(width * height > 0 && reference.len() == width * height && test.len() == reference.len());
    let kernels = Kernels::new(pixels_per_degree);
    let seen = [reference, test].map(|pixels| See::new(pixels, width, &kernels));
    let [a, b] = &seen;
    let error = |i: usize| {
        let edge = (a.edges[i] - b.edges[i]).abs();
        let point = (a.points[i] - b.points[i]).abs();
        let feature = (std::f32::consts::FRAC_1_SQRT_2 * edge.max(point)).sqrt();
        let color = spread(hyab(a.colors[i], b.colors[i]).powf(COLOR_POWER));
        color.powf(1.0 - feature).clamp(0.0, 1.0)
    };
    (0..reference.len()).map(error).collect()
}

/// FLIP errors in `[0, 1]` of two pictures with light of any brightness: the largest of [`ldr`] over exposures.
///
/// # Panics
/// When the slices do not have `width * height` pixels, or there are none.
pub fn hdr(reference: &[Vec3], test: &[Vec3], size: [usize; 2], pixels_per_degree: f32) -> Vec<f32> {
    let exposures = exposure::exposures(reference);
    let largest_of = |mine: &[f32]| {
        let mut largest = vec![0.0_f32; reference.len()];
        for &exposure in mine {
            let [a, b] = [reference, test].map(|pixels| exposure::tone_map(pixels, exposure));
            raise(&mut largest, &ldr(&a, &b, size, pixels_per_degree));
        }
        largest
    };
    // The largest of all does not depend on who found it.
    let shares: Vec<_> = exposures.chunks(exposures.len().div_ceil(threads(0))).collect();
    let mut largest = vec![0.0; reference.len()];
    for found in map_in_order(&shares, 0, |share| largest_of(share)) {
        raise(&mut largest, &found);
    }
    largest
}

/// Raises every value to at least that of `others`.
fn raise(values: &mut [f32], others: &[f32]) {
    values.iter_mut().zip(others).for_each(|(v, o)| *v = v.max(*o));
}

/// What the eye takes in of a picture.
struct See {
    /// Filtered colours in L*a*b* after Hunt's adjustment.
    colors: Vec<Vec3>,
    /// Strength of edges.
    edges: Vec<f32>,
    /// Strength of points.
    points: Vec<f32>,
}

impl See {
    fn new(pixels: &[Vec3], width: usize, kernels: &Kernels) -> Self {
        let opponents: Vec<_> = pixels.iter().map(|p| opponent(p.clamp(Vec3::ZERO, Vec3::ONE))).collect();
        let plane = |i: usize| Plane { width, values: opponents.iter().map(|p| p[i]).collect() };
        let [achromatic, red_green, blue_yellow] = [0, 1, 2].map(plane);
        let brightness =
            Plane { width, values: achromatic.values.iter().map(|y| (y + 16.0) / 116.0).collect() };
        let filtered = [
            kernels.achromatic.apply(&achromatic),
            kernels.red_green.apply(&red_green),
            kernels.blue_yellow.apply(&blue_yellow),
        ];
        let color = |i: usize| {
            let filtered = Vec3::from_array([0, 1, 2].map(|c| filtered[c].values[i]));
            hunt_lab(unopponent(filtered).clamp(Vec3::ZERO, Vec3::ONE))
        };
        Self {
            colors: (0..pixels.len()).map(color).collect(),
            edges: strength(&brightness, &kernels.edge, &kernels.smooth),
            points: strength(&brightness, &kernels.point, &kernels.smooth),
        }
    }
}

/// Length of the vector of the responses along both axes.
fn strength(plane: &Plane, along: &[f32], across: &[f32]) -> Vec<f32> {
    let horizontal = convolve(plane, along, across).values;
    let vertical = convolve(plane, across, along).values;
    horizontal.iter().zip(vertical).map(|(x, y)| x.hypot(y)).collect()
}

/// The distance that suits large colour differences: city block between brightness and chroma.
fn hyab(a: Vec3, b: Vec3) -> f32 {
    let d = a - b;
    d.x.abs() + d.y.hypot(d.z)
}

/// Spreads colour errors over `[0, 1]`, most of it for common ones.
fn spread(error: f32) -> f32 {
    let largest = *LARGEST;
    let limit = COMMON_LIMIT * largest;
    if error < limit {
        COMMON_PART / limit * error
    } else {
        COMMON_PART + (error - limit) / (largest - limit) * (1.0 - COMMON_PART)
    }
}
