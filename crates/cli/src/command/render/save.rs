//! A frame into a file.

use crate::args::Compression;
use crate::diagnose::Failure;
use crate::output::Format;
use heliostat_io::Shot;
use heliostat_io::exr_file::{self, ExrOptions, SaveReport, write_exr};
use heliostat_io::png_file::{PngOptions, write_png};
use heliostat_scene::Frame;
use std::path::Path;

/// Writes the frame; what had to be changed for it comes back as notes.
pub(super) fn save(
    format: Format,
    path: &Path,
    shot: &Shot,
    frame: &Frame,
    compression: Compression,
) -> Result<Vec<String>, Failure> {
    match format {
        Format::Exr => {
            let options = ExrOptions { compression: compression.into(), ..ExrOptions::default() };
            Ok(notes(path, write_exr(path, frame, &options)?))
        }
        Format::Png => {
            let options = PngOptions { bits: shot.output.png_bits, view: shot.view, ..PngOptions::default() };
            write_png(path, frame, &options)?;
            Ok(Vec::new())
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
        notes.push(format!("{path}: {values} values beyond 65504 became 65504; --exr-depth float keeps them"));
    }
    if report.replaced > 0 {
        let values = report.replaced;
        notes.push(format!("{path}: {values} values were no finite numbers and were replaced"));
    }
    notes
}
