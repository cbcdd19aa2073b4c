//! The project's chores, each behind one word: `cargo xtask ci | tidy | assets | gallery | bench`.

mod assets;
mod bench;
mod ci;
mod gallery;
mod heliostat;
mod process;
mod tidy;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// What a chore returns: nothing, or one line that says what went wrong.
type Outcome = Result<(), String>;

#[derive(Parser)]
#[command(name = "cargo xtask", about = "The project's chores")]
struct Args {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Everything a change must pass: fmt, clippy, rustdoc, tidy, tests.
    Ci {
        /// Also the slow checks: 20,000 cases per law, full ray counts, release tests, assets made anew.
        #[arg(long)]
        deep: bool,
    },
    /// Check what the compiler does not: the import graph, file sizes, headers, left-overs, links.
    Tidy,
    /// Generate the meshes and textures that the scenes use, and the picture in the docs of the index.
    Assets,
    /// Render every scene and write scenes/README.md.
    Gallery {
        /// Render only scenes whose name contains this; the page lists all.
        #[arg(default_value = "")]
        only: String,
        /// Render whole animations, and make videos where ffmpeg is found.
        #[arg(long)]
        videos: bool,
    },
    /// Measure.
    #[command(subcommand)]
    Bench(Bench),
    /// Render golden pictures anew: all, or those named. Look at them before you commit them.
    Golden {
        /// Names of scenes.
        names: Vec<String>,
    },
}

#[derive(Subcommand)]
enum Bench {
    /// Every scene at 1280x720 with 16 samples.
    Scenes,
    /// The index against obvhs and, where its library is given, Embree; `-- --help` lists the flags.
    Index {
        /// Flags of the comparison.
        #[arg(last = true)]
        flags: Vec<String>,
    },
    /// Choosing among many lights by the tree, by power and evenly, on a generated scene.
    Lights {
        /// How many lights.
        #[arg(long, default_value_t = 10_000)]
        count: usize,
        /// Rounds, in which all take turns.
        #[arg(long, default_value_t = 3)]
        rounds: usize,
        /// Samples per pixel; the reference takes 16 times as many.
        #[arg(long, default_value_t = 64)]
        samples: u32,
    },
    /// Time per sample against 1 to 100,000 lights, and against 10,000 to 10 million triangles, generated.
    Growth {
        /// Rounds, in which all take turns.
        #[arg(long, default_value_t = 3)]
        rounds: usize,
    },
    /// The error against the number of samples: plots into out/convergence, slopes and efficiency as a table.
    Convergence(bench::convergence::Flags),
    /// Against POV-Ray on the same scene, where povray is found.
    Peers {
        /// Rounds, in which both take turns.
        #[arg(long, default_value_t = 5)]
        rounds: usize,
    },
}

fn main() -> ExitCode {
    let outcome = match Args::parse().chore {
        Chore::Ci { deep } => ci::run(deep),
        Chore::Tidy => tidy::run(),
        Chore::Assets => assets::run(),
        Chore::Gallery { only, videos } => gallery::run(&only, videos),
        Chore::Bench(Bench::Scenes) => bench::scenes::run(),
        Chore::Bench(Bench::Index { flags }) => bench::index(&flags),
        Chore::Bench(Bench::Lights { count, rounds, samples }) => bench::lights::run(count, rounds, samples),
        Chore::Bench(Bench::Growth { rounds }) => bench::growth::run(rounds),
        Chore::Bench(Bench::Convergence(flags)) => bench::convergence::run(&flags),
        Chore::Bench(Bench::Peers { rounds }) => bench::peers::run(rounds),
        Chore::Golden { names } => golden(&names),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            process::say(&format!("error: {message}"));
            ExitCode::FAILURE
        }
    }
}

fn golden(names: &[String]) -> Outcome {
    let mut args = vec!["run", "--release", "--package", "heliostat-tests", "--example", "bless", "--"];
    args.extend(names.iter().map(String::as_str));
    process::run(process::cargo(&args))
}
