//! How bright a surface is, where, for those who choose points on it.

use super::EVEN;
use crate::light::table2d::Table2d;
use crate::material_eval::MaterialEval;
use crate::texture_eval::{TexturePoint, uv_step};
use glam::{Vec2, Vec3};
use heliostat_scene::color::luminance;
use heliostat_scene::{Material, Object, Rgb, Scene, Texture};

/// Most cells of a table along one side.
const MOST_CELLS: f32 = 512.0;
/// Points along one side of a cell at which its brightness is looked at.
const POINTS: usize = 2;

/// What makes a surface shine.
#[derive(Clone, Copy, Debug)]
pub(in super::super) enum Glow<'s> {
    /// The same radiance everywhere.
    Even(Rgb),
    /// The emission of the object's materials.
    Object(&'s Scene, &'s Object),
}

impl<'s> Glow<'s> {
    /// Of an object; even where nothing tells one of its points from another.
    pub(in super::super) fn of(scene: &'s Scene, object: &'s Object) -> Self {
        let material = |id: &heliostat_scene::MaterialId| &scene.materials[id.index()];
        let is_even = |m: &Material| m.surface.emission().texture.is_none() && !m.has_holes();
        match object.materials.as_slice() {
            [id] if is_even(material(id)) && !has_coverage(scene, object) => {
                Self::Even(material(id).surface.emission().factor)
            }
            _ => Self::Object(scene, object),
        }
    }

    /// Radiance at a point.
    pub(in super::super) fn radiance(&self, slot: u16, at: TexturePoint) -> Rgb {
        match self {
            Self::Even(radiance) => *radiance,
            Self::Object(scene, _) => {
                let eval = MaterialEval { textures: &scene.textures, at };
                let material = self.material(slot).filter(|material| !material.surface.emission().is_zero());
                material.map_or(Rgb::ZERO, |m| eval.opacity(m) * eval.color(&m.surface.emission()))
            }
        }
    }

    /// Whether any of it shines to both sides; a light of its own says so itself.
    pub(in super::super) fn is_two_sided(scene: &Scene, object: &Object) -> bool {
        let materials = object.materials.iter().map(|id| &scene.materials[id.index()]);
        materials.filter(|m| !m.surface.emission().is_zero()).any(Material::shines_back)
    }

    /// Whether a slot of an object is dark from behind.
    pub(in super::super) fn has_dark_back(&self, slot: u16) -> bool {
        self.material(slot).is_some_and(|material| !material.shines_back())
    }

    /// Luminance without the texture.
    pub(super) fn factor(&self, slot: u16) -> f32 {
        match self {
            Self::Even(radiance) => luminance(*radiance),
            Self::Object(..) => self.material(slot).map_or(0.0, |m| luminance(m.surface.emission().factor)),
        }
    }

    /// What makes a slot brighter in one place than in another.
    pub(super) fn texture(&self, slot: u16) -> Option<&'s Texture> {
        let Self::Object(scene, _) = self else { return None };
        let id = self.material(slot)?.surface.emission().texture?;
        scene.textures.get(id.index())
    }

    /// Mean luminance of slot 0 over the surface parameters.
    pub(super) fn mean(&self) -> f32 {
        match self.grid() {
            Some((_, cells)) => cells.iter().sum::<f32>() / cells.len() as f32,
            None => self.factor(0),
        }
    }

    /// Slot 0 over the surface parameters; `None` without a texture.
    pub(super) fn table(&self) -> Option<Table2d> {
        let (columns, cells) = self.grid()?;
        let even = EVEN * cells.iter().sum::<f32>() / cells.len() as f32;
        let shares: Vec<_> = cells.iter().map(|&cell| f64::from((1.0 - EVEN) * cell + even)).collect();
        Table2d::new(columns, &shares)
    }

    /// Columns, and mean luminance of each cell over the surface parameters.
    fn grid(&self) -> Option<(usize, Vec<f32>)> {
        let step = uv_step(self.texture(0)?)?;
        let size = step.recip().ceil().clamp(Vec2::ONE, Vec2::splat(MOST_CELLS));
        let (columns, rows) = (size.x as usize, size.y as usize);
        let cell = |i: usize| {
            let corner = Vec2::new((i % columns) as f32, (i / columns) as f32);
            let point = |k: usize| {
                let inside = (Vec2::new((k % POINTS) as f32, (k / POINTS) as f32) + 0.5) / POINTS as f32;
                let uv = (corner + inside) / size;
                luminance(self.radiance(0, TexturePoint::plain(uv, Vec3::ZERO)))
            };
            (0..POINTS * POINTS).map(point).sum::<f32>() / (POINTS * POINTS) as f32
        };
        Some((columns, (0..columns * rows).map(cell).collect()))
    }

    fn material(&self, slot: u16) -> Option<&'s Material> {
        let Self::Object(scene, object) = self else { return None };
        scene.materials.get(object.material(slot).index())
    }
}

/// Whether the mesh of an object has vertices that do not cover.
fn has_coverage(scene: &Scene, object: &Object) -> bool {
    let heliostat_scene::object::Geometry::Mesh(id) = &object.geometry else { return false };
    scene.meshes.get(id.index()).is_some_and(|mesh| !mesh.opacities.is_empty())
}
