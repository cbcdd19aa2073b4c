//! Depth of field after rendering: a blur of the picture, driven by its depth.
//!
//! Every pixel is spread over the disk that a lens would make of it (the circle of confusion, from the *perpendicular* distance to
//! the plane in focus: a wall in that plane is sharp into its corners, and untouched bit for bit). What a pixel
//! receives is sorted by depth, against itself:
//!
//! - from *nearer* pixels, what their disks cover: blurred foreground reaches over a sharp background, a sharp foreground
//!   reaches nowhere;
//! - from pixels of the *same* depth, likewise, and from those *behind* what lies in the pixel's own disk: where a
//!   blurred foreground turns transparent near its border, the background shows; a sharp pixel has no disk, so
//!   nothing bleeds into it.
//!
//! The nearer part covers the rest by its weight; the rest is normalised, which fills in what the picture does not show.
//!
//! # Limits
//! The picture holds one depth per pixel and nothing behind it: what a lens sees around a corner is continued from the
//! surroundings, mirrors and glass blur by the distance of their own surface, and an edge smoothed over a pixel
//! takes that pixel's one depth. Disks grow to [`LARGEST`] of the picture's height. The lens itself
//! (`FocusMethod::Lens`) has none of these limits.
//!
//! # Source
//! Potmesil, Chakravarty, "A Lens and Aperture Camera Model for Synthetic Image Generation", SIGGRAPH 1981 (circles of
//! confusion); Scheuermann, Tatarchuk, "Improved Depth of Field Rendering", Shader X3, 2004 (no bleeding into
//! what is sharp); Jimenez, "Next Generation Post Processing in Call of Duty", SIGGRAPH 2014 course (scatter as gather).

mod disk;

use crate::camera_ray::CameraRays;
use crate::layers::Raster;
use disk::{Disk, edge};
use glam::Vec4;
use heliostat_scene::camera::Focus;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Radius of the largest disk, in heights of the picture.
pub(crate) const LARGEST: f64 = 1.0 / 16.0;

/// Side of the blocks that know how far their pixels reach.
const BLOCK: usize = 16;

/// How far outside a region pixels matter to it, in pixels, in a picture of a height.
pub(crate) fn margin(height: u32) -> u32 {
    (f64::from(height) * LARGEST).ceil() as u32 + 1
}

/// The picture `rgba` with depth of field, `height` rows high as a whole; rows run on the current threads.
pub(crate) fn blur(
    rgba: &Raster<[f32; 4]>,
    depth: &Raster<f32>,
    camera: &CameraRays,
    focus: &Focus,
    height: u32,
) -> Raster<[f32; 4]> {
    let source = Source::new(rgba, depth, camera, focus, f64::from(height) * LARGEST);
    let columns = source.columns;
    let row = |y: usize| -> Vec<[f32; 4]> { (0..columns).map(|x| source.gather(x, y)).collect() };
    let rows: Vec<Vec<[f32; 4]>> = (0..source.rows).into_par_iter().map(row).collect();
    Raster { window: rgba.window, pixels: rows.concat() }
}

/// A pixel of the sharp picture.
#[derive(Clone, Copy, Debug)]
struct Spot {
    rgba: Vec4,
    depth: f32,
    /// Radius of its disk in pixels.
    radius: f32,
    /// One over the sum of the disk's weights.
    share: f32,
    /// Nearer than what is in focus: its disk is the iris upside down.
    is_near: bool,
}

/// The sharp picture and how far each part of it reaches.
struct Source {
    columns: usize,
    rows: usize,
    spots: Vec<Spot>,
    /// Per block, the largest radius that matters to its pixels.
    reach: Vec<f32>,
    disk: Disk,
}

/// A weighted sum of colours.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    rgba: Vec4,
    weight: f32,
}

impl Source {
    fn new(
        rgba: &Raster<[f32; 4]>,
        depth: &Raster<f32>,
        camera: &CameraRays,
        focus: &Focus,
        largest: f64,
    ) -> Self {
        let disk = Disk::new(focus.blades, focus.blade_rotation, largest);
        let spot = |(&rgba, &depth): (&[f32; 4], &f32)| {
            let radius = camera.blur_radius(focus, f64::from(depth)).min(largest) as f32;
            let (rgba, share) = (Vec4::from_array(rgba), disk.share(radius));
            Spot { rgba, depth, radius, share, is_near: depth < focus.distance }
        };
        let spots: Vec<Spot> = rgba.pixels.iter().zip(&depth.pixels).map(spot).collect();
        let (columns, rows) = (rgba.window.width() as usize, rgba.window.height() as usize);
        let reach = reach(columns, rows, &spots);
        Self { columns, rows, spots, reach, disk }
    }

