//! Surfaces that are the same everywhere, worked out once.

use super::{Bsdf, Surroundings};
use crate::material_eval::MaterialEval;
use crate::texture_eval::TexturePoint;
use glam::{Vec2, Vec3};
use heliostat_scene::{Material, MaterialId, Scene};

/// For each material, seen from inside and from outside, the surface that it is everywhere.
#[derive(Debug, Default)]
pub(crate) struct KnownBsdfs(Vec<Option<[Bsdf; 2]>>);

impl KnownBsdfs {
    /// Those of a scene in open space; `walks` as in [`Surroundings`].
    pub(crate) fn new(scene: &Scene, walks: bool) -> Self {
        let sides = |material| is_even(material).then(|| sides(material, walks));
        Self(scene.materials.iter().map(sides).collect())
    }

    /// The surface of a material where no vertex has a colour, met from outside if the ray `enters`.
    #[inline]
    pub(crate) fn get(&self, material: MaterialId, enters: bool) -> Option<&Bsdf> {
        self.0[material.index()].as_ref().map(|sides| &sides[usize::from(enters)])
    }
}

/// Whether no texture varies what light does at the surface.
fn is_even(material: &Material) -> bool {
    let mut surface = Material::of("", material.surface.clone());
    let mut textures = 0;
    surface.each_texture(|_| textures += 1);
    textures == 0
}

fn sides(material: &Material, walks: bool) -> [Bsdf; 2] {
    let at = TexturePoint::plain(Vec2::ZERO, Vec3::ZERO);
    let eval = MaterialEval { textures: &[], at };
    let around = Surroundings { walks, ..Surroundings::OPEN };
    [false, true].map(|enters| Bsdf::new(&material.surface, &eval, None, enters, Vec3::Z, around))
}
