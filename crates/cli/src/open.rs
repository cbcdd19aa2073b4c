//! Scenes from the command line: opened, with the values that flags replace.

use heliostat_io::{LoadError, OpenOptions, Shot, Source};
use std::path::Path;

/// Opens a scene or a model.
pub(crate) fn source(
    path: &Path,
    set: &[(String, String)],
    camera: Option<&str>,
    variant: Option<&str>,
) -> Result<Source, LoadError> {
    let [camera, variant] = [camera, variant].map(|name| name.map(str::to_owned));
    let options = OpenOptions { overrides: set.to_vec(), camera, variant };
    heliostat_io::open(path, &options)
}

/// The scene at its first frame.
pub(crate) fn first_shot(path: &Path) -> Result<Shot, LoadError> {
    let source = source(path, &[], None, None)?;
    source.shot(source.first_frame())
}
