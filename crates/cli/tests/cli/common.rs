//! What the tests of the command line share: running the built binary in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A scene that renders in a moment and has everything in it that tests want to change.
pub(crate) const SCENE: &str = r#"[render]
width = 40
height = 30
samples = 2

[time]
first_frame = 1
last_frame = 4

[[camera]]
name = "front"
position = [0, 1, 4]
look_at = [0, 0.5, 0]
fov = 40

[[camera]]
name = "top"
position = [0, 5, 0.1]
look_at = [0, 0, 0]
fov = 50

[[material]]
name = "red"
[material.phong]
diffuse = [0.8, 0.2, 0.1]
specular = 0.4

[[material]]
name = "glass"
[material.phong]
transparency = 0.8
mirror = 0.1

[[object]]
name = "floor"
plane = {}
material = "red"

[[object]]
name = "ball"
sphere = { radius = 0.5 }
translate = [0, 0.5, 0]
material = "glass"

[[light]]
name = "key"
intensity = 20
point = { position = [2, 4, 3] }

[[animation]]
target = "object.ball.translate"
interpolation = "linear"
keys = [[0, [0, 0.5, 0]], [1, [1, 0.5, 0]]]
"#;

/// A folder with files, in which the binary runs.
pub(crate) struct Folder(TempDir);

impl Folder {
    /// An empty folder.
    pub(crate) fn new() -> Self {
        Self(TempDir::new().expect("a temporary folder"))
    }

    /// A folder with [`SCENE`] as `scene.toml`.
    pub(crate) fn with_scene() -> Self {
        let folder = Self::new();
        folder.write("scene.toml", SCENE);
        folder
    }

    /// Its path.
    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    /// The path of a file in it.
    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    /// Writes a file.
    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.file(name), content).expect("the temporary folder is writable");
    }

    /// Reads a file.
    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.file(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// The names of all files, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.path()).expect("the folder is there");
        let mut names: Vec<String> =
            entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// The binary, ready to run in this folder.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_heliostat"));
        command.args(arguments).current_dir(self.path()).stdin(Stdio::null()).env_remove("NO_COLOR");
        command
    }

    /// Runs the binary in this folder.
    pub(crate) fn run(&self, arguments: &[&str]) -> Run {
        let output = self.command(arguments).output().expect("the binary starts");
        Run::new(&output)
    }
}

/// What a run did.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Run {
    pub(crate) fn new(output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Self { code: output.status.code(), stdout: text(&output.stdout), stderr: text(&output.stderr) }
    }

    /// The last line on standard error.
    pub(crate) fn last_line(&self) -> &str {
        self.stderr.lines().last().unwrap_or_default()
    }

    /// Fails the test unless the exit code is this one and nothing panicked.
    #[track_caller]
    pub(crate) fn expect(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{self:#?}");
        assert!(!self.stderr.contains("panicked"), "{self:#?}");
        self
    }
}
