//! Puts a model into a scene.

use super::ObjModel;
use super::build::unique;
use heliostat_geometry::Transform;
use heliostat_scene::material::Relief;
use heliostat_scene::object::Geometry;
use heliostat_scene::{Material, MaterialId, MeshId, Motion, Object, Scene};
use std::collections::HashSet;
use std::ops::Range;

/// How a model stands in a scene.
#[derive(Clone, Debug)]
pub struct Placement {
    /// From the model's space to world space over the shutter.
    pub motion: Motion<Transform>,
    /// Starts the names of objects and materials: `prefix/name`; empty for the names alone.
    pub prefix: String,
    /// In place of all the model's own materials.
    pub material: Option<MaterialId>,
    /// See [`Object::visible`].
    pub visible: bool,
    /// See [`Object::casts_shadow`].
    pub casts_shadow: bool,
}

impl Placement {
    /// Where it was made, under its own names.
    pub fn identity() -> Self {
        Self {
            motion: Motion::still(Transform::IDENTITY),
            prefix: String::new(),
            material: None,
            visible: true,
            casts_shadow: true,
        }
    }
}

impl ObjModel {
    /// Adds the model's meshes, textures, materials and objects; gives the range of the new objects.
    ///
    /// Names that the scene has already get a number behind them.
    pub fn append_to(&self, scene: &mut Scene, placement: &Placement) -> Range<usize> {
        let materials: Vec<_> = match placement.material {
            Some(_) => Vec::new(),
            None => self.append_materials(scene, placement),
        };
        let mut taken: HashSet<_> = scene.objects.iter().map(|object| object.name.clone()).collect();
        let first = scene.objects.len();
        for object in &self.objects {
            let mesh = MeshId(scene.meshes.len() as u32);
            scene.meshes.push(object.mesh.clone());
            scene.objects.push(Object {
                name: unique(prefixed(&placement.prefix, &object.name), &mut taken),
                geometry: Geometry::Mesh(mesh),
                materials: match placement.material {
                    Some(material) => vec![material],
                    None => object.materials.iter().map(|&m| materials[m]).collect(),
                },
                motion: placement.motion.clone(),
                visible: placement.visible,
                casts_shadow: placement.casts_shadow,
            });
        }
        first..scene.objects.len()
    }

    /// Adds materials and textures; gives the ids of the materials.
    fn append_materials(&self, scene: &mut Scene, placement: &Placement) -> Vec<MaterialId> {
        let first_texture = scene.textures.len() as u32;
        scene.textures.extend(self.textures.iter().cloned());
        let mut taken: HashSet<_> = scene.materials.iter().map(|material| material.name.clone()).collect();
        // Bump heights are lengths: they grow with the model.
        let scale = placement.motion.first().matrix().matrix3.determinant().abs().cbrt() as f32;
        let add = |material: &Material| {
            let id = MaterialId(scene.materials.len() as u32);
            let name = unique(prefixed(&placement.prefix, &material.name), &mut taken);
            scene.materials.push(Material { name, ..moved(material, first_texture, scale) });
            id
        };
        self.materials.iter().map(add).collect()
    }
}

fn prefixed(prefix: &str, name: &str) -> String {
    match (prefix, name) {
        (prefix, "") => prefix.to_owned(),
        ("", name) => name.to_owned(),
        (prefix, name) => format!("{prefix}/{name}"),
    }
}

/// The material with its texture ids counted from `first_texture` and its bump scaled.
fn moved(material: &Material, first_texture: u32, scale: f32) -> Material {
    let mut material = material.clone();
    material.each_texture(|id| id.0 += first_texture);
    if let Some(Relief::Bump { strength, .. }) = &mut material.relief {
        *strength *= scale;
    }
    material
}
