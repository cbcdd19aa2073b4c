//! `[camera]`, or several `[[camera]]` with names: where from, which projection.
//!
//! A camera without `look_at` looks along -z. Pictures are `up` side up; a camera that looks straight up or down
//! and names no `up` has -z at the upper border.
//!
//! # Scene file
//! ```toml
//! [camera]
//! name = "main"                  # `camera`, `camera2`, ... if left out
//! position = [0, 1, 5]           # [0, 0, 0] if left out
//! look_at = [0, 1, 0]            # or the name of an object
//! up = [0, 1, 0]
//! projection = "perspective"     # see below
//! fov = 40                       # degrees between the lower and the upper border; or
//! # focal_length = 50            # millimetres, with
//! # sensor_height = 24           # millimetres
//! focus = { distance = 5, f_number = 2.8 }   # depth of field; see the module `focus`
//! ```
//!
//! | projection | keys |
//! |---|---|
//! | `perspective` | `fov` (40), or `focal_length` and `sensor_height` (24) |
//! | `orthographic` | `height` in metres (2) |
//! | `fisheye` | `fov` (180), the full angle |
//! | `panorama` | none: all around |
//! | `cylindrical` | `fov_x` (180) and `fov` (60) |

use super::choice::{choice, without_effect};
use super::focus::FocusTable;
use super::number::{Positive, Turn};
use super::targets::Targets;
use super::value::{Point, Target, vector};
use crate::document::{Fault, Placed, Span};
use glam::{DAffine3, DMat3, DVec3};
use heliostat_scene::camera::Projection;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Height of a full-frame sensor in millimetres.
const SENSOR_HEIGHT: f64 = 24.0;
/// Degrees between the lower and the upper border in perspective.
const FOV: f64 = 40.0;
/// Degrees across a fisheye picture.
const FISHEYE_FOV: f64 = 180.0;
/// Degrees between left and right, lower and upper border of a cylindrical picture.
const CYLINDER_FOV: (f64, f64) = (180.0, 60.0);
/// Height of an orthographic picture in metres.
const HEIGHT: f64 = 2.0;

/// Where from, which projection, how sharp.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraTable {
    /// Name, unique among cameras; `camera`, `camera2`, ... if left out.
    pub name: Option<Placed<String>>,
    /// Position in metres; the origin if left out.
    pub position: Option<Point>,
    /// A point or the name of an object in the middle of the picture; straight along -z if left out.
    pub look_at: Option<Placed<Target>>,
    /// The direction of the upper border; `[0, 1, 0]` if left out.
    pub up: Option<Placed<Point>>,
    /// How directions map to the picture; `perspective` if left out.
    pub projection: Option<ProjectionName>,
    /// Angle in degrees between the lower and the upper border; of a fisheye, across the picture.
    pub fov: Option<Placed<Turn>>,
    /// Angle in degrees between the left and the right border of a cylindrical picture.
    pub fov_x: Option<Placed<Turn>>,
    /// Focal length in millimetres, in place of `fov`.
    pub focal_length: Option<Placed<Positive>>,
    /// Height of the sensor in millimetres, for `focal_length` and `f_number`; 24 if left out.
    pub sensor_height: Option<Placed<Positive>>,
    /// Height of an orthographic picture in metres.
    pub height: Option<Placed<Positive>>,
    /// Depth of field; sharp everywhere if left out.
    pub focus: Option<Placed<FocusTable>>,
}

/// How directions map to the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ProjectionName {
    /// Straight lines stay straight.
    #[default]
    Perspective,
    /// Parallel rays.
    Orthographic,
    /// The distance from the middle grows with the angle.
    Fisheye,
    /// All around: a whole turn in x, half a turn in y.
    Panorama,
    /// A turn in x, perspective in y.
    Cylindrical,
}

impl CameraTable {
    /// From the space of the camera to the world.
    pub(super) fn pose(&self, targets: &Targets<'_>) -> Result<DAffine3, Fault> {
        let position = self.eye();
        let forward = match &self.look_at {
            Some(target) => targets.direction(position, target)?,
            None => DVec3::NEG_Z,
        };
        let right = match &self.up {
            Some(up) => forward.cross(super::targets::unit(up)?).try_normalize().ok_or_else(|| {
                Fault::new("the camera looks along `up`")
                    .with_help("choose another direction for the upper border")
                    .or_at(up.span())
            })?,
            // Straight up or down: -z takes the place of +y, and x stays to the right.
            None => forward.cross(DVec3::Y).try_normalize().unwrap_or(DVec3::X),
        };
        let up = right.cross(forward);
        Ok(DAffine3 { matrix3: DMat3::from_cols(right, up, -forward), translation: position })
    }

