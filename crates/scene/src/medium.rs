//! Media: matter that light flies through, is absorbed and scattered in: smoke, fog, milk, skin.
//!
//! A medium fills what materials name it as their interior of, or the whole scene as its [`Atmosphere`].

use crate::color::Rgb;
use crate::ids::MediumId;
use heliostat_geometry::Transform;
use std::sync::Arc;

/// What scatters and absorbs light.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    /// Name, for messages.
    pub name: String,
    /// Absorption coefficient per metre and channel, at least 0; with a grid, where the density is 1.
    pub absorption: Rgb,
    /// Scattering coefficient per metre and channel, at least 0; with a grid, where the density is 1.
    pub scattering: Rgb,
    /// Mean cosine of the angle by which light is scattered, above -1 and below 1: forward above 0.
    ///
    /// # Source
    /// Henyey, Greenstein, "Diffuse radiation in the galaxy", Astrophysical Journal, 1941.
    pub anisotropy: f32,
    /// How dense it is where; the same everywhere where `None`.
    pub density: Option<DensityGrid>,
}

/// Density at the middles of the cells of a box, linear between them.
#[derive(Clone, Debug, PartialEq)]
pub struct DensityGrid {
    /// Cells along x, y and z, at least 1 each.
    pub size: [u32; 3],
    /// Densities, at least 0; x runs fastest, z slowest.
    pub values: Arc<[f32]>,
    /// From the unit cube that the cells fill to world space. There is nothing outside.
    pub place: Transform,
}

impl DensityGrid {
    /// Most cells of a grid: 2^30.
    pub const MOST_CELLS: u64 = 1 << 30;
}

/// A medium around everything: it fills the ball around all that is finite in the scene and all cameras, or a larger one. Light
/// from infinitely far comes through that ball alone, so that it is not lost on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Atmosphere {
    /// Which.
    pub medium: MediumId,
    /// Radius of the ball in metres, where it is not the smallest one.
    pub radius: Option<f32>,
}

impl Medium {
    /// The same everywhere.
    pub fn homogeneous(name: impl Into<String>, absorption: Rgb, scattering: Rgb, anisotropy: f32) -> Self {
        Self { name: name.into(), absorption, scattering, anisotropy, density: None }
    }

    /// Extinction coefficient per metre and channel: what is taken from light that flies on.
    pub fn extinction(&self) -> Rgb {
        self.absorption + self.scattering
    }
}
