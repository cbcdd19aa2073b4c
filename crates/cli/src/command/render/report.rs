//! `--stats`: what a run took, as JSON. Names and units are a promise to scripts.

use super::trace::Traced;
use crate::command::index::stats_json;
use crate::diagnose::Failure;
use crate::memory;
use heliostat_io::atomic::write_atomically;
use heliostat_render::{RayCounters, RenderStats};
use heliostat_scene::scene::TextureBytes;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What a run took so far.
#[derive(Debug)]
pub(super) struct Report {
    scene: PathBuf,
    started: Instant,
    threads: usize,
    frames: Vec<Value>,
    warnings: Vec<String>,
    sum: Sum,
    /// Of the frame that was rendered last.
    index: Vec<Value>,
    textures: TextureBytes,
}

/// Sums over the frames.
#[derive(Debug, Default)]
struct Sum {
    rays: RayCounters,
    samples: u64,
    non_finite: u64,
    seconds: Seconds,
}

/// Wall clock by phase.
#[derive(Clone, Copy, Debug, Default)]
struct Seconds {
    load: f64,
    prepare: f64,
    trace: f64,
    resolve: f64,
    save: f64,
}

impl Report {
    /// A run over this scene begins; 0 threads are one per processor.
    pub(super) fn new(scene: &Path, threads: usize, started: Instant) -> Self {
        // Until here the scene was read.
        let opened = Seconds { load: started.elapsed().as_secs_f64(), ..Seconds::default() };
        let all = std::thread::available_parallelism().map_or(1, usize::from);
        Self {
            scene: scene.to_owned(),
            started,
            threads: if threads == 0 { all } else { threads },
            frames: Vec::new(),
            warnings: Vec::new(),
            sum: Sum { seconds: opened, ..Sum::default() },
            index: Vec::new(),
            textures: TextureBytes::default(),
        }
    }

    /// A frame is done, with the files it is in, and the seconds for loading and saving it.
    pub(super) fn add(&mut self, frame: i32, traced: &Traced, saved: &[PathBuf], load: f64, save: f64) {
        let stats = &traced.stats;
        let seconds = Seconds {
            load,
            prepare: stats.seconds.prepare,
            trace: stats.seconds.trace,
            resolve: stats.seconds.resolve,
            save,
        };
        self.frames.push(json!({
            "frame": frame,
            "outputs": saved.iter().map(|path| path.to_string_lossy()).collect::<Vec<_>>(),
            "finished": traced.finished,
            "samples": stats.samples,
            "mean_samples_per_pixel": traced.mean_samples,
            "relative_error": traced.error,
            "non_finite_samples": stats.non_finite_samples,
            "seconds": seconds.json(),
            "rays": rays_json(&stats.rays),
            "rays_per_second": per_second(&stats.rays, stats.seconds.trace),
        }));
        self.index = index_json(stats);
        self.sum.add(stats, seconds);
    }

    /// The images of a frame take so much memory; the frame with the most counts.
    pub(super) fn add_textures(&mut self, textures: TextureBytes) {
        if textures.pixels > self.textures.pixels {
            self.textures = textures;
        }
    }

    /// Something that the user was told.
    pub(super) fn warn(&mut self, warning: String) {
        self.warnings.push(warning);
    }

    /// Writes all of it.
    pub(super) fn write(&self, path: &Path, interrupted: bool) -> Result<(), Failure> {
        let text = format!("{:#}\n", self.json(interrupted));
        Ok(write_atomically(path, |out| out.write_all(text.as_bytes()))?)
    }

    fn json(&self, interrupted: bool) -> Value {
        let mut seconds = self.sum.seconds.json();
        seconds["total"] = json!(self.started.elapsed().as_secs_f64());
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "scene": self.scene.to_string_lossy(),
            "threads": self.threads,
            "interrupted": interrupted,
            "seconds": seconds,
            "samples": self.sum.samples,
            "non_finite_samples": self.sum.non_finite,
            "rays": rays_json(&self.sum.rays),
            "rays_per_second": per_second(&self.sum.rays, self.sum.seconds.trace),
            "textures": { "bytes": self.textures.pixels, "mip_bytes": self.textures.mips },
            "peak_memory_bytes": memory::peak(),
            "index": self.index,
            "warnings": self.warnings,
            "frames": self.frames,
        })
    }
}

impl Sum {
    fn add(&mut self, stats: &RenderStats, seconds: Seconds) {
        self.rays += stats.rays;
        self.samples += stats.samples;
        self.non_finite += stats.non_finite_samples;
        self.seconds.load += seconds.load;
        self.seconds.prepare += seconds.prepare;
        self.seconds.trace += seconds.trace;
        self.seconds.resolve += seconds.resolve;
        self.seconds.save += seconds.save;
    }
}

impl Seconds {
    fn json(self) -> Value {
        json!({
            "load": self.load,
            "prepare": self.prepare,
            "trace": self.trace,
            "resolve": self.resolve,
            "save": self.save,
        })
    }
}

fn rays_json(rays: &RayCounters) -> Value {
    json!({
        "camera": rays.camera,
        "reflection": rays.reflection,
        "scatter": rays.scatter,
        "refraction": rays.refraction,
        "shadow": rays.shadow,
        "ambient_occlusion": rays.ao,
        "total": rays.total(),
    })
}

fn per_second(rays: &RayCounters, seconds: f64) -> f64 {
    if seconds > 0.0 { rays.total() as f64 / seconds } else { 0.0 }
}

fn index_json(stats: &RenderStats) -> Vec<Value> {
    let each = stats.indices.iter().map(|index| {
        let mut entry = stats_json(&index.tree);
        entry["name"] = json!(index.name);
        entry
    });
    each.collect()
}
