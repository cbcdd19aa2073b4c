//! What the commands do, one file each.

mod completions;
mod info;
mod man;
mod video;
mod view;

use crate::args::{Cli, Command};
use crate::diagnose::Failure;
use crate::exit::Exit;

/// Does what the command line asks for.
pub(crate) fn run(cli: Cli) -> Result<Exit, Failure> {
    match cli.command {
        Command::Info(args) => info::run(&args),
        Command::View(args) => view::run(&args),
        Command::Video(args) => video::run(&args),
        Command::Completions(args) => Ok(completions::run(&args)),
        Command::Man(args) => man::run(&args),
        _ => Err(Failure::usage("this command comes with the crates that it needs")),
    }
}
