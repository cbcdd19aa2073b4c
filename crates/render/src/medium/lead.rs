//! One colour leads a flight, and all three are weighed by how likely each would have led it here.
//!
//! How far light gets differs between colours, but a flight has one length. It is drawn for a channel that is chosen by what
//! each channel carries, and weighed by the mean, over the same choice, of the densities that all three give to what happened:
//! so a weight never exceeds what a channel carries divided by its own odds, and colours of a medium make no coloured noise.
//!
//! Densities are kept as ratios to that of the channel that leads: `own` for the flight itself, `asked` for a shadow ray on the
//! same way, whose chance collisions differ.
//!
//! # Source
//! Miller, Georgiev, Jarosz, "A Null-Scattering Path Integral Formulation of Light Transport", SIGGRAPH 2019; Wilkie et al.,
//! "Hero Wavelength Spectral Sampling", EGSR 2014; Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section
//! 14.2.2.

use heliostat_scene::Rgb;

/// Which channel leads a flight from one scattering to the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lead {
    /// Probabilities of the channels.
    odds: Rgb,
    channel: usize,
    /// Densities of what happened, over that of the channel that leads.
    pub(super) own: Rgb,
    pub(super) asked: Rgb,
}

impl Lead {
    /// Chooses a channel by what each carries, for `u` in `[0, 1)`; `None` where nothing is carried.
    pub(crate) fn new(carried: Rgb, u: f32) -> Option<Self> {
        let odds = carried / carried.element_sum();
        if !odds.is_finite() {
            return None;
        }
        let channel = if u < odds.x { 0 } else { 1 + usize::from(u >= odds.x + odds.y) };
        // Rounding of the sum must not choose a channel that carries nothing.
        let channel = if odds[channel] > 0.0 { channel } else { odds.max_position() };
        Some(Self { odds, channel, own: Rgb::ONE, asked: Rgb::ONE })
    }

    /// The value of the channel that leads.
    #[inline]
    pub(super) fn of(&self, values: Rgb) -> f32 {
        values[self.channel]
    }

    /// The density of the flight, over that of the channel that leads.
    #[inline]
    pub(crate) fn own(&self) -> f32 {
        self.odds.dot(self.own)
    }

    /// The density of a shadow ray on the same way, over that of the channel that leads.
    #[inline]
    pub(crate) fn asked(&self) -> f32 {
        self.odds.dot(self.asked)
    }
}
