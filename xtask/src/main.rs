//! The project's chores, each behind one word: `cargo xtask ci | tidy | assets | gallery | bench`.

mod assets;
mod ci;
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
        /// Also the slow checks: 20,000 cases per law, full ray counts, release tests.
        #[arg(long)]
        deep: bool,
    },
    /// Check what the compiler does not: the import graph, file sizes, headers, left-overs, links.
    Tidy,
    /// Generate the meshes and textures that the scenes use.
    Assets,
}

fn main() -> ExitCode {
    let outcome = match Args::parse().chore {
        Chore::Ci { deep } => ci::run(deep),
        Chore::Tidy => tidy::run(),
        Chore::Assets => assets::run(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            process::say(&format!("error: {message}"));
            ExitCode::FAILURE
        }
    }
}