    /// What pixel `(x, y)` becomes.
    fn gather(&self, x: usize, y: usize) -> [f32; 4] {
        let spot = &self.spots[y * self.columns + x];
        let reach = self.reach[y / BLOCK * self.columns.div_ceil(BLOCK) + x / BLOCK];
        // A disk that ends half a pixel from the next centre changes nothing.
        let reach = (reach + 0.5).ceil() as usize - usize::from(reach <= 0.5);
        if reach == 0 {
            return spot.rgba.to_array();
        }
        let (mut nearer, mut rest, mut received) = (Sum::default(), Sum::default(), 0);
        for row in y.saturating_sub(reach)..(y + reach + 1).min(self.rows) {
            // Corners of the square lie outside of every disk.
            let reach = half_chord(reach, row.abs_diff(y));
            let columns = x.saturating_sub(reach)..(x + reach + 1).min(self.columns);
            let weights = self.disk.row(row as i32 - y as i32, columns.start as i32 - x as i32);
            let others = &self.spots[row * self.columns..][columns];
            for (other, [far, near]) in others.iter().zip(weights) {
                // What lies behind is seen through this pixel's disk, all else by its own.
                let by = if other.depth > spot.depth { spot } else { other };
                let weight = edge(by.radius, if by.is_near { *near } else { *far }) * by.share;
                if weight > 0.0 {
                    received += 1;
                    let sum = if other.depth < spot.depth { &mut nearer } else { &mut rest };
                    sum.rgba += weight * other.rgba;
                    sum.weight += weight;
                }
            }
        }
        if received == 1 { spot.rgba.to_array() } else { over(&nearer, &rest).to_array() }
    }
}

/// Half the chord of a circle of radius `reach` + 1 at a distance of `rows` from its centre, rounded up.
fn half_chord(reach: usize, rows: usize) -> usize {
    let square = (reach + 1) * (reach + 1) - rows * rows;
    reach.min(square.isqrt() + 1)
}

/// The nearer sum, which covers by its weight, over the rest, normalised.
///
/// Written so that what is 1 in all parts stays 1 to the bit: an opaque picture stays opaque.
fn over(nearer: &Sum, rest: &Sum) -> Vec4 {
    // The pixel itself is part of the rest: its weight is not 0.
    let rest = rest.rgba / rest.weight;
    if nearer.weight == 0.0 {
        return rest;
    }
    rest + nearer.weight.min(1.0) * (nearer.rgba / nearer.weight - rest)
}

/// Per block, the largest radius among the pixels whose disks touch the block.
fn reach(columns: usize, rows: usize, spots: &[Spot]) -> Vec<f32> {
    let (across, down) = (columns.div_ceil(BLOCK), rows.div_ceil(BLOCK));
    let mut largest = vec![0.0_f32; across * down];
    for (i, spot) in spots.iter().enumerate() {
        let block = &mut largest[i / columns / BLOCK * across + i % columns / BLOCK];
        *block = block.max(spot.radius);
    }
    let all = largest.iter().copied().fold(0.0, f32::max);
    let blocks = (all + 1.0) as usize / BLOCK + 1;
    let around = |i: usize, n: usize| i.saturating_sub(blocks)..(i + blocks + 1).min(n);
    let gap = |a: usize, b: usize| (a.abs_diff(b).saturating_sub(1) * BLOCK) as f32;
    let touching = |x: usize, y: usize| {
        around(y, down)
            .flat_map(|v| around(x, across).map(move |u| (u, v)))
            .map(|(u, v)| (largest[v * across + u], gap(x, u).max(gap(y, v))))
            .filter(|&(radius, gap)| radius + 1.0 >= gap)
            .fold(0.0, |most: f32, (radius, _)| most.max(radius))
    };
    (0..across * down).map(|i| touching(i % across, i / across)).collect()
}

#[cfg(test)]
mod tests;
