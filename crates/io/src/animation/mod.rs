//! `[[animation]]`: keyframes on any number of the scene file.
//!
//! The target is a path through the file: a section, the name of one of its tables where it has several, and
//! keys; an index, or `x`, `y`, `z`, picks a component. Names with dots in them stand in quotes:
//! `object."a.b".translate`. Before the first key and after the last the value rests.
//!
//! | interpolation | between two keys |
//! |---|---|
//! | `step` | the value of the first; serves texts and `true` / `false` as well |
//! | `linear` | a straight line |
//! | `smooth` | a cubic without kinks, never outside the range of its two keys, at rest at the first and last key |
//!
//! # Scene file
//! ```toml
//! [[animation]]
//! target = "object.ball.translate.1"  # camera.fov, camera.NAME.position, material.glass.phong.ior, render.samples
//! interpolation = "smooth"            # if left out
//! keys = [[0.0, 0.5], [1.0, 2.0], [2.0, 0.5]]   # [seconds, value]
//! ```

mod curve;
mod keyframe;
mod track;

pub use keyframe::{KeyValue, Keyframe};
pub(crate) use track::Track;

use crate::document::Placed;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Keyframes of one value of the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AnimationTable {
    /// Path to the value, as in `object.ball.translate`.
    pub target: Placed<String>,
    /// What happens between the keys; `smooth` if left out.
    pub interpolation: Option<InterpolationName>,
    /// Keys `[seconds, value]` in the order of time.
    pub keys: Placed<Vec<Placed<Keyframe>>>,
}

/// What happens between keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InterpolationName {
    /// The value of the last key.
    Step,
    /// A straight line.
    Linear,
    /// A cubic without kink or overshoot.
    #[default]
    Smooth,
}
