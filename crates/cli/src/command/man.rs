//! `heliostat man`: manual pages from the same definitions as the help.

use crate::args::{Cli, ManArgs};
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::out;
use clap::CommandFactory;
use clap_mangen::Man;
use std::path::Path;

/// Prints the page of the whole, or writes a page for each command.
pub(crate) fn run(args: &ManArgs) -> Result<Exit, Failure> {
    match &args.dir {
        Some(folder) => write_pages(folder),
        None => print_page(),
    }
}

fn print_page() -> Result<Exit, Failure> {
    let mut page = Vec::new();
    let rendered = Man::new(Cli::command()).render(&mut page);
    rendered.map_err(|e| Failure::new(Exit::Output, format!("the manual page cannot be made: {e}")))?;
    out::bytes(&page);
    Ok(Exit::Done)
}

fn write_pages(folder: &Path) -> Result<Exit, Failure> {
    // A page name in the folder stands for all of them.
    crate::output::check_writable(&folder.join("heliostat.1"))?;
    clap_mangen::generate_to(Cli::command(), folder)
        .map_err(|e| Failure::new(Exit::Output, format!("{}: cannot be written: {e}", folder.display())))?;
    out::line(format_args!("Saved: '{}'", folder.display()));
    Ok(Exit::Done)
}
