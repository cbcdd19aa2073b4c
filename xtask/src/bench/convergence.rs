//! How fast pictures become right: the error of each integrator with each sampler against the number of samples, as a plot and a table.
//!
//! The reference of an integrator is rendered in the same run, with other random numbers and sixteen times as many samples as the
//! longest of its curves; its own error keeps a curve from falling below a quarter of its last point.

use super::plot::{Curve, Plot};
use crate::Outcome;
use crate::heliostat::{Heliostat, stem};
use crate::process::{capture, root, run as execute, say};
use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

const FOLDER: &str = "out/convergence";
/// How much more samples a reference has than the last point of a curve.
const REFERENCE: u32 = 16;
/// Stands for `path` that learns where light comes from; what it takes to learn is counted.
const GUIDED: &str = "path_guided";
/// The random numbers of references, unlike those of the curves, which have seed 0 and above.
const OTHER_SEED: u32 = 1_000_003;

/// What is measured.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Scenes to render
    #[arg(default_values = ["scenes/path_sky.toml", "scenes/standard.toml", "scenes/path_cornell.toml", "scenes/guiding.toml"])]
    scenes: Vec<String>,
    /// Integrators; `path_guided` is `path` with guiding
    #[arg(long, value_delimiter = ',', default_values = ["direct", "path_simple", "path", GUIDED])]
    integrators: Vec<String>,
    /// Samplers
    #[arg(long, value_delimiter = ',', default_values = ["white", "blue"])]
    samplers: Vec<String>,
    /// Most samples per pixel of a curve; the curve has all powers of two up to it
    #[arg(long, default_value_t = 64)]
    samples: u32,
    /// Width and height of the pictures
    #[arg(long, default_value = "96x96")]
    size: String,
    /// Pictures per point, each with other random numbers
    #[arg(long, default_value_t = 2)]
    seeds: u32,
    /// Write all numbers into this file
    #[arg(long)]
    json: Option<PathBuf>,
}

/// One integrator with one sampler on one scene.
struct Series {
    scene: String,
    integrator: String,
    sampler: String,
    points: Vec<Point>,
}

#[derive(Clone, Copy)]
struct Point {
    samples: u32,
    rmse: f64,
    /// Of tracing, for one picture.
    seconds: f64,
}

/// Renders all curves, draws a plot for each scene and prints the table.
pub(crate) fn run(flags: &Flags) -> Outcome {
    std::fs::create_dir_all(root().join(FOLDER)).map_err(|e| format!("{FOLDER}: {e}"))?;
    let bench = Bench { heliostat: Heliostat::build()?, flags };
    let mut all = Vec::new();
    for scene in &flags.scenes {
        let series = bench.scene(scene)?;
        let plot = root().join(FOLDER).join(format!("{}.png", stem(scene)));
        draw(stem(scene), &series, &plot)?;
        say(&format!("wrote {}", plot.display()));
        all.extend(series);
    }
    say(&table(&all));
    let Some(path) = &flags.json else { return Ok(()) };
    let text = format!("{:#}\n", Value::Array(all.iter().map(Series::json).collect()));
    std::fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}

struct Bench<'a> {
    heliostat: Heliostat,
    flags: &'a Flags,
}

/// A picture to render.
struct Job<'a> {
    scene: &'a str,
    integrator: &'a str,
    sampler: &'a str,
    samples: u32,
    seed: u32,
}

