//! Every scene at 1280x720 with 16 samples: seconds, rays per second, memory.

use crate::Outcome;
use crate::heliostat::{Heliostat, scenes, stem};
use crate::process::{root, run as execute, say};
use serde_json::Value;

/// Renders each scene once and prints a Markdown table.
pub(crate) fn run() -> Outcome {
    std::fs::create_dir_all(root().join("out/bench")).map_err(|e| format!("out/bench: {e}"))?;
    let heliostat = Heliostat::build()?;
    let mut table = String::from(
        "| scene | seconds | million rays | million rays/s | peak MiB |\n|---|---:|---:|---:|---:|\n",
    );
    for scene in scenes("scenes")? {
        let stats = "out/bench/stats.json";
        let size = ["--size", "1280x720", "--samples", "16", "--progress", "none", "--stats", stats];
        let mut command = heliostat.command(&["render", &scene, "-o", "out/bench/frame.png"]);
        command.args(size);
        execute(command)?;
        table.push_str(&row(stem(&scene), &root().join(stats))?);
    }
    say(&table);
    Ok(())
}

/// One line of the table from the statistics of a rendering.
fn row(name: &str, stats: &std::path::Path) -> Result<String, String> {
    let text = std::fs::read_to_string(stats).map_err(|e| format!("{}: {e}", stats.display()))?;
    let stats: Value = serde_json::from_str(&text).map_err(|e| format!("{name}: {e}"))?;
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let seconds = number(&stats["seconds"]["total"]);
    let rays = number(&stats["rays"]["total"]) / 1e6;
    let peak = number(&stats["peak_memory_bytes"]) / f64::from(1 << 20);
    Ok(format!("| {name} | {seconds:.2} | {rays:.1} | {:.2} | {peak:.0} |\n", rays / seconds))
}
