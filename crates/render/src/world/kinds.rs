//! What the world has to know of each thing before rays ask: whether it is seen, how it stops light, and what shading looks
//! at.

use super::body::Parameters;
use super::filter::Clear;
use super::place::Place;
use super::solid::Content;
use crate::light::Use;
use heliostat_scene::light::LightKind;
use heliostat_scene::material::Material;
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::Layers;
use heliostat_scene::{MaterialId, Object, Scene, TextureId};

/// How a thing stops light; a group may do both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Shadow {
    /// Something in it lets nothing through.
    pub(super) stops: bool,
    /// Something in it lets a part through.
    pub(super) filters: bool,
}

impl Shadow {
    /// No shadow.
    pub(super) const NONE: Self = Self { stops: false, filters: false };

    /// That of the visible surface of a light.
    pub(super) fn of_light(used: Use) -> Self {
        Self { stops: used == Use::Paths, filters: false }
    }

    /// That of both.
    pub(super) fn and(self, other: Self) -> Self {
        Self { stops: self.stops || other.stops, filters: self.filters || other.filters }
    }
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

/// How an object stops light, by all of its materials or by what its group holds.
pub(super) fn shadow_of(scene: &Scene, object: &Object, content: &Content<'_>, clear: Clear) -> Shadow {
    let lets_through = |material: &Material| material.has_holes() || clear.holds(&material.surface);
    match content {
        _ if !object.casts_shadow => Shadow::NONE,
        Content::Group(group) => group.shadow(),
        Content::Body(body) => {
            let is_open = |id: &MaterialId| lets_through(&scene.materials[id.index()]);
            let filters = body.has_holes() || object.materials.iter().any(is_open);
            Shadow { stops: !filters, filters }
        }
    }
}

/// Whether anything looks at the surface parameters of an object. A group answers for each of its parts.
pub(super) fn parameters_of(scene: &Scene, object: &Object, layers: &Layers) -> Parameters {
    let looks = |id: TextureId| scene.textures[id.index()].uses_parameters();
    let material = |id: &MaterialId| {
        let material = &scene.materials[id.index()];
        // A relief bends the normal along the tangents.
        material.relief.is_some()
            || material.surface.follows_tangents()
            || material.textures().into_iter().any(looks)
    };
    if layers.uv || object.materials.iter().any(material) { Parameters::Used } else { Parameters::Unused }
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_geometry::Transform;
    use heliostat_geometry::shape::{Shape, Sphere};
    use heliostat_scene::Motion;
    use heliostat_scene::material::{FloatInput, Standard, Surface};

    #[test]
    fn drawn_out_highlights_need_tangents() {
        let parameters = |anisotropy: f32| {
            let surface = Standard { anisotropy: FloatInput::constant(anisotropy), ..Standard::default() };
            let surface = Surface::Standard(Box::new(surface));
            let scene = Scene { materials: vec![Material::of("brushed", surface)], ..Scene::default() };
            let object = Object {
                name: "ball".to_owned(),
                geometry: Geometry::Shape(Shape::Sphere(Sphere { radius: 1.0 })),
                materials: vec![MaterialId(0)],
                motion: Motion::still(Transform::IDENTITY),
                visible: true,
                casts_shadow: true,
            };
            parameters_of(&scene, &object, &Layers::default())
        };
        assert_eq!(parameters(0.0), Parameters::Unused);
        assert_eq!(parameters(0.5), Parameters::Used);
    }
}
