//! The scenes of the repository, rendered at any size.

use heliostat_io::{OpenOptions, Source};
use heliostat_scene::Frame;
use std::path::{Path, PathBuf};

/// The root of the workspace.
pub fn root() -> PathBuf {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().unwrap_or(manifest).to_path_buf()
}

/// All scene files of the repository, sorted by name.
///
/// # Errors
/// When the folder cannot be read.
pub fn all() -> std::io::Result<Vec<PathBuf>> {
    let mut scenes = Vec::new();
    for folder in [root().join("scenes"), root().join("scenes/peers")] {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.extension().is_some_and(|e| e == "toml") {
                scenes.push(path);
            }
        }
    }
    scenes.sort();
    Ok(scenes)
}

/// The folder of real models, if this checkout has it beside it; `HELIOSTAT_ASSETS` names another place.
pub fn foreign_assets() -> Option<PathBuf> {
    let beside = || root().join("../shared/assets");
    let folder = std::env::var_os("HELIOSTAT_ASSETS").map_or_else(beside, PathBuf::from);
    folder.is_dir().then_some(folder)
}

/// Every file below `folder` with the ending `.obj`, sorted.
pub fn obj_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "obj") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Opens a scene with settings laid over those of the file.
///
/// # Errors
/// The message of the loader.
pub fn open(path: &Path, overrides: &[(&str, String)]) -> Result<Source, String> {
    let overrides = overrides.iter().map(|(k, v)| ((*k).to_owned(), v.clone())).collect();
    let options = OpenOptions { overrides, ..OpenOptions::default() };
    heliostat_io::open(path, &options).map_err(|e| e.to_string())
}

/// Renders the first frame of a scene.
///
/// # Errors
/// The message of the loader or the renderer.
pub fn render(path: &Path, size: [u32; 2], samples: u32, seed: u64) -> Result<Frame, String> {
    render_with(path, size, samples, seed, &[])
}

/// [`render`] with more settings laid over those of the file.
///
/// # Errors
/// The message of the loader or the renderer.
pub fn render_with(
    path: &Path,
    size: [u32; 2],
    samples: u32,
    seed: u64,
    more: &[(&str, String)],
) -> Result<Frame, String> {
    let mut overrides = vec![
        ("render.width", size[0].to_string()),
        ("render.height", size[1].to_string()),
        ("render.samples", samples.to_string()),
        ("render.seed", seed.to_string()),
    ];
    overrides.extend_from_slice(more);
    let source = open(path, &overrides)?;
    let frame = source.frames().map_or(1, |frames| *frames.start());
    let shot = source.shot(frame).map_err(|e| e.to_string())?;
    heliostat_render::render(&shot.scene, &shot.settings).map_err(|e| e.to_string())
}
