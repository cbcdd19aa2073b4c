//! The physically based surface at one point.

use glam::Vec2;
use heliostat_scene::Rgb;
use heliostat_scene::material::Conductor;

/// The numbers of [`heliostat_scene::material::Standard`] at one point, each within its range; see there for their meaning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StandardPoint {
    pub(crate) base_color: Rgb,
    pub(crate) diffuse_roughness: f32,
    pub(crate) metalness: f32,
    /// Tint of metal at about 82 degrees.
    pub(crate) edge_color: Rgb,
    pub(crate) conductor: Option<Conductor>,
    pub(crate) roughness: f32,
    pub(crate) specular: f32,
    pub(crate) specular_color: Rgb,
    pub(crate) ior: f32,
    pub(crate) anisotropy: f32,
    /// Unit direction in the tangent plane along which highlights are drawn out.
    pub(crate) anisotropy_direction: Vec2,
    pub(crate) transmission: f32,
    pub(crate) thin_walled: bool,
    pub(crate) dispersion: f32,
    pub(crate) diffuse_transmission: f32,
    pub(crate) diffuse_transmission_color: Rgb,
    /// Share of the matte part that lets light in, and the colour that a thick body of it has.
    pub(crate) subsurface: f32,
    pub(crate) subsurface_color: Rgb,
    /// Whether that light is followed; else such matter is matte and has that colour.
    pub(crate) walks: bool,
    pub(crate) coat: f32,
    pub(crate) coat_roughness: f32,
    pub(crate) coat_ior: f32,
    pub(crate) sheen_color: Rgb,
    pub(crate) sheen_roughness: f32,
    /// Share of the surface under the film.
    pub(crate) film: f32,
    pub(crate) film_ior: f32,
    /// Thickness of the film in nanometres.
    pub(crate) film_thickness: f32,
}

impl StandardPoint {
    /// The albedo of a surface that is Lambert's and nothing else.
    pub(crate) fn as_matte(&self) -> Option<Rgb> {
        let layers = [
            self.specular,
            self.metalness,
            self.transmission,
            self.diffuse_transmission,
            self.diffuse_roughness,
            self.subsurface,
            self.coat,
            self.film,
            self.sheen_color.max_element(),
        ];
        layers.iter().all(|&layer| layer == 0.0).then_some(self.base_color)
    }
}
