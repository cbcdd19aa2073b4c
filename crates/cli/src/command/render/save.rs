//! A frame into a file.

use crate::args::{Compression, OutputArgs};
use crate::command::view::png_bits;
use crate::diagnose::Failure;
use crate::output::Format;
use heliostat_io::Shot;
use heliostat_io::exr_file::{self, ExrOptions, SaveReport, write_exr};
use heliostat_io::png_file::{PngOptions, write_png};
use heliostat_scene::Frame;
use heliostat_scene::frame::Depth;
use std::path::Path;

/// How pictures are written: flags over the scene.
#[derive(Debug)]
pub(super) struct Style {
    png: PngOptions,
    exr: ExrOptions,
    exr_depth: Depth,
}

impl Style {
    /// The style of a shot whose flags are applied.
    pub(super) fn new(args: &OutputArgs, shot: &Shot) -> Self {
        let bits = args.png_bits.unwrap_or_else(|| shot.output.png_bits.count());
        Self {
            png: PngOptions { bits: png_bits(bits), view: shot.view, ..PngOptions::default() },
            exr: ExrOptions { compression: args.compression.into(), ..ExrOptions::default() },
            exr_depth: shot.output.exr_depth,
        }
    }

    /// Makes the colours of a frame as deep as they are to be stored; data is float already.
    pub(super) fn prepare(&self, frame: &mut Frame) {
        if self.exr_depth == Depth::Float {
            frame.channels.iter_mut().for_each(|channel| channel.depth = Depth::Float);
        }
    }

    /// Writes the frame; what had to be changed for it comes back as notes.
    pub(super) fn save(&self, format: Format, path: &Path, frame: &Frame) -> Result<Vec<String>, Failure> {
        match format {
            Format::Exr => Ok(notes(path, write_exr(path, frame, &self.exr)?)),
            Format::Png => {
                write_png(path, frame, &self.png)?;
                Ok(Vec::new())
            }
        }
    }
}

impl From<Compression> for exr_file::Compression {
    fn from(compression: Compression) -> Self {
        match compression {
            Compression::None => Self::None,
            Compression::Zips => Self::Zips,
            Compression::Zip => Self::Zip,
            Compression::Piz => Self::Piz,
        }
    }
}

fn notes(path: &Path, report: SaveReport) -> Vec<String> {
    let mut notes = Vec::new();
    let path = path.display();
    if report.clamped > 0 {
        let values = report.clamped;
        notes
            .push(format!("{path}: {values} values beyond 65504 became 65504; --exr-depth float keeps them"));
    }
    if report.replaced > 0 {
        let values = report.replaced;
        notes.push(format!("{path}: {values} values were no finite numbers and were replaced"));
    }
    notes
}
