//! Choosing among lights by the tree, by power and evenly: error against a reference, time, and what comes of both.

use super::{generated, median};
use crate::Outcome;
use crate::heliostat::Heliostat;
use crate::process::{capture, root, run as execute, say};
use serde_json::Value;

const CHOICES: [&str; 3] = ["tree", "power", "uniform"];
const REFERENCE: &str = "out/bench/reference.exr";

/// Renders a generated scene with each choice in turn and prints a Markdown table.
pub(crate) fn run(count: usize, rounds: usize, samples: u32) -> Outcome {
    let heliostat = Heliostat::build()?;
    let scene = generated::lights(count)?;
    say("the reference");
    render(&heliostat, &scene, "tree", 16 * samples, 1_000_000, REFERENCE)?;
    let mut found = CHOICES.map(|_| (Vec::new(), Vec::new()));
    for round in 0..rounds {
        for (choice, (errors, seconds)) in CHOICES.iter().zip(&mut found) {
            let picture = "out/bench/lights.exr";
            seconds.push(render(&heliostat, &scene, choice, samples, round, picture)?);
            errors.push(squared_error(&heliostat, picture)?);
        }
    }
    let rows = found.map(|(errors, seconds)| {
        let error = errors.iter().sum::<f64>() / errors.len() as f64;
        (error, median(seconds))
    });
    let efficiency = |(error, seconds): (f64, f64)| 1.0 / (error * seconds);
    let even = efficiency(rows[CHOICES.len() - 1]);
    say(&format!(
        "| {count} lights, {samples} samples | RMSE | seconds | efficiency against uniform |\n|---|---:|---:|---:|"
    ));
    for (choice, row) in CHOICES.iter().zip(rows) {
        say(&format!("| {choice} | {:.4} | {:.2} | {:.1} |", row.0.sqrt(), row.1, efficiency(row) / even));
    }
    Ok(())
}

/// The seconds of tracing.
pub(super) fn render(
    heliostat: &Heliostat,
    scene: &str,
    choice: &str,
    samples: u32,
    seed: usize,
    picture: &str,
) -> Result<f64, String> {
    let (samples, stats) = (samples.to_string(), "out/bench/stats.json");
    let mut command = heliostat.command(&["render", scene, "-o", picture, "--progress", "none"]);
    command.args(["--threads", "2", "--samples", &samples, "--seed", &seed.to_string(), "--stats", stats]);
    command.args(["--set", &format!("render.light_choice={choice}")]);
    execute(command)?;
    let text = std::fs::read_to_string(root().join(stats)).map_err(|e| format!("{stats}: {e}"))?;
    let stats: Value = serde_json::from_str(&text).map_err(|e| format!("{stats}: {e}"))?;
    stats["seconds"]["trace"].as_f64().ok_or_else(|| "the statistics name no seconds".to_owned())
}

fn squared_error(heliostat: &Heliostat, picture: &str) -> Result<f64, String> {
    let text = capture(heliostat.command(&["compare", REFERENCE, picture, "--json"]))?;
    let told: Value = serde_json::from_str(&text).map_err(|e| format!("compare: {e}"))?;
    told["rmse"].as_f64().map(|rmse| rmse * rmse).ok_or_else(|| "compare names no error".to_owned())
}
