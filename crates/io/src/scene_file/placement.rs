//! Where a thing stands: scale, then rotate, then translate; or a matrix.
//!
//! # Scene file
//! ```toml
//! scale     = 2                  # or [x, y, z]; negative numbers mirror
//! rotate    = [0, 90, 0]         # degrees about x, then y, then z, counter-clockwise seen from the tip of the axis
//! translate = [0, 1, 0]          # metres
//! ```
//! or, in place of the three, three rows of four numbers (a fourth row must be `[0, 0, 0, 1]`):
//! ```toml
//! matrix = [[1, 0, 0, 0], [0, 1, 0, 1], [0, 0, 1, 0]]
//! ```

use super::choice::{Choice, choice, without_effect};
use super::number::{NonZero, Number};
use super::value::{Point, Splat, vector};
use crate::document::{Fault, Placed, Span};
use glam::{DAffine3, DMat3, DVec3};
use heliostat_geometry::Transform;

/// Three rows of four numbers, or four.
pub type Matrix = Vec<[Number; 4]>;

/// Borrows the keys that place a thing.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacementKeys<'a> {
    pub(super) scale: Option<&'a Placed<Splat<NonZero, 3>>>,
    pub(super) rotate: Option<&'a Placed<Point>>,
    pub(super) translate: Option<&'a Placed<Point>>,
    pub(super) matrix: Option<&'a Placed<Matrix>>,
}

impl PlacementKeys<'_> {
    /// The map from local to world space.
    ///
    /// # Errors
    /// When a matrix stands beside the other keys, has the wrong form or no inverse.
    pub(super) fn affine(&self) -> Result<DAffine3, Fault> {
        let (affine, span) = match self.matrix {
            Some(matrix) => {
                without_effect("beside `matrix`", &self.parts())?;
                (affine_from_rows(matrix)?, matrix.span())
            }
            None => (self.composed(), self.scale.and_then(Placed::span)),
        };
        match Transform::new(affine) {
            Some(_) => Ok(affine),
            None => Err(singular(span)),
        }
    }

    /// The keys that a matrix replaces.
    pub(super) fn parts(&self) -> [Choice; 3] {
        [choice("scale", self.scale), choice("rotate", self.rotate), choice("translate", self.translate)]
    }

    fn composed(&self) -> DAffine3 {
        let scale = self.scale.map_or(DVec3::ONE, |s| DVec3::from_array(s.values().map(NonZero::get)));
        let rotate = self.rotate.map_or(DVec3::ZERO, |r| vector(r));
        let translate = self.translate.map_or(DVec3::ZERO, |t| vector(t));
        let matrix = rotation(rotate) * DMat3::from_diagonal(scale);
        DAffine3 { matrix3: matrix, translation: translate }
    }
}

/// The turn about x, then y, then z, by angles in degrees.
pub(super) fn rotation(degrees: DVec3) -> DMat3 {
    DMat3::from_cols_array_2d(&turn_z(degrees.z))
        * DMat3::from_cols_array_2d(&turn_y(degrees.y))
        * DMat3::from_cols_array_2d(&turn_x(degrees.x))
}

fn turn_x(degrees: f64) -> [[f64; 3]; 3] {
    let (sin, cos) = sin_cos(degrees);
    [[1.0, 0.0, 0.0], [0.0, cos, sin], [0.0, -sin, cos]]
}

fn turn_y(degrees: f64) -> [[f64; 3]; 3] {
    let (sin, cos) = sin_cos(degrees);
    [[cos, 0.0, -sin], [0.0, 1.0, 0.0], [sin, 0.0, cos]]
}

fn turn_z(degrees: f64) -> [[f64; 3]; 3] {
    let (sin, cos) = sin_cos(degrees);
    [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]
}

/// Sine and cosine, exact at quarter turns, so that a box turned by 90 degrees stays flush with its neighbours.
fn sin_cos(degrees: f64) -> (f64, f64) {
    let quarters = (degrees / 90.0).round();
    let (sin, cos) = (degrees - 90.0 * quarters).to_radians().sin_cos();
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

fn affine_from_rows(matrix: &Placed<Matrix>) -> Result<DAffine3, Fault> {
    let rows: Vec<[f64; 4]> = matrix.iter().map(|row| row.map(Number::get)).collect();
    let has_form = match rows.as_slice() {
        [_, _, _] => true,
        [_, _, _, last] => *last == [0.0, 0.0, 0.0, 1.0],
        _ => false,
    };
    if !has_form {
        return Err(Fault::new("expected three rows of four numbers")
            .with_help("a fourth row may only be [0, 0, 0, 1]")
            .or_at(matrix.span()));
    }
    let column = |i: usize| DVec3::new(rows[0][i], rows[1][i], rows[2][i]);
    Ok(DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) })
}

fn singular(span: Option<Span>) -> Fault {
    Fault::new("the transform has no inverse: it flattens what it places")
        .with_help("choose scales other than 0 and rows that do not depend on each other")
        .or_at(span)
}

/// Implements `placement_keys` for a table that has the four keys.
macro_rules! impl_placement_keys {
    ($table:ty) => {
        impl $table {
            /// The keys that place this in the world.
            pub(super) fn placement_keys(&self) -> $crate::scene_file::placement::PlacementKeys<'_> {
                $crate::scene_file::placement::PlacementKeys {
                    scale: self.scale.as_ref(),
                    rotate: self.rotate.as_ref(),
                    translate: self.translate.as_ref(),
                    matrix: self.matrix.as_ref(),
                }
            }
        }
    };
}
pub(super) use impl_placement_keys;
