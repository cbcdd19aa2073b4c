//! `[environment]`: what rays see that leave the scene.
//!
//! # Scene file
//! ```toml
//! [environment]
//! # at most one of:
//! color = [0.2, 0.3, 0.5]        # black if left out
//! gradient = { top = [0.2, 0.4, 0.8], horizon = 0.9, bottom = 0.3 }
//! image = "sky.hdr"              # equirectangular, its middle towards -z
//! sky = { elevation = 20 }       # sky and sun of a clear day; see the module `sky`
//! intensity = 1                  # multiplies any of them
//! rotation = 0                   # of the image, degrees about y, counter-clockwise seen from above
//! # medium = "fog"               # what fills the space around everything: a ball around all finite things, lamps and cameras,
//! # medium_radius = 100          # or a larger one, in metres; light from infinitely far comes through this ball alone
//! ```

use super::choice::{at_most_one, choice, without_effect};
use super::names::Names;
use super::number::{Number, Positive};
use super::sky::SkyTable;
use super::value::Color;
use crate::document::{Fault, Placed};
use heliostat_scene::MediumId;
use heliostat_scene::medium::Atmosphere;
use heliostat_scene::scene::Background;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What rays see that leave the scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EnvironmentTable {
    /// One radiance everywhere.
    pub color: Option<Placed<Color>>,
    /// A sky from below to above.
    pub gradient: Option<Placed<GradientTable>>,
    /// Path of an equirectangular image, relative to the scene file.
    pub image: Option<Placed<String>>,
    /// The sky and the sun of a clear day.
    pub sky: Option<Placed<SkyTable>>,
    /// Multiplies any of them; 1 if left out.
    pub intensity: Option<Placed<Color>>,
    /// Turn of the image in degrees about y; 0 if left out.
    pub rotation: Option<Placed<Number>>,
    /// The name of a `[[medium]]` that fills the space around everything; none if left out.
    pub medium: Option<Placed<String>>,
    /// Radius in metres of the ball that it fills, where that is larger than the one around all that is finite.
    pub medium_radius: Option<Placed<Positive>>,
    /// The command that makes the image, shown when it is missing.
    pub made_by: Option<Placed<String>>,
}

/// Radiance by the height of the direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GradientTable {
    /// Straight up.
    pub top: Color,
    /// Level.
    pub horizon: Color,
    /// Straight down.
    pub bottom: Color,
}

impl EnvironmentTable {
    /// Refuses two backgrounds, and keys that would do nothing.
    pub(super) fn check(&self) -> Result<(), Fault> {
        let kinds = [
            choice("color", self.color.as_ref()),
            choice("gradient", self.gradient.as_ref()),
            choice("image", self.image.as_ref()),
            choice("sky", self.sky.as_ref()),
        ];
        at_most_one(&kinds)?;
        if self.medium.is_none() {
            let radius = choice("medium_radius", self.medium_radius.as_ref());
            without_effect("without `medium`", &[radius])?;
        }
        if self.image.is_none() {
            let image_keys =
                [choice("rotation", self.rotation.as_ref()), choice("made_by", self.made_by.as_ref())];
            without_effect("without `image`", &image_keys)?;
        }
        if kinds.iter().all(|(_, span)| span.is_none()) {
            let intensity = choice("intensity", self.intensity.as_ref());
            without_effect("without `color`, `gradient`, `image` or `sky`", &[intensity])?;
        }
        Ok(())
    }

    /// The background, unless it is an image.
    ///
    /// # Errors
    /// Those of the sky.
    pub(super) fn simple_background(&self) -> Result<Background, Fault> {
        let intensity = self.intensity();
        if let Some(sky) = &self.sky {
            return Ok(Background::Daylight(sky.daylight(intensity)?));
        }
        Ok(match (&self.color, &self.gradient) {
            (Some(color), _) => Background::Constant(color.rgb() * intensity),
            (None, Some(gradient)) => Background::Gradient {
                top: gradient.top.rgb() * intensity,
                horizon: gradient.horizon.rgb() * intensity,
                bottom: gradient.bottom.rgb() * intensity,
            },
            (None, None) => Background::default(),
        })
    }

    /// What fills the space around everything.
    pub(super) fn atmosphere(&self, media: &Names) -> Result<Option<Atmosphere>, Fault> {
        let Some(name) = &self.medium else { return Ok(None) };
        let medium = MediumId(media.find(name)? as u32);
        Ok(Some(Atmosphere { medium, radius: self.medium_radius.as_ref().map(|radius| radius.f32()) }))
    }

    /// Factor of the background.
    pub(super) fn intensity(&self) -> heliostat_scene::Rgb {
        self.intensity.as_deref().unwrap_or(&Color::ONE).rgb()
    }

    /// Turn of the image in radians.
    pub(super) fn rotation(&self) -> f32 {
        self.rotation.as_ref().map_or(0.0, |rotation| rotation.get().to_radians() as f32)
    }
}
