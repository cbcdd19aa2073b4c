//! Scenes from the command line: opened, with the values that flags replace.

use heliostat_io::{LoadError, OpenOptions, Shot, Source};
use std::path::Path;

/// Opens a scene or a model.
pub(crate) fn source(path: &Path, set: &[(String, String)]) -> Result<Source, LoadError> {
    let options = OpenOptions { overrides: set.to_vec() };
    heliostat_io::open(path, &options)
}

/// The scene at its first frame.
pub(crate) fn first_shot(path: &Path, set: &[(String, String)]) -> Result<Shot, LoadError> {
    let source = source(path, set)?;
    source.shot(first_frame(&source))
}

/// The first frame of a scene; a scene without time has frame 1.
pub(crate) fn first_frame(source: &Source) -> i32 {
    source.frames().map_or(1, |frames| *frames.start())
}
