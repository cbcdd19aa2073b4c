//! Alpha: the modes of glTF as coverage.

use super::{Reader, share};
use crate::gltf::flaw::Flaw;
use crate::gltf::images::has_holes;
use crate::gltf::textures::TextureInfo;
use gltf::json::Material;
use gltf::json::material::AlphaMode;
use gltf::json::validation::Checked;
use heliostat_scene::image::Encoding;
use heliostat_scene::material::{Channel, FloatInput};

/// Whether the alpha of a material counts.
pub(super) fn counts(json: &Material) -> bool {
    matches!(json.alpha_mode, Checked::Valid(AlphaMode::Mask | AlphaMode::Blend))
}

impl Reader<'_, '_> {
    /// Coverage, and from where on it is whole.
    pub(super) fn opacity(
        &mut self,
        factor: f32,
        texture: Option<&TextureInfo>,
    ) -> Result<(FloatInput, Option<f32>), Flaw> {
        if !counts(self.json) {
            return Ok((FloatInput::constant(1.0), None));
        }
        // A texture without holes would make every shadow ray look at it.
        let texture = texture
            .filter(|info| self.textures.image(info, Encoding::Srgb).is_some_and(|image| has_holes(&image)));
        let texture = texture.map(|info| self.textures.add(info, Encoding::Srgb, None)).transpose()?;
        let opacity = FloatInput { factor: share(factor), texture, channel: Channel::A };
        let is_mask = self.json.alpha_mode == Checked::Valid(AlphaMode::Mask);
        let cutoff = self.json.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0);
        Ok(match cutoff {
            _ if !is_mask => (opacity, None),
            // No coverage reaches it.
            cutoff if cutoff > 1.0 => (FloatInput::constant(0.0), None),
            cutoff => (opacity, Some(share(cutoff))),
        })
    }
}
