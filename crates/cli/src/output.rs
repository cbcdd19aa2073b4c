//! Where pictures go: names with frame numbers, formats by ending, and the check before the work that they can be
//! written after it.

use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::frame_name::FrameName;
use std::io;
use std::path::{Path, PathBuf};

/// The formats of pictures, by their ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// All layers, light as it is.
    Exr,
    /// The colours through the view transform.
    Png,
}

/// One picture per frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Output {
    folder: PathBuf,
    name: FrameName,
    /// How it is written.
    pub(crate) format: Format,
}

impl Output {
    /// The output that `path` names.
    pub(crate) fn new(path: &Path, numbered: bool) -> Result<Self, Failure> {
        let shown = path.display();
        let format = match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("exr") => Format::Exr,
            Some("png") => Format::Png,
            Some(other) => {
                let message = format!(
                    "{shown}: images cannot be written as .{other}; write a name that ends in .exr or .png"
                );
                return Err(Failure::usage(message));
            }
            None => {
                return Err(Failure::usage(format!(
                    "{shown}: no ending; write a name that ends in .exr or .png"
                )));
            }
        };
        let Some(name) = path.file_name().and_then(|n| n.to_str()) else {
            return Err(Failure::usage(format!("{shown}: not a name in UTF-8; choose another one")));
        };
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        let name = FrameName::parse(name);
        Ok(Self { folder, name: if numbered { name.numbered() } else { name }, format })
    }

    /// The file for a frame.
    pub(crate) fn path(&self, frame: i32) -> PathBuf {
        self.folder.join(self.name.file(frame))
    }

    /// Where a frame goes that a signal stopped: numbered ones are marked, so that nobody takes them for whole when
    /// the run is taken up again.
    pub(crate) fn unfinished(&self, frame: i32) -> PathBuf {
        if self.name.is_numbered() { self.folder.join(self.name.unfinished(frame)) } else { self.path(frame) }
    }
}

/// The outputs of a render: those that were given, or the name of the scene with `.png` in the current folder.
pub(crate) fn outputs(given: &[PathBuf], scene: &Path, numbered: bool) -> Result<Vec<Output>, Failure> {
    let by_default;
    let paths = if given.is_empty() {
        by_default = [beside_cwd(scene, "png")];
        &by_default
    } else {
        given
    };
    let mut outputs: Vec<Output> = Vec::new();
    for path in paths {
        let output = Output::new(path, numbered)?;
        if outputs.contains(&output) {
            return Err(Failure::usage(format!("{}: given twice; leave one out", path.display())));
        }
        outputs.push(output);
    }
    Ok(outputs)
}

/// The name of `input` with another ending, in the current folder.
pub(crate) fn beside_cwd(input: &Path, ending: &str) -> PathBuf {
    let stem = input.file_stem().filter(|s| !s.is_empty()).unwrap_or("out".as_ref());
    // The stem may hold dots of its own, which `with_extension` would cut.
    let mut name = stem.to_os_string();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}

/// Fails where `path` cannot be written: hours of rendering must not end there.
pub(crate) fn check_writable(path: &Path) -> Result<(), Failure> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let fail = |message: String| Err(Failure::new(Exit::Output, message));
    if path.is_dir() {
        return fail(format!("{}: is a folder; write the name of a file", path.display()));
    }
    if !folder.is_dir() {
        let what = if folder.exists() { "is no folder" } else { "folder not found" };
        return fail(format!("{}: {what}; create it with `mkdir -p`, or write elsewhere", folder.display()));
    }
    match tempfile::Builder::new().prefix(".heliostat-").tempfile_in(folder) {
        Ok(_) => Ok(()),
        Err(error) => fail(format!(
            "{}: cannot be written into: {}; choose another folder",
            folder.display(),
            cause(&error)
        )),
    }
}

/// What the system says, without the path that `tempfile` appends.
fn cause(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::PermissionDenied => "permission denied".into(),
        io::ErrorKind::ReadOnlyFilesystem => "the file system is read-only".into(),
        io::ErrorKind::StorageFull => "no space left on the device".into(),
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn default_name_is_the_scene_in_the_current_folder() {
        let outputs = outputs(&[], Path::new("scenes/a.b.toml"), false).unwrap();
        assert_eq!(outputs[0].path(1), PathBuf::from("a.b.png"));
        let outputs = super::outputs(&[], Path::new("scenes/a.toml"), true).unwrap();
        assert_eq!(outputs[0].path(12), PathBuf::from("a.0012.png"));
    }

    #[test]
    fn formats_by_ending() {
        assert_eq!(Output::new(Path::new("x/a.EXR"), false).unwrap().format, Format::Exr);
        assert_eq!(Output::new(Path::new("a.png"), false).unwrap().format, Format::Png);
        for wrong in ["a", "a.jpg", "x/", "..", "-", "a.exr/"] {
            let result = Output::new(Path::new(wrong), false);
            assert!(wrong == "a.exr/" || result.is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_same_output_twice_is_a_slip() {
        let twice = ["a.png".into(), "a.png".into()];
        assert!(outputs(&twice, Path::new("s.toml"), false).is_err());
    }

    #[test]
    fn folders_are_checked() {
        let folder = tempfile::tempdir().unwrap();
        assert!(check_writable(&folder.path().join("a.png")).is_ok());
        assert!(check_writable(&folder.path().join("none/a.png")).is_err());
        assert!(check_writable(folder.path()).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing stays behind");
    }
}
