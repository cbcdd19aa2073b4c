//! `heliostat video`: frames into an MP4, through the ffmpeg on the PATH.

mod ffmpeg;
mod raster;

use crate::args::VideoArgs;
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::frame_name::{self, FrameName};
use crate::output::check_writable;
use crate::signals::Signals;
use crate::{out, progress};
use ffmpeg::Encoder;
use heliostat_io::{LoadError, View};
use raster::Raster;
use std::path::{Path, PathBuf};

/// Encodes the frames in order.
pub(crate) fn run(args: &VideoArgs) -> Result<Exit, Failure> {
    let known = ["mp4", "mov", "m4v"];
    if !args.output.extension().is_some_and(|e| known.iter().any(|k| e.eq_ignore_ascii_case(k))) {
        let shown = args.output.display();
        return Err(Failure::usage(format!("{shown}: not a video; write a name that ends in .mp4")));
    }
    check_writable(&args.output)?;
    let frames = frames(&args.frames)?;
    let signals = Signals::install()?;
    let view = View { transform: args.view.into(), exposure: args.exposure };
    let first = Raster::read(&frames[0], view)?;
    let mut encoder = Encoder::start(&args.output, &first, args.fps, args.crf)?;
    for (index, path) in frames.iter().enumerate() {
        let next;
        let raster = if index == 0 {
            &first
        } else {
            next = Raster::read(path, view)?;
            &next
        };
        check_size(raster, &first, path)?;
        // A signal reaches ffmpeg, too: whatever it says then is no failure of its own.
        let written = encoder.write(raster);
        if let Some(exit) = signals.exit() {
            return Ok(exit);
        }
        if written.is_err() {
            break;
        }
    }
    encoder.finish(&args.output)?;
    out::line(format_args!("Saved: '{}'", progress::clean(&args.output.to_string_lossy())));
    Ok(Exit::Done)
}

/// The files that the arguments name; a single pattern stands for all that fit it.
fn frames(given: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let frames = match given {
        [pattern] if !pattern.exists() && is_pattern(pattern) => {
            let found = frame_name::matching(pattern).map_err(|e| LoadError::io(pattern, &e))?;
            if found.is_empty() {
                let error = LoadError::new(pattern, "no file fits the pattern");
                return Err(error.with_help("check the folder and the name").into());
            }
            found
        }
        given => given.to_vec(),
    };
    // Better now than after half of the video.
    match frames.iter().find(|path| !path.is_file()) {
        Some(missing) => Err(LoadError::io(missing, &std::io::ErrorKind::NotFound.into()).into()),
        None => Ok(frames),
    }
}

fn is_pattern(path: &Path) -> bool {
    path.file_name().and_then(|n| n.to_str()).is_some_and(|n| FrameName::parse(n).is_numbered())
}

fn check_size(raster: &Raster, first: &Raster, path: &Path) -> Result<(), Failure> {
    if (raster.width, raster.height) == (first.width, first.height) {
        return Ok(());
    }
    let message = format!(
        "{} x {} pixels, but the first frame has {} x {}",
        raster.width, raster.height, first.width, first.height
    );
    Err(LoadError::new(path, message).with_help("render all frames of a video in one size").into())
}
