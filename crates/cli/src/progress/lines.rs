//! Progress as lines: plain for people and Afanasy, `ALF_PROGRESS` for Deadline and Houdini's farms, JSON for programs.

use super::Snapshot;
use crate::out;
use serde_json::json;
use std::path::Path;
use std::sync::atomic::{AtomicU8, Ordering};

/// The look of the lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    /// `PROGRESS: 42%`.
    Plain,
    /// `ALF_PROGRESS 42%`.
    Alf,
    /// One object per line, `event` says which.
    Json,
}

/// Writes lines; of each whole percent one, so that a log stays short.
#[derive(Debug)]
pub(super) struct Lines {
    style: Style,
    /// The percent that was told last.
    told: AtomicU8,
}

/// No percent is this.
const NOTHING: u8 = u8::MAX;

impl Lines {
    pub(super) fn new(style: Style) -> Self {
        Self { style, told: AtomicU8::new(NOTHING) }
    }

    pub(super) fn is_json(&self) -> bool {
        self.style == Style::Json
    }

    pub(super) fn begin(&self, frame: i32, number: usize, frames: usize) {
        match self.style {
            Style::Plain if frames > 1 => out::note(format_args!("FRAME: {frame} ({number} of {frames})")),
            Style::Plain | Style::Alf => {}
            Style::Json => {
                event(&json!({ "event": "frame", "frame": frame, "number": number, "frames": frames }));
            }
        }
    }

    pub(super) fn tell(&self, snapshot: &Snapshot) {
        // Rounded down: 100 % is the whole run.
        let percent = (snapshot.fraction.clamp(0.0, 1.0) * 100.0) as u8;
        if self.told.swap(percent, Ordering::Relaxed) == percent {
            return;
        }
        match self.style {
            Style::Plain => out::note(format_args!("PROGRESS: {percent}%")),
            Style::Alf => out::note(format_args!("ALF_PROGRESS {percent}%")),
            Style::Json => event(&json!({
                "event": "progress",
                "frame": snapshot.frame,
                "number": snapshot.number,
                "frames": snapshot.frames,
                "percent": percent,
                "elapsed_seconds": snapshot.elapsed.as_secs_f64(),
                "remaining_seconds": snapshot.remaining.map(|t| t.as_secs_f64()),
                "rays_per_second": snapshot.rays_per_second,
                "memory_bytes": snapshot.memory,
            })),
        }
    }

    pub(super) fn saved(&self, frame: i32, path: &Path) {
        if self.is_json() {
            event(&json!({ "event": "saved", "frame": frame, "path": path.to_string_lossy() }));
        }
    }

    pub(super) fn warning(&self, message: &str) {
        event(&json!({ "event": "warning", "message": message }));
    }
}

fn event(event: &serde_json::Value) {
    out::note(format_args!("{event}"));
}
