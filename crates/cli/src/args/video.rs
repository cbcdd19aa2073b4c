//! `heliostat video`.

use super::{value, view::ViewName};
use clap::Args;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Needs the program ffmpeg on the PATH. Frames with odd sizes get one more row or column, as the format demands.

Examples:
  heliostat video turn.####.png -o turn.mp4
  heliostat video turn.%04d.exr -o turn.mp4 --fps 30 --view agx
  heliostat video a.png b.png c.png -o slides.mp4 --fps 1";

/// Make an MP4 of frames, through the ffmpeg on the PATH
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct VideoArgs {
    /// Frames in order, or one pattern with `####` or `%04d` for the frame number
    #[arg(required = true, value_name = "FRAMES")]
    pub(crate) frames: Vec<PathBuf>,

    /// The video to write
    #[arg(short, long, value_name = "MP4")]
    pub(crate) output: PathBuf,

    /// Frames per second
    #[arg(long, value_name = "N", value_parser = value::frame_rate, default_value = "24")]
    pub(crate) fps: f64,

    /// Quality of H.264: 0 is lossless, 18 looks so, 51 is the worst
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=51), default_value_t = 18)]
    pub(crate) crf: u8,

    /// View transform of EXR and HDR frames
    #[arg(long, value_enum, value_name = "NAME", default_value_t = ViewName::Standard)]
    pub(crate) view: ViewName,

    /// Brightness of EXR and HDR frames in stops
    #[arg(long, value_name = "STOPS", value_parser = value::finite, default_value_t = 0.0, allow_hyphen_values = true)]
    pub(crate) exposure: f32,
}
