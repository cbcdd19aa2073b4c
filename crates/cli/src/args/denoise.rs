//! `heliostat denoise`.

use super::render::Compression;
use clap::Args;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Needs Open Image Denoise 2, which is looked for where --oidn says, else where the environment variable HELIOSTAT_OIDN says,
else under its usual names in the system. A folder stands for the library in it.

R, G and B become the denoised picture; what was there is kept as noisy.R, noisy.G and noisy.B, alpha and all other layers
stay as they are. The layers albedo and N help: `heliostat render --denoise`, or `--aov albedo,normal`, writes them.

Examples:
  heliostat denoise beauty.exr -o clean.exr
  heliostat denoise shot.0001.exr -o clean.0001.exr --oidn /opt/oidn/lib";

/// Take the noise out of a picture with Open Image Denoise
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct DenoiseArgs {
    /// The picture (.exr)
    pub(crate) image: PathBuf,

    /// The picture to write (.exr)
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: PathBuf,

    /// The library Open Image Denoise, or its folder [default: `HELIOSTAT_OIDN`, else the system's]
    #[arg(long, value_name = "LIB")]
    pub(crate) oidn: Option<PathBuf>,

    /// Threads; 0 is one per processor
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=1024), default_value_t = 0)]
    pub(crate) threads: u16,

    /// Compression of EXR, all without loss
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Compression::Zip)]
    pub(crate) compression: Compression,
}
