//! A frame into a file.

use crate::args::{Compression, OutputArgs};
use crate::command::view::png_bits;
use crate::diagnose::Failure;
use crate::output::Format;
use heliostat_io::Shot;
use heliostat_io::exr_file::{self, ExrOptions, SaveReport, write_exr};
use heliostat_io::png_file::{PngOptions, write_png};
use heliostat_scene::Frame;
use heliostat_scene::frame::{Depth, Meta};
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
        let threads = shot.settings.threads;
        let bits = args.png_bits.unwrap_or_else(|| shot.output.png_bits.count());
        Self {
            png: PngOptions { bits: png_bits(bits), view: shot.view, layer: None, threads },
            exr: ExrOptions { compression: args.compression.into(), threads },
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

/// Writes number and rate of a frame of an animation into its header.
///
/// # Source
/// OpenEXR, "Standard Attributes": `imageCounter` and `framesPerSecond`.
pub(super) fn stamp(frame: &mut Frame, number: i32, frame_rate: f64) {
    /// Thousandths of a frame: 23.976 is what files say.
    const STEPS: u32 = 1000;
    let steps = (frame_rate * f64::from(STEPS)).round() as i32;
    let divisor = greatest_common_divisor(steps.unsigned_abs(), STEPS);
    let rate = Meta::Rational(steps / divisor.cast_signed(), STEPS / divisor);
    frame.meta.insert("imageCounter".to_owned(), Meta::Int(number));
    frame.meta.insert("framesPerSecond".to_owned(), rate);
}

/// # Source
/// Euclid, Elements, book VII, proposition 2.
fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
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

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::settings::PixelRect;
    use std::collections::BTreeMap;

    #[test]
    fn frame_rates_are_reduced() {
        for (rate, numerator, denominator) in [(24.0, 24, 1), (23.976, 2997, 125), (12.5, 25, 2)] {
            let mut frame = Frame {
                width: 0,
                height: 0,
                window: PixelRect { x0: 0, y0: 0, x1: 0, y1: 0 },
                channels: Vec::new(),
                meta: BTreeMap::new(),
            };
            stamp(&mut frame, 7, rate);
            assert_eq!(frame.meta["framesPerSecond"], Meta::Rational(numerator, denominator));
            assert_eq!(frame.meta["imageCounter"], Meta::Int(7));
        }
    }
}
