//! Real meshes for tests: where they lie, and as much of OBJ as their triangles need.

use glam::Vec3;
use heliostat_geometry::TriMesh;
use std::path::{Path, PathBuf};

/// Every OBJ file of the assets folder (`HELIOSTAT_ASSETS`, or `../shared/assets` beside the workspace),
/// smallest first. Says so and gives none when there is no such folder.
pub(crate) fn obj_files() -> Vec<PathBuf> {
    let root = std::env::var_os("HELIOSTAT_ASSETS")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets"), PathBuf::from);
    let mut files = Vec::new();
    let mut folders = vec![root.join("obj")];
    while let Some(folder) = folders.pop() {
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        for path in entries.flatten().map(|entry| entry.path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "obj") {
                files.push(path);
            }
        }
    }
    if files.is_empty() {
        skip(&format!("no OBJ files under {}", root.display()));
    }
    files.sort_by_key(|path| (std::fs::metadata(path).map_or(0, |m| m.len()), path.clone()));
    files
}

#[expect(clippy::print_stderr, reason = "a skipped test says so")]
fn skip(why: &str) {
    eprintln!("skipped: {why}");
}

/// Positions and faces, polygons as fans: enough to trace rays at.
pub(crate) fn read_obj(path: &Path) -> TriMesh {
    let text = String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned();
    let mut mesh = TriMesh::default();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut next = || words.next().unwrap().parse::<f32>().unwrap();
                mesh.positions.push(Vec3::new(next(), next(), next()));
            }
            Some("f") => {
                let corners: Vec<u32> = words.map(|word| vertex(word, mesh.positions.len())).collect();
                let fan = corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]);
                mesh.triangles.extend(fan);
            }
            _ => {}
        }
    }
    mesh
}

/// The vertex of a corner like `7/1/3` or `-2`, counted from 0.
fn vertex(word: &str, so_far: usize) -> u32 {
    let number: i64 = word.split('/').next().unwrap().parse().unwrap();
    let index = if number < 0 { so_far as i64 + number } else { number - 1 };
    u32::try_from(index).unwrap()
}
