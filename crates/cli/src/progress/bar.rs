//! Progress as a bar in the terminal.

use super::{Snapshot, text};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::Duration;

/// Steps of the bar: finer than any terminal is wide.
const STEPS: u64 = 10_000;
const TEMPLATE: &str = "{prefix:.cyan.bold}{bar:30.cyan/blue} {percent:>3}%  {msg}";

/// A bar with elapsed and remaining time, rays per second and memory.
#[derive(Debug)]
pub(super) struct Bar(ProgressBar);

impl Bar {
    pub(super) fn new() -> Self {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr_with_hz(10));
        // The template is a constant that a test compiles; a plain bar would do as well.
        if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
            bar.set_style(style.progress_chars("=> "));
        }
        Self(bar)
    }

    pub(super) fn begin(&self, frame: i32, number: usize, frames: usize, activity: &str) {
        if frames > 1 {
            self.0.set_prefix(format!("frame {frame} ({number}/{frames}) "));
        }
        self.0.set_message(activity.to_owned());
        self.0.enable_steady_tick(Duration::from_millis(200));
    }

    pub(super) fn tell(&self, snapshot: &Snapshot) {
        let left = snapshot.remaining.map_or_else(|| "?".to_owned(), text::clock);
        let memory = snapshot.memory.map_or_else(String::new, |m| format!("  {}", text::bytes(m)));
        let rays = text::thousands(snapshot.rays_per_second, "rays/s");
        self.0.set_position((snapshot.fraction * STEPS as f64) as u64);
        let elapsed = text::clock(snapshot.elapsed);
        self.0.set_message(format!("{elapsed} elapsed, {left} left  {rays}{memory}"));
    }

    pub(super) fn suspend(&self, print: impl FnOnce()) {
        self.0.suspend(print);
    }

    pub(super) fn finish(&self) {
        self.0.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_compiles() {
        assert!(ProgressStyle::with_template(TEMPLATE).is_ok());
    }
}
