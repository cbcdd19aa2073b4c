//! Filters of FLIP: the contrast sensitivity of the eye, and detectors of edges and points. All are separable, or sums
//! of two that are; beyond the border the border goes on.
//!
//! # Source
//! HPG 2020, sections 4.1.1 (contrast sensitivity, after Mullen 1985 and Johnson & Fairchild 2003) and 4.2.

use std::f32::consts::PI;

/// One number per pixel.
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) values: Vec<f32>,
}

/// A sum of Gaussians with weights, all of the same radius.
pub(super) struct Blur(Vec<(f32, Vec<f32>)>);

/// All filters for a viewing distance.
pub(super) struct Kernels {
    pub(super) achromatic: Blur,
    pub(super) red_green: Blur,
    pub(super) blue_yellow: Blur,
    /// First derivative of a Gaussian.
    pub(super) edge: Vec<f32>,
    /// Second derivative of a Gaussian.
    pub(super) point: Vec<f32>,
    /// The Gaussian across them.
    pub(super) smooth: Vec<f32>,
}

/// Weight and width of the Gaussians of blue and yellow, the widest.
const BLUE_YELLOW: [[f32; 2]; 2] = [[34.1, 0.04], [13.5, 0.025]];

impl Kernels {
    pub(super) fn new(pixels_per_degree: f32) -> Self {
        let reach = (BLUE_YELLOW[0][1] / (2.0 * PI * PI)).sqrt();
        let radius = (3.0 * reach * pixels_per_degree).ceil() as i32;
        let blur = |gaussians: &[[f32; 2]]| Blur::new(gaussians, radius, pixels_per_degree);
        /// Distance from peak to trough of the edge filter of the eye, in degrees.
        const WIDTH: f32 = 0.082;
        let deviation = 0.5 * WIDTH * pixels_per_degree;
        let reach = (3.0 * deviation).ceil() as i32;
        let along = |shape: &dyn Fn(f32) -> f32| {
            let gaussian = |x: f32| (-x * x / (2.0 * deviation * deviation)).exp();
            (-reach..=reach).map(|x| shape(x as f32) * gaussian(x as f32)).collect::<Vec<_>>()
        };
        Self {
            achromatic: blur(&[[1.0, 0.0047]]),
            red_green: blur(&[[1.0, 0.0053]]),
            blue_yellow: blur(&BLUE_YELLOW),
            edge: balance(along(&|x| -x)),
            point: balance(along(&|x| x * x / (deviation * deviation) - 1.0)),
            smooth: balance(along(&|_| 1.0)),
        }
    }
}

/// Scales positive weights to the sum 1 and negative ones to the sum -1.
fn balance(mut kernel: Vec<f32>) -> Vec<f32> {
    let sum = |sign: f32| kernel.iter().map(|v| (v * sign).max(0.0)).sum::<f32>();
    let [positive, negative] = [sum(1.0), sum(-1.0)];
    kernel.iter_mut().for_each(|v| *v /= if *v < 0.0 { negative } else { positive });
    kernel
}

impl Blur {
    fn new(gaussians: &[[f32; 2]], radius: i32, pixels_per_degree: f32) -> Self {
        let part = |&[weight, width]: &[f32; 2]| {
            let kernel = (-radius..=radius).map(|x| {
                let degrees = x as f32 / pixels_per_degree;
                (-PI * PI * degrees * degrees / width).exp()
            });
            (weight * (PI / width).sqrt(), kernel.collect::<Vec<_>>())
        };
        let mut parts: Vec<_> = gaussians.iter().map(part).collect();
        // In two dimensions the sum of a separable kernel is the square of the sum in one.
        let total: f32 =
            parts.iter().map(|(weight, kernel)| weight * kernel.iter().sum::<f32>().powi(2)).sum();
        parts.iter_mut().for_each(|(weight, _)| *weight /= total);
        Self(parts)
    }

    pub(super) fn apply(&self, plane: &Plane) -> Plane {
        let mut sum = Plane { width: plane.width, values: vec![0.0; plane.values.len()] };
        for (weight, kernel) in &self.0 {
            let part = convolve(plane, kernel, kernel);
            sum.values.iter_mut().zip(part.values).for_each(|(s, v)| *s += weight * v);
        }
        sum
    }
}

/// The correlation of a plane with one kernel along rows and another along columns.
pub(super) fn convolve(plane: &Plane, along_rows: &[f32], along_columns: &[f32]) -> Plane {
    let rows = convolve_rows(plane, along_rows);
    convolve_columns(&rows, along_columns)
}

fn convolve_rows(plane: &Plane, kernel: &[f32]) -> Plane {
    let width = plane.width;
    let radius = kernel.len() / 2;
    let mut padded = vec![0.0; width + 2 * radius];
    let mut out = vec![0.0; plane.values.len()];
    for (row, out) in plane.values.chunks(width).zip(out.chunks_mut(width)) {
        padded[..radius].fill(row[0]);
        padded[radius..radius + width].copy_from_slice(row);
        padded[radius + width..].fill(row[width - 1]);
        for (k, weight) in kernel.iter().enumerate() {
            out.iter_mut().zip(&padded[k..]).for_each(|(o, v)| *o += weight * v);
        }
    }
    Plane { width, values: out }
}

fn convolve_columns(plane: &Plane, kernel: &[f32]) -> Plane {
    let width = plane.width;
    let rows: Vec<_> = plane.values.chunks(width).collect();
    let radius = kernel.len() / 2;
    let mut out = vec![0.0; plane.values.len()];
    for (y, out) in out.chunks_mut(width).enumerate() {
        for (k, weight) in kernel.iter().enumerate() {
            let source = rows[(y + k).saturating_sub(radius).min(rows.len() - 1)];
            out.iter_mut().zip(source).for_each(|(o, v)| *o += weight * v);
        }
    }
    Plane { width, values: out }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_planes_stay_and_show_no_features() {
        let plane = Plane { width: 5, values: vec![0.7; 15] };
        let kernels = Kernels::new(67.0);
        for blur in [&kernels.achromatic, &kernels.red_green, &kernels.blue_yellow] {
            assert!(blur.apply(&plane).values.iter().all(|v| (v - 0.7).abs() < 1e-5));
        }
        for kernel in [&kernels.edge, &kernels.point] {
            assert!(convolve(&plane, kernel, &kernels.smooth).values.iter().all(|v| v.abs() < 1e-5));
        }
    }

    #[test]
    fn an_edge_has_the_strength_of_its_step() {
        // Half the weights of the detector sum to 1: a step of 0.4 gives 0.4 at the step.
        let values = (0..64).map(|i| if i % 64 < 32 { 0.2 } else { 0.6 }).collect();
        let plane = Plane { width: 64, values };
        let kernels = Kernels::new(67.0);
        let found = convolve(&plane, &kernels.edge, &kernels.smooth).values;
        let strongest = found.iter().fold(0.0_f32, |m, v| m.max(v.abs()));
        assert!((strongest - 0.4).abs() < 1e-5, "{strongest}");
    }
}
