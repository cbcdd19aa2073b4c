//! The meshes and textures that the scenes use, all made from formulas: the repository ships nothing foreign. And the picture in
//! the docs of the index.
//!
//! Small files go to `assets/` and are committed; large ones go to `assets/large/`, which is not.

mod bird;
mod noise;
mod obj;
mod partition;
mod solids;
mod sphere_points;
mod textures;

use crate::Outcome;
use crate::process::{root, say};

/// Generates every asset. Running it twice gives the same bytes.
pub(crate) fn run() -> Outcome {
    let folder = root().join("assets");
    for name in ["meshes", "textures", "large"] {
        std::fs::create_dir_all(folder.join(name)).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    let meshes = [
        ("meshes/block.obj", solids::block([11, 18, 30], [1.1, 1.8, 3.0])),
        ("meshes/sphere.obj", solids::icosphere(5)),
        ("meshes/facets.obj", solids::icosphere(2)),
        ("meshes/prism.obj", solids::prism()),
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
    partition::draw()
}
