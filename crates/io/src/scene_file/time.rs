//! `[time]`: frames, and how long the shutter is open.
//!
//! Frame n shows the moment `(n - first_frame) / frame_rate` seconds. The shutter opens half of its time before
//! that moment and closes half after, so that a blurred thing lies around the place where a sharp picture shows
//! it; what cannot be blurred (lights, materials, focus) is as it is at that moment.
//!
//! # Scene file
//! ```toml
//! [time]
//! frame_rate = 24                # frames per second
//! first_frame = 1
//! last_frame = 96                # the frame of the last key if left out
//! shutter = 0.5                  # share of a frame that the shutter is open; 0: no motion blur
//! ```

use super::number::{Fraction, Positive, Whole};
use crate::document::{Fault, Placed};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// A frame number.
pub type FrameNumber = Whole<-1_000_000, 1_000_000>;

/// Frames per second.
const FRAME_RATE: f64 = 24.0;

/// Frames, and how long the shutter is open.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TimeTable {
    /// Frames per second; 24 if left out.
    pub frame_rate: Option<Positive>,
    /// Number of the frame at 0 seconds; 1 if left out.
    pub first_frame: Option<FrameNumber>,
    /// Number of the last frame; that of the last key if left out.
    pub last_frame: Option<Placed<FrameNumber>>,
    /// Share of a frame that the shutter is open; 0, no motion blur, if left out.
    pub shutter: Option<Fraction>,
}

impl TimeTable {
    /// Frames per second.
    pub(crate) fn frame_rate(&self) -> f64 {
        self.frame_rate.map_or(FRAME_RATE, Positive::get)
    }

    /// Number of the frame at 0 seconds.
    pub(crate) fn first_frame(&self) -> i32 {
        self.first_frame.map_or(1, |frame| frame.get() as i32)
    }

    /// Seconds of a frame.
    pub(crate) fn seconds(&self, frame: i32) -> f64 {
        (f64::from(frame) - f64::from(self.first_frame())) / self.frame_rate()
    }

    /// Seconds that the shutter is open.
    pub(crate) fn exposure(&self) -> f64 {
        self.shutter.map_or(0.0, Fraction::get) / self.frame_rate()
    }

    /// The frames, when the file has more than one; `last_key` is the time of the last keyframe.
    pub(crate) fn frames(&self, last_key: Option<f64>) -> Option<RangeInclusive<i32>> {
        let first = self.first_frame();
        let last = match (&self.last_frame, last_key) {
            (Some(last), _) => last.get() as i32,
            (None, Some(seconds)) => {
                let count = (seconds * self.frame_rate()).ceil().clamp(0.0, f64::from(i32::MAX / 2));
                first.saturating_add(count as i32)
            }
            (None, None) => return None,
        };
        Some(first..=last)
    }

    /// Refuses an end before the beginning.
    pub(super) fn check(&self) -> Result<(), Fault> {
        match &self.last_frame {
            Some(last) if last.get() < i64::from(self.first_frame()) => {
                Err(Fault::new("`last_frame` lies before `first_frame`")
                    .with_help(format!("choose at least {}", self.first_frame()))
                    .or_at(last.span()))
            }
            _ => Ok(()),
        }
    }
}