impl Bench<'_> {
    /// All curves of a scene.
    fn scene(&self, scene: &str) -> Result<Vec<Series>, String> {
        let mut series = Vec::new();
        for integrator in &self.flags.integrators {
            let reference = format!("{FOLDER}/reference.exr");
            let samples = self.flags.samples.saturating_mul(REFERENCE);
            let job =
                Job { scene, integrator: oracle(integrator), sampler: "white", samples, seed: OTHER_SEED };
            self.render(&job, &reference)?;
            for sampler in &self.flags.samplers {
                let points = self.points(scene, integrator, sampler, &reference)?;
                let (scene, integrator, sampler) = (stem(scene).into(), integrator.clone(), sampler.clone());
                series.push(Series { scene, integrator, sampler, points });
            }
        }
        Ok(series)
    }

    /// The curve of an integrator with a sampler.
    fn points(
        &self,
        scene: &str,
        integrator: &str,
        sampler: &str,
        reference: &str,
    ) -> Result<Vec<Point>, String> {
        let doubled = |n: &u32| n.checked_mul(2).filter(|&n| n <= self.flags.samples);
        let numbers = std::iter::successors(Some(1), doubled);
        let point = |samples| {
            let (mut squares, mut seconds) = (0.0, 0.0);
            for seed in 0..self.flags.seeds {
                let image = format!("{FOLDER}/image.exr");
                seconds += self.render(&Job { scene, integrator, sampler, samples, seed }, &image)?;
                squares += self.rmse(reference, &image)?.powi(2);
            }
            let pictures = f64::from(self.flags.seeds.max(1));
            Ok(Point { samples, rmse: (squares / pictures).sqrt(), seconds: seconds / pictures })
        };
        numbers.map(point).collect()
    }

    /// Renders a picture; the seconds of tracing.
    fn render(&self, job: &Job<'_>, path: &str) -> Result<f64, String> {
        let (samples, seed) = (job.samples.to_string(), job.seed.to_string());
        let sampler = format!("render.sampler={}", job.sampler);
        let (integrator, guiding) = named(job.integrator);
        let stats = format!("{FOLDER}/stats.json");
        let mut command = self.heliostat.command(&["render", job.scene, "-o", path, "--exr-depth", "float"]);
        command.args(["--size", &self.flags.size, "--samples", &samples, "--seed", &seed]);
        command.args([
            "--integrator",
            integrator,
            "--set",
            &sampler,
            "--set",
            guiding,
            "--stats",
            &stats,
            "--progress",
            "none",
        ]);
        // What it prints is not asked for.
        command.stdout(std::process::Stdio::null());
        execute(command)?;
        let text = std::fs::read_to_string(root().join(&stats)).map_err(|e| format!("{stats}: {e}"))?;
        let stats: Value = serde_json::from_str(&text).map_err(|e| format!("stats: {e}"))?;
        number(&stats["seconds"]["trace"])
    }

    /// How far a picture is from its reference.
    fn rmse(&self, reference: &str, image: &str) -> Result<f64, String> {
        let text = capture(self.heliostat.command(&["compare", reference, image, "--json"]))?;
        let found: Value = serde_json::from_str(&text).map_err(|e| format!("compare: {e}"))?;
        number(&found["rmse"])
    }
}

/// The name that scene files have for an integrator, and whether it is guided.
fn named(integrator: &str) -> (&str, &str) {
    if integrator == GUIDED { ("path", "render.guiding=learn") } else { (integrator, "render.guiding=none") }
}

/// The integrator that says what is right for another: the same picture, found sooner.
fn oracle(integrator: &str) -> &str {
    if integrator == "path_simple" { "path" } else { integrator }
}

fn number(value: &Value) -> Result<f64, String> {
    value.as_f64().ok_or_else(|| format!("`{value}` is no number"))
}

impl Series {
    fn name(&self) -> String {
        format!("{}, {}", self.integrator, self.sampler)
    }

    /// The exponent of the samples in the error: the line of least squares through the logarithms.
    fn slope(&self) -> f64 {
        let logs = self.points.iter().map(|p| (f64::from(p.samples).ln(), p.rmse.ln()));
        slope(&logs.collect::<Vec<_>>())
    }

    /// One over squared error times seconds, at the last point: twice as much is half the time for the same picture.
    fn efficiency(&self) -> f64 {
        self.points.last().map_or(f64::NAN, |p| 1.0 / (p.rmse * p.rmse * p.seconds))
    }

    fn json(&self) -> Value {
        let point = |p: &Point| json!({ "samples": p.samples, "rmse": p.rmse, "seconds": p.seconds });
        json!({
            "scene": self.scene,
            "integrator": self.integrator,
            "sampler": self.sampler,
            "slope": self.slope(),
            "efficiency": self.efficiency(),
            "points": self.points.iter().map(point).collect::<Vec<_>>(),
        })
    }
}

/// The slope of the line of least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let products: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    products / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

fn draw(scene: &str, series: &[Series], path: &Path) -> Outcome {
    let points = |s: &Series| s.points.iter().map(|p| (f64::from(p.samples), p.rmse)).collect();
    let curve = |s: &Series| Curve { name: format!("{}  {:.2}", s.name(), s.slope()), points: points(s) };
    let curves = series.iter().map(curve).collect();
    let title = format!("{scene}: RMSE against samples per pixel; behind the names the slopes");
    Plot { title, curves }.save(path)
}

fn table(series: &[Series]) -> String {
    let mut table = String::from(
        "| scene | integrator | sampler | samples | RMSE | slope | seconds | 1 / (RMSE² s) |\n|---|---|---|---:|---:|---:|---:|---:|\n",
    );
    for s in series {
        let Some(last) = s.points.last() else { continue };
        let (n, rmse, seconds) = (last.samples, last.rmse, last.seconds);
        let (slope, efficiency) = (s.slope(), s.efficiency());
        let names = format!("{} | {} | {}", s.scene, s.integrator, s.sampler);
        table.push_str(&format!(
            "| {names} | {n} | {rmse:.5} | {slope:.2} | {seconds:.2} | {efficiency:.3e} |\n"
        ));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_its_exponent_as_slope() {
        let points: Vec<_> = (0..8).map(|i| (f64::from(i), 3.0 - 0.5 * f64::from(i))).collect();
        assert!((slope(&points) + 0.5).abs() < 1e-12);
    }
}
