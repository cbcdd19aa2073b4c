//! The folder of real models.

use std::path::{Path, PathBuf};

/// The OBJ files of the folder of real models; none, with a line that says so, when it is not there.
pub(crate) fn asset_models() -> Vec<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets");
    let root = std::env::var_os("HELIOSTAT_ASSETS").map_or(beside, PathBuf::from).join("obj");
    let Ok(folders) = root.read_dir() else {
        #[expect(clippy::print_stderr, reason = "a skipped test says so")]
        {
            eprintln!("skipped: no models in {}", root.display());
        }
        return Vec::new();
    };
    let files = folders.flatten().filter_map(|folder| folder.path().read_dir().ok()).flatten().flatten();
    let mut models: Vec<_> =
        files.map(|file| file.path()).filter(|path| path.extension().is_some_and(|e| e == "obj")).collect();
    models.sort_unstable();
    models
}
