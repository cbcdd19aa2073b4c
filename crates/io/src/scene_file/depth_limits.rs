//! `depth_limits = { .. }` of `[render]`: how long the paths of the integrator `path` may be.
//!
//! Light beyond a limit is missing. 0 leaves light that comes straight from a light to a surface.
//!
//! # Scene file
//! ```toml
//! [render.depth_limits]          # 1024, as good as none, where left out
//! total = 12                     # all together
//! diffuse = 4                    # scattered by matte layers
//! glossy = 4                     # reflected by smooth or rough layers
//! transmission = 12              # refracted, or let through by thin walls
//! volume = 100                   # scattered by media, which do not count in total; 1048576 where left out
//! ```

use super::number::Whole;
use heliostat_scene::settings::DepthLimits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A length of paths.
pub type Length = Whole<0, 1_024>;

/// A length of paths in media.
pub type VolumeLength = Whole<0, 1_048_576>;

/// How long paths may be; 1024 where left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DepthLimitsTable {
    /// All together.
    pub total: Option<Length>,
    /// Scattered by matte layers.
    pub diffuse: Option<Length>,
    /// Reflected by smooth or rough layers.
    pub glossy: Option<Length>,
    /// Refracted, or let through by thin walls.
    pub transmission: Option<Length>,
    /// Scattered by media; 1048576 where left out.
    pub volume: Option<VolumeLength>,
}

impl DepthLimitsTable {
    /// The limits of the settings.
    pub(super) fn limits(&self) -> DepthLimits {
        let limit = |length: Option<Length>| length.map_or(DepthLimits::MOST, Whole::u32);
        DepthLimits {
            total: limit(self.total),
            diffuse: limit(self.diffuse),
            glossy: limit(self.glossy),
            transmission: limit(self.transmission),
            volume: self.volume.map_or(DepthLimits::MOST_VOLUME, Whole::u32),
        }
    }

    /// The table that gives `limits`.
    pub(super) fn of(limits: &DepthLimits) -> Self {
        let length = |limit: u32| Whole::new(i64::from(limit.min(DepthLimits::MOST)));
        Self {
            total: length(limits.total),
            diffuse: length(limits.diffuse),
            glossy: length(limits.glossy),
            transmission: length(limits.transmission),
            volume: Whole::new(i64::from(limits.volume.min(DepthLimits::MOST_VOLUME))),
        }
    }
}
