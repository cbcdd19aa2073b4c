//! The five projections: from a place in the picture to a ray in the space of the camera.
//!
//! The camera sits in the origin and looks along `-z`, `+y` up and `+x` to the right. Places in the picture are
//! in pixels, `(0, 0)` the upper left corner of the upper left pixel, y downward; they may lie outside, for filters
//! reach over the border. All of it in `f64`: at 16384 columns the angle between two samples of a pixel is below
//! what `f32` resolves.
//!
//! # Orientation of the turning projections
//! The centre of the picture is the direction in which the camera looks, the columns to the right turn to the right,
//! and left and right border of a full turn are the same direction, bit for bit. The rows of a panorama go from
//! straight up to straight down; those of a cylinder are as in a perspective picture.

use glam::{DVec2, DVec3};
use heliostat_scene::camera::Projection;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A projection with the size of its picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Picture {
    projection: Projection,
    /// Columns and rows.
    size: DVec2,
    /// Half of the height at depth 1, where there is such a height.
    half_height: f64,
}

/// A ray in the space of the camera, before the lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LocalRay {
    /// The origin, except for parallel rays.
    pub(super) origin: DVec3,
    /// Not unit.
    pub(super) dir: DVec3,
}

impl Picture {
    pub(super) fn new(projection: Projection, width: u32, height: u32) -> Self {
        let half_height = match projection {
            Projection::Perspective { fov_y } | Projection::Cylindrical { fov_y, .. } => {
                (0.5 * f64::from(fov_y)).tan()
            }
            Projection::Orthographic { height } => 0.5 * f64::from(height),
            Projection::Fisheye { .. } | Projection::Panorama => 0.0,
        };
        Self { projection, size: DVec2::new(f64::from(width), f64::from(height)), half_height }
    }

    /// Whether points at equal depth lie in a plane across the view; on a sphere around the camera if not.
    pub(super) fn is_flat(&self) -> bool {
        matches!(self.projection, Projection::Perspective { .. } | Projection::Orthographic { .. })
    }

    /// The ray through `place`; `None` where the projection leaves the picture empty.
    pub(super) fn ray(&self, place: DVec2) -> Option<LocalRay> {
        let through = |dir| LocalRay { origin: DVec3::ZERO, dir };
        match self.projection {
            Projection::Perspective { .. } => {
                let at = self.off_centre(place) * self.half_height;
                Some(through(at.extend(-1.0)))
            }
            Projection::Orthographic { .. } => {
                let at = self.off_centre(place) * self.half_height;
                Some(LocalRay { origin: at.extend(0.0), dir: DVec3::NEG_Z })
            }
            Projection::Fisheye { fov } => self.fisheye(place, f64::from(fov)).map(through),
            Projection::Panorama => {
                let height = PI * (0.5 - place.y / self.size.y);
                let level = self.turn(place.x, TAU);
                Some(through((level * height.cos()).with_y(height.sin())))
            }
            Projection::Cylindrical { fov_x, .. } => {
                let height = (1.0 - 2.0 * place.y / self.size.y) * self.half_height;
                Some(through(self.turn(place.x, f64::from(fov_x)).with_y(height)))
            }
        }
    }

    /// Pixels per unit of the tangent of the angle off the axis, in the middle of the picture; per metre where rays
    /// are parallel.
    pub(super) fn pixels_per_slope(&self) -> f64 {
        match self.projection {
            Projection::Perspective { .. } | Projection::Cylindrical { .. } => {
                0.5 * self.size.y / self.half_height
            }
            Projection::Orthographic { height } => self.size.y / f64::from(height),
            Projection::Fisheye { fov } => self.size.min_element() / f64::from(fov),
            Projection::Panorama => self.size.y / PI,
        }
    }

    /// Whether rays are parallel.
    pub(super) fn is_parallel(&self) -> bool {
        matches!(self.projection, Projection::Orthographic { .. })
    }

    /// The scale of a flat picture: metres in x and y, at depth 1 or at any depth, from the centre to the border.
    pub(super) fn half_extent(&self) -> Option<DVec2> {
        self.is_flat().then(|| DVec2::new(self.half_height * self.size.x / self.size.y, self.half_height))
    }

    /// From the centre, x to the right and y up, in halves of the height.
    fn off_centre(&self, place: DVec2) -> DVec2 {
        DVec2::new(2.0 * place.x - self.size.x, self.size.y - 2.0 * place.y) / self.size.y
    }

    /// The angle off the axis grows with the distance from the centre; `fov` is the circle that touches the
    /// shorter borders.
    fn fisheye(&self, place: DVec2, fov: f64) -> Option<DVec3> {
        let at = self.off_centre(place) * (self.size.y / self.size.min_element());
        let radius = at.length();
        if radius > 1.0 {
            return None;
        }
        let (sin, cos) = (0.5 * fov * radius).sin_cos();
        let across = if radius > 0.0 { at * (sin / radius) } else { DVec2::ZERO };
        Some(across.extend(-cos))
    }

    /// The level unit direction of a column when the picture's width is an angle of `fov`.
    fn turn(&self, x: f64, fov: f64) -> DVec3 {
        // Columns a whole turn apart are the same number before the sine sees them: no seam.
        let turns = fov / TAU * (x / self.size.x - 0.5);
        let (sin, cos) = sin_cos_of_turns(turns);
        DVec3::new(sin, 0.0, -cos)
    }
}

/// Sine and cosine of an angle in turns, the same for all whole turns more and exact on the axes.
fn sin_cos_of_turns(turns: f64) -> (f64, f64) {
    let quarters = 4.0 * (turns - turns.round());
    let nearest = quarters.round();
    let (sin, cos) = ((quarters - nearest) * FRAC_PI_2).sin_cos();
    match nearest as i32 {
        0 => (sin, cos),
        1 => (cos, -sin),
        -1 => (-cos, sin),
        _ => (-sin, -cos),
    }
}
