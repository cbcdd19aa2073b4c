//! What shines, made ready once for all objects that show it.

use super::Use;
use super::emitter::{Emitter, Glow, MeshLamp};
use heliostat_scene::object::Geometry;
use heliostat_scene::{MaterialId, MeshId, Scene};
use std::collections::HashMap;
use std::sync::Arc;

/// Most pieces of all meshes together, and of one.
const MOST_PIECES: usize = 1 << 18;
const MOST_OF_ONE: usize = 1 << 14;

/// Meshes that shine, by what they show: `None` for those that turned out dark.
#[derive(Debug)]
pub(super) struct Lamps<'s> {
    pub(super) scene: &'s Scene,
    pub(super) used: Use,
    /// Most pieces of a mesh.
    most_pieces: usize,
    meshes: HashMap<(MeshId, Vec<MaterialId>), Option<Arc<MeshLamp<'s>>>>,
}

impl<'s> Lamps<'s> {
    /// For a scene in which so many things may shine.
    pub(super) fn new(scene: &'s Scene, used: Use, count: usize) -> Self {
        let most = (MOST_PIECES / count.max(1)).clamp(1, MOST_OF_ONE);
        // Whitted asks every light as a whole.
        let most_pieces = if used == Use::Paths { most } else { 1 };
        Self { scene, used, most_pieces, meshes: HashMap::new() }
    }

    /// The surface of a geometry where it shines; `None` without a finite area above 0. Light that does not weaken comes from
    /// all of it alike, so such a lamp is one piece.
    pub(super) fn emitter(
        &mut self,
        geometry: &'s Geometry,
        materials: &[MaterialId],
        glow: &Glow<'_>,
        falls_off: bool,
    ) -> Option<Emitter<'s>> {
        match geometry {
            Geometry::Shape(shape) => Emitter::of_shape(shape, glow),
            Geometry::Mesh(id) => {
                let mesh = self.scene.meshes.get(id.index())?.as_ref();
                let most = if falls_off { self.most_pieces } else { 1 };
                let lamp = || MeshLamp::new(mesh, glow, most).map(Arc::new);
                let is_shared = !materials.is_empty();
                let made = if is_shared {
                    self.meshes.entry((*id, materials.to_vec())).or_insert_with(lamp).clone()
                } else {
                    lamp()
                };
                made.map(Emitter::Mesh)
            }
            // Its parts shine, each by itself.
            Geometry::Group(_) => None,
        }
    }
}
