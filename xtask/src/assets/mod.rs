//! The meshes and textures that the scenes use, all made from formulas: the repository ships nothing foreign. And what the
//! binary makes from them: the cells of a tree, and the picture in the docs of the index.
//!
//! Small files go to `assets/` and are committed; large ones go to `assets/large/`, which is not.

mod bird;
mod gem;
mod lamps;
mod noise;
mod obj;
mod partition;
mod smoke;
mod solids;
mod sphere_points;
mod textures;

use crate::Outcome;
use crate::heliostat::Heliostat;
use crate::process::{capture, cargo, root, run as run_command, say};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Generates every asset. Running it twice gives the same bytes.
pub(crate) fn run() -> Outcome {
    from_formulas()?;
    let heliostat = Heliostat::build()?;
    export_cells(&heliostat)?;
    partition::draw(&heliostat)?;
    make_tables()
}

/// Generates every asset, and fails when a committed one was not what it is now.
pub(crate) fn check() -> Outcome {
    let before = committed()?;
    run()?;
    let after = committed()?;
    match after.iter().find(|(path, bytes)| before.get(*path) != Some(*bytes)) {
        Some((path, _)) => Err(format!("{} was not what `cargo xtask assets` makes", path.display())),
        None => Ok(()),
    }
}

/// The bytes of all files that are committed.
fn committed() -> Result<BTreeMap<PathBuf, Vec<u8>>, String> {
    let mut files = vec![root().join(partition::PICTURE), root().join(TABLES)];
    for folder in ["assets/meshes", "assets/textures", "assets/volumes", "assets/lamps"] {
        let entries = std::fs::read_dir(root().join(folder)).map_err(|e| format!("{folder}: {e}"))?;
        files.extend(entries.filter_map(|entry| Some(entry.ok()?.path())));
    }
    let read = |path: PathBuf| match std::fs::read(&path) {
        Ok(bytes) => Ok((path, bytes)),
        Err(error) => Err(format!("{}: {error}", path.display())),
    };
    files.into_iter().map(read).collect()
}

fn from_formulas() -> Outcome {
    let folder = root().join("assets");
    for name in ["meshes", "textures", "volumes", "lamps", "large"] {
        std::fs::create_dir_all(folder.join(name)).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    let meshes = [
        ("meshes/block.obj", solids::block([11, 18, 30], [1.1, 1.8, 3.0])),
        ("meshes/sphere.obj", solids::icosphere(5)),
        ("meshes/facets.obj", solids::icosphere(2)),
        ("meshes/prism.obj", solids::prism()),
        ("meshes/gem.obj", gem::brilliant()),
        ("meshes/bird.obj", bird::mesh(9_002)),
        ("large/bird.obj", bird::mesh(48_485)),
    ];
    for (name, mesh) in meshes {
        say(&format!("assets/{name}: {} triangles", mesh.triangles.len()));
        obj::write(&folder.join(name), &mesh)?;
    }
    for (name, image) in textures::all() {
        say(&format!("assets/textures/{name}: {} x {}", image.width(), image.height()));
        let path = folder.join("textures").join(name);
        image.save(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    say("assets/volumes/smoke.vol");
    smoke::write(&folder.join("volumes/smoke.vol"))?;
    for (name, text) in lamps::all() {
        let path = folder.join("lamps").join(name);
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(())
}

/// How much light rough surfaces send back.
const TABLES: &str = "crates/render/src/bsdf/table/tables.f32";

/// The code that makes the tables is no part of the renderer, but of its tests.
fn make_tables() -> Outcome {
    say(&format!("{TABLES}: integrals over facets"));
    let mut tests = cargo(&["test", "-p", "heliostat-render", "--lib", "bsdf_tables_are_written"]);
    tests.env("HELIOSTAT_MAKE_TABLES", "1");
    run_command(tests)
}

/// The cells around the coarse sphere, as a mesh of its own.
fn export_cells(heliostat: &Heliostat) -> Outcome {
    let (mesh, cells) = ("assets/meshes/facets.obj", "assets/meshes/partition.obj");
    say(&format!("{cells}: the cells around {mesh}"));
    let flags = ["index", mesh, "--preset", "midpoint", "--what", "leaves", "--export", cells];
    capture(heliostat.command(&flags)).map(drop)
}
