//! `heliostat`: the command line of the ray tracer.
//!
//! [`args`] says what can be asked for, [`command`] does it, and whatever goes wrong becomes a [`diagnose::Failure`]
//! with one of the [`exit`] codes and ends in one line on standard error.

mod args;
mod command;
mod denoise;
mod diagnose;
mod exit;
mod frame_name;
mod memory;
mod open;
mod out;
mod output;
mod progress;
mod signals;
mod table;
mod usage;

use args::Cli;
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let exit = match Cli::try_parse() {
        Ok(cli) => command::run(cli).unwrap_or_else(|failure| failure.print()),
        Err(error) => usage::report(&error),
    };
    exit.into()
}
