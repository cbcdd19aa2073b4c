//! The file of disagreements: one ray and one index a line, as JSON, for `--replay` to trace again.
//!
//! Numbers are written as `f64`, each the exact value of an `f32`: reading them leads back to the same bits.

use super::trees::mesh_name;
use heliostat_geometry::{Interval, Ray};
use heliostat_index::MeshHit;
use heliostat_index::verify::Disagreement;
use heliostat_io::SaveError;
use heliostat_io::atomic::write_atomically;
use heliostat_io::error::{LoadError, Place};
use heliostat_io::file::read_file;
use heliostat_scene::Scene;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Bytes that are read at most: about half a million rays.
const LIMIT: u64 = 1 << 28;

/// A disagreement in the mesh of this number.
pub(super) type Found = (usize, Disagreement);

/// A line of the file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    mesh: usize,
    /// Of the mesh, for the reader.
    name: String,
    /// Of the mesh: tells when it is another one.
    triangles: usize,
    seed: u64,
    number: u64,
    origin: [f64; 3],
    dir: [f64; 3],
    /// First and last distance that count; no last one for infinity.
    range: (f64, Option<f64>),
    index: String,
    expected: Option<Hit>,
    got: Option<Hit>,
    got_any: bool,
}

/// A hit as it was found; replays find their own.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Hit {
    triangle: u32,
    t: f64,
    barycentric: [f64; 3],
}

impl From<MeshHit> for Hit {
    fn from(found: MeshHit) -> Self {
        let barycentric = found.hit.barycentric.map(f64::from);
        Self { triangle: found.triangle, t: found.hit.t.into(), barycentric }
    }
}

/// A ray to trace again.
#[derive(Debug, PartialEq)]
pub(super) struct Saved {
    /// Where it stands in the file, from 1.
    pub(super) line: usize,
    pub(super) mesh: usize,
    pub(super) number: u64,
    /// Name of the index that was wrong.
    pub(super) index: String,
    pub(super) ray: Ray,
}

/// Writes one line for each disagreement.
pub(super) fn save(path: &Path, scene: &Scene, found: &[Found], seed: u64) -> Result<(), SaveError> {
    write_atomically(path, |out| {
        for (mesh, wrong) in found {
            serde_json::to_writer(&mut *out, &entry(scene, *mesh, wrong, seed))?;
            writeln!(out)?;
        }
        Ok(())
    })
}

fn entry(scene: &Scene, mesh: usize, wrong: &Disagreement, seed: u64) -> Entry {
    let Ray { origin, dir, range } = wrong.ray;
    Entry {
        mesh,
        name: mesh_name(scene, mesh),
        triangles: scene.meshes[mesh].triangles.len(),
        seed,
        number: wrong.number,
        origin: origin.as_dvec3().to_array(),
        dir: dir.as_dvec3().to_array(),
        range: (range.min.into(), range.max.is_finite().then(|| range.max.into())),
        index: wrong.index.clone(),
        expected: wrong.expected.map(Hit::from),
        got: wrong.got.map(Hit::from),
        got_any: wrong.got_any,
    }
}

/// Reads the rays of a file that was written for `scene`.
pub(super) fn read(path: &Path, scene: &Scene) -> Result<Vec<Saved>, LoadError> {
    const MEND: &str = "name a file that `--verify` saved";
    let text = String::from_utf8(read_file(path, LIMIT)?)
        .map_err(|_| LoadError::new(path, "is no text in UTF-8").with_help(MEND))?;
    let mut rays = Vec::new();
    for (i, text) in text.lines().enumerate().filter(|(_, text)| !text.trim().is_empty()) {
        let line = i + 1;
        let error = |what: String, help: &str, span| {
            LoadError::new(path, what).at(Place::in_lines(text.into(), line, span)).with_help(help)
        };
        let entry: Entry = serde_json::from_str(text).map_err(|e| {
            let at = e.column().saturating_sub(1);
            error(
                message(&e),
                "a line is one ray as `--verify` saves it; leave out what is damaged",
                at..at + 1,
            )
        })?;
        let (mesh, number, index) = (entry.mesh, entry.number, entry.index.clone());
        let ray = checked(&entry, scene).map_err(|(what, help)| error(what, help, 0..text.len()))?;
        rays.push(Saved { line, mesh, number, index, ray });
    }
    if rays.is_empty() {
        return Err(LoadError::new(path, "holds no rays").with_help(MEND));
    }
    Ok(rays)
}

/// What is wrong with a line, without the place that `serde_json` counts within it.
fn message(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.rsplit_once(" at line ").map_or(text.as_str(), |(what, _)| what).to_owned()
}

/// The ray of a line, or what is wrong with it and the mend.
fn checked(entry: &Entry, scene: &Scene) -> Result<Ray, (String, &'static str)> {
    const OTHER_SCENE: &str = "replay it with the scene that it was saved for";
    let Some(mesh) = scene.meshes.get(entry.mesh) else {
        let what = format!("no mesh {}: the scene has {}, from 0", entry.mesh, scene.meshes.len());
        return Err((what, OTHER_SCENE));
    };
    if mesh.triangles.len() != entry.triangles {
        let (was, is) = (entry.triangles, mesh.triangles.len());
        return Err((format!("mesh {} had {was} triangles and has {is} now", entry.mesh), OTHER_SCENE));
    }
    let (from, to) = entry.range;
    let [x, y, z] = entry.origin.map(|x| x as f32);
    let [dx, dy, dz] = entry.dir.map(|x| x as f32);
    let range = Interval { min: from as f32, max: to.map_or(f32::INFINITY, |to| to as f32) };
    let ray = Ray { range, ..Ray::new([x, y, z].into(), [dx, dy, dz].into()) };
    if !ray.is_valid() {
        let what = "the ray leads nowhere: `origin` and `dir` must be finite in 32 bits, `dir` not zero";
        return Err((what.into(), "write other numbers"));
    }
    let ends = range.min.is_finite() && to.is_none_or(|_| range.max.is_finite());
    if !ends || range.is_empty() {
        let what = "the range is empty or too large for 32 bits";
        return Err((what.into(), "write `[first, last]`, or `[first, null]` for no end"));
    }
    Ok(ray)
}

#[cfg(test)]
mod tests;
