//! Measurements that anyone can repeat: on the release build, medians of interleaved rounds, as Markdown tables.

pub(crate) mod convergence;
mod generated;
pub(crate) mod growth;
pub(crate) mod lights;
pub(crate) mod peers;
mod plot;
pub(crate) mod scenes;

use crate::Outcome;
use crate::process::{cargo, run, say};
use std::process::Command;
use std::time::Instant;

/// The index on its own, in a program of its own: it links what it is compared with.
pub(crate) fn index(flags: &[String]) -> Outcome {
    let mut args = vec!["run", "--release", "--package", "xtask-bench", "--"];
    args.extend(flags.iter().map(String::as_str));
    run(cargo(&args))
}

/// Seconds of wall clock that a command takes; fails when the command does.
fn seconds(mut command: Command) -> Result<f64, String> {
    let start = Instant::now();
    let output = command.output().map_err(|e| format!("{:?}: {e}", command.get_program()))?;
    let elapsed = start.elapsed().as_secs_f64();
    if output.status.success() {
        return Ok(elapsed);
    }
    say(&String::from_utf8_lossy(&output.stderr));
    Err(format!("{:?} ended with {}", command.get_program(), output.status))
}

/// The middle of the sorted values.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
