//! The physically based surface at a point.

use super::MaterialEval;
use crate::bsdf::StandardPoint;
use glam::{Vec2, Vec4Swizzles};
use heliostat_scene::Rgb;
use heliostat_scene::material::{ColorInput, FloatInput, Standard};

impl MaterialEval<'_> {
    /// The numbers of the surface, each brought into its range; a vertex colour multiplies `base_color`.
    pub(crate) fn standard(&self, standard: &Standard, vertex_color: Option<Rgb>) -> StandardPoint {
        let share = |input: &FloatInput| within(self.float(input), 0.0, 1.0);
        let color = |input: &ColorInput| unit_color(self.color(input));
        let film = &standard.thin_film;
        StandardPoint {
            base_color: unit_color(vertex_color.unwrap_or(Rgb::ONE) * self.color(&standard.base_color)),
            diffuse_roughness: share(&standard.diffuse_roughness),
            metalness: share(&standard.metalness),
            conductor: standard.conductor,
            roughness: share(&standard.roughness),
            specular: share(&standard.specular),
            specular_color: self.color(&standard.specular_color).max(Rgb::ZERO),
            ior: standard.ior,
            anisotropy: share(&standard.anisotropy),
            anisotropy_direction: self.anisotropy_direction(standard),
            transmission: share(&standard.transmission),
            thin_walled: standard.thin_walled,
            dispersion: standard.dispersion.max(0.0),
            diffuse_transmission: share(&standard.diffuse_transmission),
            diffuse_transmission_color: color(&standard.diffuse_transmission_color),
            coat: share(&standard.coat),
            coat_roughness: share(&standard.coat_roughness),
            coat_ior: standard.coat_ior.max(1.0),
            sheen_color: color(&standard.sheen_color),
            sheen_roughness: share(&standard.sheen_roughness),
            film: share(&film.weight),
            film_ior: film.ior.max(1.0),
            film_thickness: self.film_thickness(standard),
        }
    }

    /// Thickness of the film in nanometres: a texture spreads it over the whole range, a number is its upper end.
    fn film_thickness(&self, standard: &Standard) -> f32 {
        let film = &standard.thin_film;
        within(film.least + self.float(&film.thickness), 0.0, f32::MAX)
    }

    /// The unit direction along which highlights are drawn out, turned counter-clockwise as the surface says.
    fn anisotropy_direction(&self, standard: &Standard) -> Vec2 {
        let turn = Vec2::from_angle(standard.anisotropy_rotation);
        let direction = match standard.anisotropy_direction {
            None => Vec2::X,
            Some(id) => (2.0 * self.texture(id).xy() - Vec2::ONE).normalize_or(Vec2::X),
        };
        turn.rotate(direction)
    }
}

/// `x` within a range; a value that is no number is its lower end.
fn within(x: f32, least: f32, most: f32) -> f32 {
    if x.is_nan() { least } else { x.clamp(least, most) }
}

fn unit_color(color: Rgb) -> Rgb {
    color.map(|x| within(x, 0.0, 1.0))
}
