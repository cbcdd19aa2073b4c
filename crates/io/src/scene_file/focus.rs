//! `focus = { .. }` of a camera: depth of field.
//!
//! # Scene file
//! ```toml
//! [camera.focus]
//! distance = 5                   # metres to the plane that is sharp, at right angles to the view; or
//! # at = "ball"                  # a point or the name of an object in that plane
//! f_number = 2.8                 # lens opening: focal length / (2 f_number); or
//! # lens_radius = 0.01           # metres
//! blades = 6                     # of the iris; 0, a round one, if left out, else at least 3
//! blade_rotation = 0             # degrees
//! method = "lens"                # "post": a blur made from the depth buffer
//! ```

use super::camera::CameraTable;
use super::choice::{choice, exactly_one, without_effect};
use super::number::{NonNegative, Number, Positive, Whole};
use super::targets::Targets;
use super::value::Target;
use crate::document::{Fault, Placed};
use glam::DAffine3;
use heliostat_scene::camera::{Focus, FocusMethod};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Millimetres in a metre.
const MILLIMETRES: f64 = 1000.0;

/// Depth of field.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FocusTable {
    /// Distance in metres to the plane that is sharp.
    pub distance: Option<Placed<Positive>>,
    /// A point or the name of an object in the plane that is sharp.
    pub at: Option<Placed<Target>>,
    /// Focal length over the diameter of the lens opening.
    pub f_number: Option<Placed<Positive>>,
    /// Radius of the lens opening in metres.
    pub lens_radius: Option<Placed<NonNegative>>,
    /// Blades of the iris: 0 for a round one, else 3 to 64; 0 if left out.
    pub blades: Option<Placed<Whole<0, 64>>>,
    /// Turn of the iris in degrees; 0 if left out.
    pub blade_rotation: Option<Placed<Number>>,
    /// How the blur is made; `lens` if left out.
    pub method: Option<FocusMethodName>,
}

/// How depth of field is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FocusMethodName {
    /// Rays through a thin lens.
    Lens,
    /// A blur made from the depth buffer after rendering.
    Post,
}

impl Placed<FocusTable> {
    /// The focus of the scene, for `camera` at `pose`.
    pub(super) fn build(
        &self,
        camera: &CameraTable,
        pose: &DAffine3,
        targets: &Targets<'_>,
    ) -> Result<Focus, Fault> {
        let blades = self.blades.as_ref().map_or(0, |blades| blades.u32());
        if matches!(blades, 1 | 2) {
            return Err(Fault::new(format!("an iris of {blades} blades has no opening"))
                .with_help("choose 0 for a round one, or at least 3")
                .or_at(self.blades.as_ref().and_then(Placed::span)));
        }
        if blades == 0 {
            let rotation = choice("blade_rotation", self.blade_rotation.as_ref());
            without_effect("on a round iris", &[rotation])?;
        }
        Ok(Focus {
            distance: self.distance(pose, targets)?,
            lens_radius: self.lens_radius(camera)?,
            blades,
            blade_rotation: self.blade_rotation.as_ref().map_or(0.0, |r| r.get().to_radians() as f32),
            method: match self.method {
                None | Some(FocusMethodName::Lens) => FocusMethod::Lens,
                Some(FocusMethodName::Post) => FocusMethod::Post,
            },
        })
    }

    fn distance(&self, pose: &DAffine3, targets: &Targets<'_>) -> Result<f32, Fault> {
        let choices = [choice("distance", self.distance.as_ref()), choice("at", self.at.as_ref())];
        exactly_one("the focus", "distance", self.span(), &choices)?;
        let Some(at) = &self.at else {
            return Ok(self.distance.as_ref().map_or(0.0, |distance| distance.f32()));
        };
        // Along the view: the plane that is sharp stands at right angles to it.
        let depth = -pose.matrix3.z_axis.dot(targets.resolve(at)? - pose.translation);
        match Positive::new(depth) {
            Some(depth) => Ok(depth.f32()),
            None => Err(Fault::new("the focus is not in front of the camera")
                .with_help("choose a point that the camera sees, or `distance`")
                .or_at(at.span())),
        }
    }

    fn lens_radius(&self, camera: &CameraTable) -> Result<f32, Fault> {
        let choices =
            [choice("f_number", self.f_number.as_ref()), choice("lens_radius", self.lens_radius.as_ref())];
        exactly_one("the focus", "lens opening", self.span(), &choices)?;
        let Some(f_number) = &self.f_number else {
            return Ok(self.lens_radius.as_ref().map_or(0.0, |radius| radius.f32()));
        };
        let focal_length = camera.focal_length().ok_or_else(|| {
            Fault::new("`f_number` needs a focal length, which only a perspective camera has")
                .with_help("use `lens_radius`")
                .or_at(f_number.span())
        })?;
        Ok((focal_length / MILLIMETRES / (2.0 * f_number.get())) as f32)
    }
}