    /// Position in world space.
    pub(super) fn eye(&self) -> DVec3 {
        self.position.as_ref().map_or(DVec3::ZERO, vector)
    }

    /// How directions map to the picture.
    pub(super) fn projection(&self) -> Result<Projection, Fault> {
        let radians = |degrees: f64| degrees.to_radians() as f32;
        let fov = |absent: f64| self.fov.as_ref().map_or(absent, |fov| fov.get());
        let [fov_key, fov_x, focal, sensor, height] = [
            choice("fov", self.fov.as_ref()),
            choice("fov_x", self.fov_x.as_ref()),
            choice("focal_length", self.focal_length.as_ref()),
            choice("sensor_height", self.sensor_height.as_ref()),
            choice("height", self.height.as_ref()),
        ];
        match self.projection.unwrap_or_default() {
            ProjectionName::Perspective => {
                without_effect("in perspective", &[fov_x, height])?;
                Ok(Projection::Perspective { fov_y: self.perspective_fov()? as f32 })
            }
            ProjectionName::Orthographic => {
                without_effect("on an orthographic camera", &[fov_key, fov_x, focal, sensor])?;
                let height = self.height.as_ref().map_or(HEIGHT, |h| h.get());
                Ok(Projection::Orthographic { height: height as f32 })
            }
            ProjectionName::Fisheye => {
                without_effect("on a fisheye", &[fov_x, focal, sensor, height])?;
                Ok(Projection::Fisheye { fov: radians(fov(FISHEYE_FOV)) })
            }
            ProjectionName::Panorama => {
                without_effect("on a panorama", &[fov_key, fov_x, focal, sensor, height])?;
                Ok(Projection::Panorama)
            }
            ProjectionName::Cylindrical => {
                without_effect("on a cylindrical camera", &[focal, sensor, height])?;
                self.check_below_half_turn()?;
                let fov_x = self.fov_x.as_ref().map_or(CYLINDER_FOV.0, |fov| fov.get());
                Ok(Projection::Cylindrical { fov_x: radians(fov_x), fov_y: radians(fov(CYLINDER_FOV.1)) })
            }
        }
    }

    /// Angle in radians between the lower and the upper border in perspective.
    fn perspective_fov(&self) -> Result<f64, Fault> {
        let Some(focal_length) = &self.focal_length else {
            self.check_below_half_turn()?;
            if self.focus.is_none() {
                let sensor = choice("sensor_height", self.sensor_height.as_ref());
                without_effect("without `focal_length` or `f_number`", &[sensor])?;
            }
            return Ok(self.fov.as_ref().map_or(FOV, |fov| fov.get()).to_radians());
        };
        super::choice::at_most_one(&[
            choice("focal_length", self.focal_length.as_ref()),
            choice("fov", self.fov.as_ref()),
        ])?;
        Ok(2.0 * (0.5 * self.sensor_height() / focal_length.get()).atan())
    }

    fn check_below_half_turn(&self) -> Result<(), Fault> {
        match &self.fov {
            Some(fov) if fov.get() >= 180.0 => Err(Fault::new(format!(
                "expected an angle below 180 degrees for this projection, found {}",
                fov.get()
            ))
            .with_help("choose a smaller `fov`, or projection = \"fisheye\"")
            .or_at(fov.span())),
            _ => Ok(()),
        }
    }

    fn sensor_height(&self) -> f64 {
        self.sensor_height.as_ref().map_or(SENSOR_HEIGHT, |height| height.get())
    }

    /// Focal length in millimetres, given or of the field of view on the sensor; only perspective has one.
    pub(super) fn focal_length(&self) -> Option<f64> {
        if self.projection.unwrap_or_default() != ProjectionName::Perspective {
            return None;
        }
        let from_fov = || {
            let fov = self.fov.as_ref().map_or(FOV, |fov| fov.get());
            0.5 * self.sensor_height() / (0.5 * fov.to_radians()).tan()
        };
        Some(self.focal_length.as_ref().map_or_else(from_fov, |f| f.get()))
    }
}

/// One `[camera]`, or several `[[camera]]`.
#[derive(Clone, Debug, PartialEq)]
pub enum Cameras {
    /// `[camera]`.
    One(Box<CameraTable>),
    /// `[[camera]]`.
    Many(Vec<Placed<CameraTable>>),
}

impl Default for Cameras {
    fn default() -> Self {
        Self::Many(Vec::new())
    }
}

impl Placed<Cameras> {
    /// The cameras with the places of their tables.
    pub(super) fn tables(&self) -> Vec<(&CameraTable, Option<Span>)> {
        match &**self {
            Cameras::One(camera) => vec![(camera, self.span())],
            Cameras::Many(cameras) => cameras.iter().map(|camera| (&**camera, camera.span())).collect(),
        }
    }
}
