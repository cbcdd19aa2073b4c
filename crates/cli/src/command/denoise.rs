//! `heliostat denoise`: an EXR without its noise.

use crate::args::DenoiseArgs;
use crate::denoise::Denoiser;
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::output::check_writable;
use crate::{out, progress};
use heliostat_io::exr_file::{ExrOptions, write_exr};
use heliostat_io::image_file::{Limits, read_frame};

/// Reads, denoises, writes.
pub(crate) fn run(args: &DenoiseArgs) -> Result<Exit, Failure> {
    if !args.output.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr")) {
        return Err(Failure::usage(format!(
            "{}: a denoised picture is an EXR; write a name that ends in .exr",
            args.output.display()
        )));
    }
    check_writable(&args.output)?;
    let mut frame = read_frame(&args.image, &Limits::default())?;
    let threads = usize::from(args.threads);
    Denoiser::find(args.oidn.as_deref())?.apply(&mut frame, threads)?;
    let options = ExrOptions { compression: args.compression.into(), threads };
    write_exr(&args.output, &frame, &options)?;
    out::line(format_args!("Saved: '{}'", progress::clean(&args.output.to_string_lossy())));
    Ok(Exit::Done)
}
