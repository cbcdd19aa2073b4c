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
//! ```

use super::number::Whole;
use heliostat_scene::settings::DepthLimits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A length of paths.
pub type Length = Whole<0, 1_024>;

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
        }
    }
}
