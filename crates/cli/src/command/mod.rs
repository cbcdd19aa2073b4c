//! What the commands do, one file each.

mod check;
mod compare;
mod completions;
mod denoise;
mod index;
mod info;
mod man;
mod render;
mod schema;
mod video;
mod view;

use crate::args::{Cli, Command};
use crate::diagnose::Failure;
use crate::exit::Exit;

/// Does what the command line asks for.
pub(crate) fn run(cli: Cli) -> Result<Exit, Failure> {
    match cli.command {
        Command::Render(args) => render::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Info(args) => info::run(&args),
        Command::Index(args) => index::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::View(args) => view::run(&args),
        Command::Denoise(args) => denoise::run(&args),
        Command::Video(args) => video::run(&args),
        Command::Schema => Ok(schema::run()),
        Command::Completions(args) => Ok(completions::run(&args)),
        Command::Man(args) => man::run(&args),
    }
}
