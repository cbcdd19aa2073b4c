//! `heliostat completions`: the completion script of a shell, on standard output.

use crate::args::{Cli, CompletionsArgs};
use crate::exit::Exit;
use crate::out;
use clap::CommandFactory;

/// Prints the script.
pub(crate) fn run(args: &CompletionsArgs) -> Exit {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "heliostat", &mut script);
    out::bytes(&script);
    Exit::Done
}
