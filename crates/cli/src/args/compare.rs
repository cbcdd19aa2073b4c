//! `heliostat compare`.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Values are compared as light: 8 and 16-bit images are decoded to linear first. FLIP is what a viewer notices who
flips between the two pictures, 0 for nothing and 1 for everything.

Examples:
  heliostat compare reference.exr new.exr
  heliostat compare reference.png new.png --max 0.01 --metric flip --diff diff.png";

/// Tell how two images differ
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct CompareArgs {
    /// The image to compare with (.exr, .png, .hdr, .jpg)
    pub(crate) reference: PathBuf,

    /// The image to judge
    pub(crate) image: PathBuf,

    /// Compare this channel alone, as in `Z` or `albedo.R`
    #[arg(long, value_name = "NAME")]
    pub(crate) channel: Option<String>,

    /// Write a picture of the differences, black where there are none
    #[arg(long, value_name = "PNG")]
    pub(crate) diff: Option<PathBuf>,

    /// Exit with code 1 when the metric is above this
    #[arg(long, value_name = "LIMIT", value_parser = super::value::non_negative)]
    pub(crate) max: Option<f64>,

    /// The metric that `--max` limits
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Metric::Rmse)]
    pub(crate) metric: Metric,

    /// Print JSON to standard output
    #[arg(long)]
    pub(crate) json: bool,
}

/// The measures of difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Metric {
    /// Root of the mean squared difference, over all pixels and channels
    Rmse,
    /// Mean of the FLIP error map, in [0, 1]; needs R, G and B
    Flip,
    /// The largest difference of a value
    Max,
}
