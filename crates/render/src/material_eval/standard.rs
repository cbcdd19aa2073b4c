//! The physically based surface at a point.

use super::MaterialEval;
use crate::bsdf::StandardPoint;
use crate::medium::PreparedMedium;
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
            edge_color: color(&standard.edge_color),
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
            subsurface: share(&standard.subsurface),
            subsurface_color: unit_color(
                vertex_color.unwrap_or(Rgb::ONE) * self.color(&standard.subsurface_color),
            ),
            walks: false,
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

    /// What fills the body below the surface, by the colour that it has here.
    ///
    /// # Source
    /// Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", 2017; Academy Software Foundation, "`OpenPBR`
    /// Surface 1.1", "Subsurface".
    pub(crate) fn below(&self, standard: &Standard, vertex_color: Option<Rgb>) -> PreparedMedium<'static> {
        let tint = vertex_color.unwrap_or(Rgb::ONE);
        let color = unit_color(tint * self.color(&standard.subsurface_color));
        let (extinction, g) = (standard.subsurface_radius.recip(), standard.subsurface_anisotropy);
        let albedo = color.map(|color| single_albedo(color, g));
        PreparedMedium::even(albedo * extinction, extinction, g)
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

/// The share that each scattering keeps in a thick body that sends back the share `color` of even light.
///
/// # Source
/// Kulla, Conty, 2017: an inversion of van de Hulst's `color = (1 - s) (1 - 0.139 s) / (1 + 1.17 s)`, where `s^2` is
/// `(1 - albedo) / (1 - albedo g)`.
fn single_albedo(color: f32, g: f32) -> f32 {
    let root = (9.592_17 + color * (41.680_8 + 17.712_6 * color)).sqrt();
    let s = (4.097_12 + 4.208_63 * color - root).clamp(0.0, 1.0);
    let square = s * s;
    // White keeps all, whatever the rounding of the fit.
    if color >= 1.0 { 1.0 } else { (1.0 - square) / (1.0 - g * square) }
}

fn unit_color(color: Rgb) -> Rgb {
    color.map(|x| within(x, 0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inversion_gives_the_colour_back() {
        for i in 0..=100 {
            let color = 0.01 * i as f32;
            for g in [-0.5, 0.0, 0.8] {
                let albedo = single_albedo(color, g);
                assert!((0.0..=1.0).contains(&albedo), "{albedo}");
                let s = ((1.0 - albedo) / (1.0 - albedo * g)).sqrt();
                let back = (1.0 - s) * (1.0 - 0.139 * s) / (1.0 + 1.17 * s);
                assert!((back - color).abs() < 5e-3, "{color}: {back}");
            }
        }
    }
}
