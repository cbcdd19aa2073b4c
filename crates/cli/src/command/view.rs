//! `heliostat view`: an HDR image through a view transform into a PNG.

use crate::args::{ViewArgs, ViewName};
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::output::{beside_cwd, check_writable};
use crate::{out, progress};
use heliostat_io::atomic::write_atomically;
use heliostat_io::image_file::{Limits, read_frame};
use heliostat_io::png_file::{PngBits, PngOptions, encode_png};
use heliostat_io::{LoadError, View, ViewTransform};

/// Reads, views, writes.
pub(crate) fn run(args: &ViewArgs) -> Result<Exit, Failure> {
    let output = args.output.clone().unwrap_or_else(|| beside_cwd(&args.image, "png"));
    if !output.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        return Err(Failure::usage(format!(
            "{}: a view is a PNG; write a name that ends in .png",
            output.display()
        )));
    }
    if args.output.is_none() && output == args.image {
        return Err(Failure::usage(format!(
            "{}: would replace the image; write `-o OTHER.png`",
            output.display()
        )));
    }
    check_writable(&output)?;
    let frame = read_frame(&args.image, &Limits::default())?;
    let view = View { transform: args.view.into(), exposure: args.exposure };
    let options = PngOptions { bits: png_bits(args.bits), view, layer: args.layer.clone(), threads: 0 };
    let png = encode_png(&frame, &options).map_err(|e| LoadError::new(&args.image, e))?;
    write_atomically(&output, |out| out.write_all(&png))?;
    out::line(format_args!("Saved: '{}'", progress::clean(&output.to_string_lossy())));
    Ok(Exit::Done)
}

/// The bits of a PNG; the command line knows 8 and 16 alone.
pub(crate) fn png_bits(count: u8) -> PngBits {
    if count == 16 { PngBits::Sixteen } else { PngBits::Eight }
}

impl From<ViewName> for ViewTransform {
    fn from(name: ViewName) -> Self {
        match name {
            ViewName::Standard => Self::Standard,
            ViewName::Agx => Self::Agx,
            ViewName::Aces => Self::Aces,
            ViewName::Neutral => Self::Neutral,
        }
    }
}
