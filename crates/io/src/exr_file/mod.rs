//! OpenEXR files: frames out, reproducibly, and back in.
//!
//! Written are single-part scan line files with lossless compression: the form that every compositor reads. Channels
//! are stored in the order of their names, as half or float; the display window is the whole picture, the data window
//! the rendered part. The entries of [`Frame::meta`] become header attributes under their own names and types;
//! `chromaticities` (Rec.709), `pixelAspectRatio`, `screenWindowCenter`, `screenWindowWidth` and `software` are always
//! there. Nothing depends on time, place or threads: the same frame gives the same bytes.

mod attributes;
mod blocks;
mod chromaticities;
mod decode;
mod encode;
mod header;
mod layout;
mod zip;

pub(crate) use header::MAGIC;

use crate::atomic::write_atomically;
use crate::error::LoadError;
use crate::file::read_file;
use crate::image_file::Limits;
use crate::save_error::SaveError;
use heliostat_scene::frame::Frame;
use std::path::Path;

/// Lossless compression of the pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compression {
    /// None: large and fast.
    None,
    /// Deflate, line by line: fast to read in lines.
    Zips,
    /// Deflate, 16 lines at a time.
    #[default]
    Zip,
    /// Wavelets: good for noisy pictures.
    Piz,
}

/// How a frame is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExrOptions {
    /// Compression of the pixels.
    pub compression: Compression,
    /// Threads that compress, 0 for all; the bytes are the same for any number.
    pub threads: usize,
}

/// What had to be changed to store the values of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SaveReport {
    /// Finite values beyond 65504 in half channels, now 65504.
    pub clamped: u64,
    /// NaN, now 0, and infinities, now the largest value of the channel.
    pub replaced: u64,
}

/// Writes `frame` to `path`, atomically.
///
/// # Errors
/// When the frame contradicts itself or the file cannot be written.
pub fn write_exr(path: &Path, frame: &Frame, options: &ExrOptions) -> Result<SaveReport, SaveError> {
    let (bytes, report) = encode::encode(frame, options).map_err(|e| SaveError::new(path, e))?;
    write_atomically(path, |out| out.write_all(&bytes))?;
    Ok(report)
}

/// The bytes that [`write_exr`] writes.
///
/// # Errors
/// With a sentence, when the frame contradicts itself.
pub fn encode_exr(frame: &Frame, options: &ExrOptions) -> Result<(Vec<u8>, SaveReport), String> {
    encode::encode(frame, options)
}

/// Reads all channels and attributes of a file. Colours come as Rec.709, whatever the primaries of the file.
///
/// # Errors
/// When the file is missing, damaged, larger than `limits`, or in a variant that is not read.
pub fn read_exr(path: &Path, limits: &Limits) -> Result<Frame, LoadError> {
    decode_exr(path, &read_file(path, limits.bytes)?, limits)
}

/// Like [`read_exr`], from the bytes of a file; `path` is for messages.
///
/// # Errors
/// As [`read_exr`].
pub fn decode_exr(path: &Path, bytes: &[u8], limits: &Limits) -> Result<Frame, LoadError> {
    decode_channels(path, bytes, limits, &|_| true)
}

/// Like [`decode_exr`], with the channels whose names are `wanted`.
pub(crate) fn decode_channels(
    path: &Path,
    bytes: &[u8],
    limits: &Limits,
    wanted: &dyn Fn(&str) -> bool,
) -> Result<Frame, LoadError> {
    decode::decode(bytes, limits, wanted).map_err(|e| e.about(path))
}

/// The names of all channels, in the order of the file.
pub(crate) fn channel_names(path: &Path, bytes: &[u8], limits: &Limits) -> Result<Vec<String>, LoadError> {
    decode::channel_names(bytes, limits).map_err(|e| e.about(path))
}
