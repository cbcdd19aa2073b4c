//! What the commands do, one file each.

mod completions;
mod man;

use crate::args::{Cli, Command};
use crate::diagnose::Failure;
use crate::exit::Exit;

/// Does what the command line asks for.
pub(crate) fn run(cli: Cli) -> Result<Exit, Failure> {
    match cli.command {
        Command::Completions(args) => Ok(completions::run(&args)),
        Command::Man(args) => man::run(&args),
        _ => Err(Failure::usage("this command comes with the crates that it needs")),
    }
}
