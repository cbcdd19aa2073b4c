//! Writing a mesh as OBJ with few digits, so that the bytes do not depend on the last bit of a sine.

use crate::Outcome;
use glam::DVec3;
use std::fmt::Write;
use std::path::Path;

/// A mesh as the generators make it: no normals, the reader makes them.
#[derive(Default)]
pub(super) struct Mesh {
    pub(super) positions: Vec<DVec3>,
    pub(super) triangles: Vec<[usize; 3]>,
}

/// Writes `mesh` with five digits behind the point.
pub(super) fn write(path: &Path, mesh: &Mesh) -> Outcome {
    let mut text = String::from("# Made by `cargo xtask assets`; same terms as the project.\n");
    for p in &mesh.positions {
        // Adding zero turns -0 into 0.
        let [x, y, z] = p.to_array().map(|c| (c * 1e5).round() / 1e5 + 0.0);
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    std::fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}
