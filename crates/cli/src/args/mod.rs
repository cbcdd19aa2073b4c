//! The command line as types: one file per command, plus the values that several of them share.

mod check;
mod compare;
mod denoise;
mod index;
mod info;
mod man;
mod render;
pub(crate) mod value;
mod video;
mod view;

pub(crate) use check::CheckArgs;
pub(crate) use compare::{CompareArgs, Metric};
pub(crate) use denoise::DenoiseArgs;
pub(crate) use index::{IndexArgs, Preset};
pub(crate) use info::InfoArgs;
pub(crate) use man::{CompletionsArgs, ManArgs};
pub(crate) use render::{Compression, ExrDepth, Integrator, Layer, OutputArgs, ProgressMode, RenderArgs};
pub(crate) use video::VideoArgs;
pub(crate) use view::{ViewArgs, ViewName};

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Parser, Subcommand};

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Yellow.on_default().bold())
    .usage(AnsiColor::Yellow.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

const ABOUT: &str = "\
Heliostat renders scenes and models by ray tracing, into PNG for looking at and multi-layer HDR EXR for compositing.

A scene is a .toml file (its keys: `heliostat schema`) or a model (.obj, .gltf, .glb), which renders with a fitted camera
and a neutral light where it has none. The same scene, settings and version give the same bytes, for any number of threads.";

const AFTER_HELP: &str = "\
Examples:
  heliostat render model.obj                     a model as it is, into model.png
  heliostat render scene.toml -o a.exr -o a.png  all layers for compositing, and a picture
  heliostat check scene.toml                     what is wrong with it, without rendering

Exit codes:
  0    everything is there
  1    the render failed, or a comparison is past its limit
  2    the command line is wrong
  3    a scene or an asset is wrong
  4    an output could not be written
  130  stopped by Ctrl-C, and 143 by SIGTERM: the picture with the samples so far is saved";

/// The whole command line.
#[derive(Debug, Parser)]
#[command(
    name = "heliostat",
    version,
    about = "A ray tracer whose HDR EXR goes straight into compositing",
    long_about = ABOUT,
    after_help = AFTER_HELP,
    styles = STYLES,
    max_term_width = 110,
    propagate_version = true,
    subcommand_required = true,
    arg_required_else_help = true
)]
pub(crate) struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands, in the order of the help.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Render(Box<RenderArgs>),
    Check(CheckArgs),
    Info(InfoArgs),
    Index(IndexArgs),
    Compare(CompareArgs),
    View(ViewArgs),
    Denoise(DenoiseArgs),
    Video(VideoArgs),
    /// Print the JSON Schema of the scene file, for editors that complete it
    #[command(after_help = "Examples:\n  heliostat schema > heliostat.schema.json\n  \
        Then begin the scene file with:  #:schema heliostat.schema.json")]
    Schema,
    Completions(CompletionsArgs),
    Man(ManArgs),
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
