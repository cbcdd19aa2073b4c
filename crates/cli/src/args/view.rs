//! `heliostat view`.

use super::value;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Examples:
  heliostat view beauty.exr -o beauty.png --view agx
  heliostat view beauty.exr -o dark.png --exposure -1.5 --bits 16";

/// Turn an HDR image into a PNG through a view transform
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct ViewArgs {
    /// The image (.exr, .hdr, .png, .jpg)
    pub(crate) image: PathBuf,

    /// The PNG to write [default: the name of the image with .png, in the current folder]
    #[arg(short, long, value_name = "PNG")]
    pub(crate) output: Option<PathBuf>,

    /// Show this layer or channel instead of the colours, as in `albedo` or `Z`
    #[arg(long, value_name = "NAME")]
    pub(crate) layer: Option<String>,

    /// View transform
    #[arg(long, value_enum, value_name = "NAME", default_value_t = ViewName::Standard)]
    pub(crate) view: ViewName,

    /// Brightness in stops: +1 doubles the light, -1 halves it
    #[arg(long, value_name = "STOPS", value_parser = value::finite, default_value_t = 0.0, allow_hyphen_values = true)]
    pub(crate) exposure: f32,

    /// Bits per channel
    #[arg(long, value_name = "8|16", value_parser = value::bits, default_value = "8")]
    pub(crate) bits: u8,
}

/// The view transforms by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ViewName {
    /// sRGB as it is, clipped at 1
    Standard,
    /// AgX: filmic, highlights fade to white
    Agx,
    /// The ACES filmic curve
    Aces,
    /// Khronos PBR Neutral: base colours stay, highlights are compressed
    Neutral,
}
