//! The meshes of a comparison: those of a folder, and generated ones of any size.

use glam::Vec3;
use heliostat_geometry::TriMesh;
use heliostat_io::obj::{ObjOptions, Split, load_obj};
use heliostat_io::texture_cache::TextureCache;
use std::path::{Path, PathBuf};

/// Every OBJ file below a folder.
pub(crate) fn obj_files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    let entries = std::fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            files.extend(obj_files(&path)?);
        } else if path.extension().is_some_and(|e| e == "obj") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// All triangles of a file as one mesh of unit radius around the origin: the BVHs of others want such sizes.
pub(crate) fn load(path: &Path) -> Result<TriMesh, String> {
    let options = ObjOptions { split: Split::Whole, materials: false, ..ObjOptions::default() };
    let model = load_obj(path, &options, &mut TextureCache::new(heliostat_io::image_file::Limits::default()))
        .map_err(|e| e.to_string())?;
    let mut mesh = TriMesh::default();
    for object in &model.objects {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend_from_slice(&object.mesh.positions);
        mesh.triangles.extend(object.mesh.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    let bounds = mesh.bounds();
    let (centre, scale) = (bounds.centre(), 1.0 / bounds.radius());
    for p in &mut mesh.positions {
        *p = scale * (*p - centre);
    }
    Ok(mesh)
}

/// A sphere with dents, of about so many triangles.
pub(crate) fn dented_sphere(triangles: usize) -> TriMesh {
    let rows = ((triangles as f64 / 4.0).sqrt() as u32).max(2);
    let columns = 2 * rows;
    let point = |row: u32, column: u32| {
        let theta = std::f32::consts::PI * row as f32 / rows as f32;
        let phi = std::f32::consts::TAU * (column % columns) as f32 / columns as f32;
        let p = Vec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
        let wave = |f: f32| (f * p.x).sin() * (f * p.y + 1.0).sin() * (f * p.z + 2.0).sin();
        p * (1.0 + 0.1 * wave(7.0) + 0.05 * wave(23.0) + 0.01 * wave(111.0))
    };
    let mut mesh = TriMesh::default();
    for row in 0..=rows {
        mesh.positions.extend((0..columns).map(|column| point(row, column)));
    }
    for row in 0..rows {
        for column in 0..columns {
            let next = (column + 1) % columns;
            let at = |row: u32, column: u32| row * columns + column;
            let (a, b) = (at(row, column), at(row, next));
            let (c, d) = (at(row + 1, column), at(row + 1, next));
            if row > 0 {
                mesh.triangles.push([a, b, c]);
            }
            if row + 1 < rows {
                mesh.triangles.push([b, d, c]);
            }
        }
    }
    mesh
}
