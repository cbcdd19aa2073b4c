//! Media made ready: how light flies through them, and where it is scattered.
//!
//! [`phase`] scatters, [`grid`] knows the density, [`flight`] samples how far light gets, [`lead`] weighs the three colours
//! against each other.

pub(crate) mod flight;
pub(crate) mod grid;
pub(crate) mod lead;
pub(crate) mod phase;

use grid::Grid;
use heliostat_scene::{Medium, Rgb};
use phase::Phase;

/// A medium made ready.
#[derive(Debug)]
pub(crate) struct PreparedMedium<'s> {
    /// Per metre and channel, where the density is 1.
    scattering: Rgb,
    /// The same for scattering and absorption together.
    extinction: Rgb,
    pub(crate) phase: Phase,
    grid: Option<Grid<'s>>,
}

impl<'s> PreparedMedium<'s> {
    pub(crate) fn new(medium: &'s Medium) -> Self {
        Self {
            scattering: medium.scattering,
            extinction: medium.extinction(),
            phase: Phase::new(medium.anisotropy),
            grid: medium.density.as_ref().map(Grid::new),
        }
    }

    /// One that is the same everywhere.
    pub(crate) fn even(scattering: Rgb, extinction: Rgb, anisotropy: f32) -> Self {
        Self { scattering, extinction, phase: Phase::new(anisotropy), grid: None }
    }
}

/// The share of light that is left of each channel after a way in metres, which may be endless.
///
/// # Source
/// The law of Bouguer, Lambert and Beer.
#[inline]
pub(crate) fn transmitted(extinction: Rgb, way: f32) -> Rgb {
    // Where nothing is taken, an endless way takes nothing either.
    Rgb::select(extinction.cmpgt(Rgb::ZERO), (-way * extinction).exp(), Rgb::ONE)
}
