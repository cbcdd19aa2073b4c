//! What the world has to know of each thing before rays ask: whether it is seen, how it stops light, and what shading looks
//! at.

use super::place::Place;
use super::solid::Parameters;
use heliostat_scene::light::LightKind;
use heliostat_scene::material::{Material, Surface};
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::Layers;
use heliostat_scene::{MaterialId, Object, Scene, TextureId};

/// How a thing stops light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shadow {
    /// Not at all.
    None,
    /// A part of it passes.
    Filter,
    /// Nothing passes.
    Solid,
}

/// The area lights that are seen: their index, surface and place.
pub(super) fn visible_lights(scene: &Scene) -> impl Iterator<Item = (u32, (&Geometry, Place<'_>))> {
    (0..).zip(&scene.lights).filter_map(|(i, light)| match &light.kind {
        LightKind::Area { geometry, transform, visible: true, .. } => {
            Some((i, (geometry, Place::Still(transform))))
        }
        _ => None,
    })
}

/// How an object stops light, by all of its materials.
pub(super) fn shadow_of(scene: &Scene, object: &Object, glass: bool) -> Shadow {
    let lets_through = |material: &Material| {
        let Surface::Phong(phong) = &material.surface;
        material.opacity.factor < 1.0
            || material.opacity.texture.is_some()
            || (glass && !phong.transparency.is_zero())
    };
    if !object.casts_shadow {
        Shadow::None
    } else if object.materials.iter().any(|id| lets_through(&scene.materials[id.index()])) {
        Shadow::Filter
    } else {
        Shadow::Solid
    }
}

/// Whether anything looks at the surface parameters of an object.
pub(super) fn parameters_of(scene: &Scene, object: &Object, layers: &Layers) -> Parameters {
    let looks = |id: TextureId| scene.textures[id.index()].uses_parameters();
    let material = |id: &MaterialId| {
        let material = &scene.materials[id.index()];
        // A relief bends the normal along the tangents.
        material.relief.is_some() || material.textures().any(looks)
    };
    if layers.uv || object.materials.iter().any(material) { Parameters::Used } else { Parameters::Unused }
}
