//! View transforms: from linear light without an upper end to the colours of an sRGB display.
//!
//! A view is an exposure in stops, one of four transforms and the sRGB transfer function. It belongs to pictures for
//! the eye (PNG) alone; EXR files hold the light itself.

mod aces;
mod agx;
mod neutral;
#[cfg(test)]
mod tests;

use glam::Vec3;
use heliostat_scene::Rgb;
use heliostat_scene::color::linear_to_srgb;
use std::str::FromStr;

/// How light is brought into the range of a display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ViewTransform {
    /// Clipped to `[0, 1]`, channel by channel: exact below 1, harsh above.
    #[default]
    Standard,
    /// AgX: a film-like curve on 16.5 stops; bright saturated light goes to white.
    Agx,
    /// The ACES reference look: contrasty, mid-grey 0.18 becomes 0.1.
    Aces,
    /// Khronos PBR Neutral: base colours as authored up to 0.76, highlights compressed.
    Neutral,
}

impl ViewTransform {
    /// All, in the order of the manual.
    pub const ALL: [Self; 4] = [Self::Standard, Self::Agx, Self::Aces, Self::Neutral];

    /// The name in scene files and flags.
    pub fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Agx => "agx",
            Self::Aces => "aces",
            Self::Neutral => "neutral",
        }
    }

    /// From linear light to linear display light in `[0, 1]`.
    fn form(self, light: Rgb) -> Rgb {
        let display = match self {
            Self::Standard => light,
            Self::Agx => agx::form(light),
            Self::Aces => aces::form(light),
            Self::Neutral => neutral::form(light),
        };
        display.clamp(Vec3::ZERO, Vec3::ONE)
    }
}

impl FromStr for ViewTransform {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|t| t.name() == name).ok_or_else(|| {
            format!("no view transform `{name}`; there are {}", Self::ALL.map(Self::name).join(", "))
        })
    }
}

/// What the eye gets to see of linear light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// How light is brought into the range of a display.
    pub transform: ViewTransform,
    /// Stops of brightening before it: light is multiplied by 2 to this power.
    pub exposure: f32,
}

impl View {
    /// The sRGB-encoded colour in `[0, 1]` of linear Rec.709 light (not premultiplied). Negative light counts as
    /// none, NaN too.
    pub fn apply(&self, light: Rgb) -> Rgb {
        Vec3::from_array(self.form(light).to_array().map(encoded))
    }

    /// [`View::apply`] before it is encoded: linear display light in `[0, 1]`.
    pub(crate) fn form(&self, light: Rgb) -> Rgb {
        // The brightest half: beyond it every transform is at its end, and squares of it are finite.
        const BRIGHTEST: f32 = 65504.0;
        let exposed = if self.exposure == 0.0 { light } else { light * self.exposure.exp2() };
        let safe = |v: f32| if v.is_nan() { 0.0 } else { v.clamp(0.0, BRIGHTEST) };
        self.transform.form(Vec3::from_array(exposed.to_array().map(safe)))
    }
}

/// Linear display light in `[0, 1]`, sRGB-encoded.
pub(crate) fn encoded(v: f32) -> f32 {
    linear_to_srgb(v).clamp(0.0, 1.0)
}
