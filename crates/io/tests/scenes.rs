//! Every scene of the repository opens, and its first and last frame are valid scenes.

#![expect(clippy::unwrap_used, reason = "a test that cannot read its files has failed")]

use heliostat_io::{OpenOptions, open};
use std::path::{Path, PathBuf};

fn scenes(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(scenes(&path));
        } else if path.extension().is_some_and(|ending| ending == "toml") {
            found.push(path);
        }
    }
    found.sort();
    found
}

#[test]
fn every_scene_of_the_repository_opens() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut wrong = Vec::new();
    for path in scenes(&folder) {
        let checked = open(&path, &OpenOptions::default()).and_then(|source| {
            let frames = source.frames().unwrap_or(1..=1);
            for frame in [*frames.start(), *frames.end()] {
                let shot = source.shot(frame)?;
                if let Err(issues) = shot.scene.validate() {
                    wrong.push(format!("{}: {issues:?}", path.display()));
                }
            }
            Ok(())
        });
        match checked {
            // Large assets are made by a command that the scene names.
            Err(error) if error.to_string().contains("make it with") => {}
            Err(error) => wrong.push(error.to_string()),
            Ok(()) => {}
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
