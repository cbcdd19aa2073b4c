//! What extensions add to a surface.

use super::extensions::{
    Anisotropy, Clearcoat, DiffuseTransmission, Dispersion, Ior, Iridescence, Sheen, Specular, Transmission,
    Volume,
};
use super::{MIRROR_IOR, Reader, at_least_zero, finite, share};
use crate::gltf::flaw::Flaw;
use heliostat_scene::Rgb;
use heliostat_scene::image::Encoding;
use heliostat_scene::material::{Channel, FloatInput, Standard, ThinFilm};

impl Reader<'_, '_> {
    /// Adds the layers of all extensions.
    pub(super) fn layers(&mut self, standard: &mut Standard) -> Result<(), Flaw> {
        self.reflection(standard)?;
        self.inside(standard)?;
        self.coat(standard)?;
        self.sheen(standard)?;
        self.film(standard)
    }

    /// The reflection of the base: index of refraction, weight, tint, direction.
    fn reflection(&mut self, standard: &mut Standard) -> Result<(), Flaw> {
        if let Some(Ior { ior }) = self.extension("KHR_materials_ior")? {
            standard.ior = if ior > 0.0 { ior.min(MIRROR_IOR) } else { MIRROR_IOR };
        }
        if let Some(specular) = self.extension::<Specular>("KHR_materials_specular")? {
            let texture = specular.specular_texture.as_ref();
            standard.specular = self.float(specular.specular_factor, texture, Channel::A)?;
            let texture = specular.specular_color_texture.as_ref();
            standard.specular_color = self.color(specular.specular_color_factor, texture, at_least_zero)?;
        }
        if let Some(anisotropy) = self.extension::<Anisotropy>("KHR_materials_anisotropy")? {
            let texture = anisotropy.anisotropy_texture.as_ref();
            standard.anisotropy = self.float(anisotropy.anisotropy_strength, texture, Channel::B)?;
            standard.anisotropy_rotation = finite(anisotropy.anisotropy_rotation);
            standard.anisotropy_direction = standard.anisotropy.texture;
        }
        Ok(())
    }

    /// What passes the surface, and what happens to it behind.
    fn inside(&mut self, standard: &mut Standard) -> Result<(), Flaw> {
        if let Some(transmission) = self.extension::<Transmission>("KHR_materials_transmission")? {
            let texture = transmission.transmission_texture.as_ref();
            standard.transmission = self.float(transmission.transmission_factor, texture, Channel::R)?;
        }
        if let Some(diffuse) = self.extension::<DiffuseTransmission>("KHR_materials_diffuse_transmission")? {
            let texture = diffuse.diffuse_transmission_texture.as_ref();
            standard.diffuse_transmission =
                self.float(diffuse.diffuse_transmission_factor, texture, Channel::A)?;
            let texture = diffuse.diffuse_transmission_color_texture.as_ref();
            let factor = diffuse.diffuse_transmission_color_factor;
            standard.diffuse_transmission_color = self.color(factor, texture, share)?;
        }
        let volume = self.extension::<Volume>("KHR_materials_volume")?.unwrap_or_default();
        let lets_through = standard.transmission.factor > 0.0 || standard.diffuse_transmission.factor > 0.0;
        standard.thin_walled = lets_through && volume.thickness_factor <= 0.0;
        if volume.thickness_factor > 0.0 {
            standard.absorption = absorption(&volume);
        }
        if let Some(Dispersion { dispersion }) = self.extension("KHR_materials_dispersion")? {
            standard.dispersion = at_least_zero(dispersion);
        }
        Ok(())
    }

    fn coat(&mut self, standard: &mut Standard) -> Result<(), Flaw> {
        let Some(coat) = self.extension::<Clearcoat>("KHR_materials_clearcoat")? else { return Ok(()) };
        let texture = coat.clearcoat_roughness_texture.as_ref();
        standard.coat_roughness = self.float(coat.clearcoat_roughness_factor, texture, Channel::G)?;
        standard.coat = self.float(coat.clearcoat_factor, coat.clearcoat_texture.as_ref(), Channel::R)?;
        standard.coat_relief = self.relief(coat.clearcoat_normal_texture.as_ref())?;
        Ok(())
    }

    fn sheen(&mut self, standard: &mut Standard) -> Result<(), Flaw> {
        let Some(sheen) = self.extension::<Sheen>("KHR_materials_sheen")? else { return Ok(()) };
        standard.sheen_color =
            self.color(sheen.sheen_color_factor, sheen.sheen_color_texture.as_ref(), share)?;
        let texture = sheen.sheen_roughness_texture.as_ref();
        standard.sheen_roughness = self.float(sheen.sheen_roughness_factor, texture, Channel::A)?;
        Ok(())
    }

    fn film(&mut self, standard: &mut Standard) -> Result<(), Flaw> {
        let Some(film) = self.extension::<Iridescence>("KHR_materials_iridescence")? else { return Ok(()) };
        let weight = self.float(film.iridescence_factor, film.iridescence_texture.as_ref(), Channel::R)?;
        let ends =
            [film.iridescence_thickness_minimum, film.iridescence_thickness_maximum].map(at_least_zero);
        let texture = film.iridescence_thickness_texture.as_ref();
        let texture = texture.map(|info| self.textures.add(info, Encoding::Linear, None)).transpose()?;
        // Without a texture it is the maximum everywhere, be it below the minimum.
        let least = if texture.is_some() { ends[0].min(ends[1]) } else { 0.0 };
        standard.thin_film = ThinFilm {
            weight,
            ior: film.iridescence_ior.clamp(1.0, MIRROR_IOR),
            thickness: FloatInput { factor: ends[1] - least, texture, channel: Channel::G },
            least,
        };
        Ok(())
    }
}

/// What leaves `attenuationColor` of white light after `attenuationDistance` metres. Nothing is quite black.
fn absorption(volume: &Volume) -> Rgb {
    let distance = volume.attenuation_distance;
    let color = volume.attenuation_color.map(|v| v.clamp(f32::MIN_POSITIVE, 1.0));
    let per_metre = Rgb::from(color.map(|v| -v.ln() / distance));
    if distance > 0.0 && per_metre.is_finite() { per_metre } else { Rgb::ZERO }
}
