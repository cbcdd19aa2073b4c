//! Time per sample against lights and against triangles.

use super::lights::render;
use super::{generated, median};
use crate::Outcome;
use crate::heliostat::Heliostat;
use crate::process::say;

const LIGHTS: [usize; 6] = [1, 10, 100, 1_000, 10_000, 100_000];
const TRIANGLES: [usize; 4] = [10_000, 100_000, 1_000_000, 10_000_000];
const SAMPLES: u32 = 16;
const PIXELS: f64 = 320.0 * 180.0;

/// Renders generated scenes of growing size, in turns, and prints two Markdown tables.
pub(crate) fn run(rounds: usize) -> Outcome {
    let heliostat = Heliostat::build()?;
    let scenes: Vec<_> = LIGHTS.iter().map(|&count| generated::lights(count)).collect::<Result<_, _>>()?;
    let counted: Vec<_> = LIGHTS.iter().map(|count| count.to_string()).zip(scenes).collect();
    say(&table("lights", &measured(&heliostat, &counted, rounds)?));
    let balls: Vec<_> = TRIANGLES.iter().map(|&count| generated::ball(count)).collect::<Result<_, _>>()?;
    let counted: Vec<_> = balls.into_iter().map(|(name, count)| (count.to_string(), name)).collect();
    say(&table("triangles", &measured(&heliostat, &counted, rounds)?));
    Ok(())
}

/// Microseconds per sample for each scene.
fn measured(
    heliostat: &Heliostat,
    scenes: &[(String, String)],
    rounds: usize,
) -> Result<Vec<(String, f64)>, String> {
    let mut seconds = vec![Vec::new(); scenes.len()];
    for round in 0..rounds {
        for ((_, scene), seconds) in scenes.iter().zip(&mut seconds) {
            seconds.push(render(heliostat, scene, "tree", SAMPLES, round, "out/bench/growth.exr")?);
        }
    }
    let micros = seconds.into_iter().map(|s| 1e6 * median(s) / (PIXELS * f64::from(SAMPLES)));
    Ok(scenes.iter().map(|(count, _)| count.clone()).zip(micros).collect())
}

fn table(what: &str, rows: &[(String, f64)]) -> String {
    let mut table = format!("| {what} | µs per sample | against the first |\n|---:|---:|---:|\n");
    let first = rows.first().map_or(f64::NAN, |row| row.1);
    for (count, micros) in rows {
        table.push_str(&format!("| {count} | {micros:.3} | {:.2} |\n", micros / first));
    }
    table
}
