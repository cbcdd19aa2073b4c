//! The disk that a lens makes of a point: round or polygonal, its border smoothed over a pixel.

use std::f32::consts::{PI, TAU};

/// Steps per pixel in the table of sums.
const STEPS: usize = 8;

/// Weights of disks of every radius up to a largest one.
#[derive(Clone, Debug)]
pub(super) struct Disk {
    /// Largest offset in the tables.
    largest: i32,
    /// How far an offset lies from the centre: its length, or the radius of the polygon that it lies on; for light from
    /// points beyond the focus, and for light from nearer ones, which falls upside down.
    distance: Vec<[f32; 2]>,
    /// Sum of the weights of a disk, by radius in steps.
    sums: Vec<f32>,
}

impl Disk {
    /// Disks of an iris of `blades` blades, turned by `rotation`, up to a radius of `largest` pixels.
    pub(super) fn new(blades: u32, rotation: f32, largest: f64) -> Self {
        let largest = largest.ceil() as i32 + 1;
        let offsets = || (-largest..=largest).flat_map(|y| (-largest..=largest).map(move |x| (x, y)));
        let distance = |x: i32, y: i32| distance(x as f32, y as f32, blades, rotation);
        let table: Vec<[f32; 2]> = offsets().map(|(x, y)| [distance(-x, -y), distance(x, y)]).collect();
        // Sorted, the offsets within a radius come first: each sum is exact, in a fixed order.
        let mut sorted: Vec<f32> = table.iter().map(|&[far, _]| far).collect();
        sorted.sort_unstable_by(f32::total_cmp);
        let sum = |radius: f32| {
            let touched = sorted.iter().take_while(|&&d| d < radius + 0.5);
            touched.map(|&d| f64::from(edge(radius, d))).sum::<f64>() as f32
        };
        let steps = largest as usize * STEPS;
        let sums = (0..=steps).map(|i| sum(i as f32 / STEPS as f32)).collect();
        Self { largest, distance: table, sums }
    }

    /// Distances for the pixels of a row, from `column` on, whose light falls on the pixel at (0, 0); y down.
    ///
    /// The offset *from* the other pixel is what counts, hence the turned signs in the table. Row and column lie within
    /// the largest radius.
    pub(super) fn row(&self, row: i32, column: i32) -> &[[f32; 2]] {
        let side = 2 * self.largest + 1;
        let start = (row + self.largest) * side;
        &self.distance[(start + column + self.largest) as usize..(start + side) as usize]
    }

    /// One over the sum of the weights of a disk.
    pub(super) fn share(&self, radius: f32) -> f32 {
        let at = radius * STEPS as f32;
        let low = (at as usize).min(self.sums.len() - 2);
        let (a, b) = (self.sums[low], self.sums[low + 1]);
        1.0 / (a + (b - a) * (at - low as f32).min(1.0))
    }
}

/// The weight of a disk at a distance: 1 inside, 0 outside, falling over the one pixel around the border.
pub(super) fn edge(radius: f32, distance: f32) -> f32 {
    (radius + 0.5 - distance).clamp(0.0, 1.0)
}

/// Radius of the circle, or of the circle around the polygon, on which an offset lies.
fn distance(x: f32, y: f32, blades: u32, rotation: f32) -> f32 {
    let length = x.hypot(y);
    if blades < 3 || length == 0.0 {
        return length;
    }
    // Rows count downward, the iris turns with y up. Within the nearest side, the side's normal decides.
    let side = TAU / blades as f32;
    let from_corner = ((-y).atan2(x) - rotation).rem_euclid(side);
    length * (from_corner - 0.5 * side).cos() / (PI / blades as f32).cos()
}
