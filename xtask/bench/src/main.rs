//! Heliostat's index against others on the same rays, and how it grows; `cargo xtask bench index` runs it.

mod contestant;
mod embree;
mod measure;
mod meshes;
mod ours;
mod rays;
mod report;
mod theirs;

use clap::Parser;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

/// Compare the index with obvhs and, where its library is given, with Embree
#[derive(Debug, Parser)]
#[command(name = "cargo xtask bench index")]
struct Args {
    /// Folder with OBJ files, searched with all folders below it
    #[arg(long, value_name = "FOLDER")]
    meshes: Option<PathBuf>,

    /// Only files whose path contains this
    #[arg(long, default_value = "", value_name = "TEXT")]
    only: String,

    /// Triangles of generated meshes to trace as well
    #[arg(long, value_delimiter = ',', value_name = "LIST")]
    generated: Vec<usize>,

    /// Leave out meshes with fewer triangles
    #[arg(long, default_value_t = 0)]
    least: usize,

    /// Embree 4, as a shared library (the Python packages `embreex` and `bpy` carry one)
    #[arg(long, value_name = "LIB")]
    embree: Option<PathBuf>,

    /// Settings for the Embree device, such as `max_isa=avx2`
    #[arg(long, default_value = "", value_name = "TEXT")]
    embree_config: String,

    /// Trees of ours to trace, by preset; the first one is `ours` in ratios; `balanced-batch` asks all rays at once
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "balanced,balanced-batch,fast,best,midpoint",
        value_name = "LIST"
    )]
    presets: Vec<String>,

    /// Only this back end of ours: portable, sse4.1, avx2 or avx512
    #[arg(long, value_name = "NAME")]
    backend: Option<String>,

    /// Presets of obvhs to trace; `none` for none
    #[arg(long, value_delimiter = ',', default_value = "fast,medium,very_slow", value_name = "LIST")]
    obvhs: Vec<String>,

    /// Width and height of the picture that primary rays make
    #[arg(long, default_value_t = 512)]
    size: usize,

    /// Rounds in which all take turns
    #[arg(long, default_value_t = 5)]
    rounds: usize,

    /// Write the rates as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,

    /// Build meshes of so many triangles instead: seconds, bytes, and the gain of threads
    #[arg(long, value_delimiter = ',', value_name = "LIST")]
    growth: Vec<usize>,
}

fn main() -> ExitCode {
    match report::run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            let _ = writeln!(std::io::stderr(), "error: {message}");
            ExitCode::FAILURE
        }
    }
}
