//! How far two pictures are apart: root mean square, relative error, largest error, and what an eye sees (FLIP).

mod difference;
pub mod flip;
mod numbers;

pub use difference::difference_frame;
pub use numbers::{ChannelNumbers, Numbers, compare_channels};

use crate::picture::Picture;
use glam::Vec3;

/// What kind of pictures are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Pictures for a display: light is clipped to `[0, 1]`.
    Ldr,
    /// Light without an upper end, looked at in all sensible exposures.
    Hdr,
}

/// The result of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Size of both pictures.
    pub width: u32,
    /// Size of both pictures.
    pub height: u32,
    /// Errors in numbers.
    pub numbers: Numbers,
    /// FLIP error of every pixel in `[0, 1]`, row by row from the top.
    pub flip: Vec<f32>,
}

impl Comparison {
    /// The mean of the FLIP errors: 0 where the pictures are equal, 1 at worst.
    pub fn mean_flip(&self) -> f64 {
        self.flip.iter().map(|&v| f64::from(v)).sum::<f64>() / self.flip.len() as f64
    }
}

/// Compares the colours of two pictures over black, at the viewing distance of [`flip::PIXELS_PER_DEGREE`].
///
/// A pixel that is not finite in one picture, and not the same in the other, has the largest error there is.
///
/// # Errors
/// With a sentence, when the pictures differ in size or have no pixels.
pub fn compare(reference: &Picture, test: &Picture, range: Range) -> Result<Comparison, String> {
    let (width, height) = (reference.width, reference.height);
    if (width, height) != (test.width, test.height) {
        return Err(format!("{width} x {height} pixels and {} x {} pixels", test.width, test.height));
    }
    if reference.pixels.is_empty() {
        return Err("there are no pixels".to_owned());
    }
    let numbers = Numbers::of(reference, test);
    // Equal pictures are the common case in tests.
    let mut flip = if reference == test {
        vec![0.0; reference.pixels.len()]
    } else {
        let [a, b] = [reference, test].map(|p| p.pixels.iter().map(|p| p.truncate()).collect::<Vec<Vec3>>());
        let size = [width as usize, height as usize];
        match range {
            Range::Ldr => flip::ldr(&a, &b, size, flip::PIXELS_PER_DEGREE),
            Range::Hdr => flip::hdr(&a, &b, size, flip::PIXELS_PER_DEGREE),
        }
    };
    for (error, (a, b)) in flip.iter_mut().zip(reference.pixels.iter().zip(&test.pixels)) {
        if numbers::is_broken(*a, *b) {
            *error = 1.0;
        }
    }
    Ok(Comparison { width, height, numbers, flip })
}
