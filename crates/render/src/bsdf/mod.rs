//! How a surface scatters light at one point: bidirectional scattering distribution functions.
//!
//! Directions are unit vectors in the local frame of the point: z is the shading normal on the viewer's side, x the tangent.
//! `wo` goes to the viewer, so `wo.z > 0`; `wi` goes to where the light comes from, `wi.z < 0` for light from behind the surface.
//! What is called the value is `f(wo, wi) |wi.z|`; densities are by solid angle. Mirrors and clear glass have no value: they
//! answer to samples alone.

mod diffuse;
mod fresnel;
mod ggx;
mod glass;
mod quadrature;
mod reflect;
mod sheen;
mod standard;
mod table;
#[cfg(test)]
mod tests;

pub(crate) use standard::{StandardBsdf, StandardPoint};

use glam::Vec3;
use glass::refract;
use heliostat_scene::Rgb;

/// What a sampled direction does at the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Event {
    /// Scattered by a matte layer, to either side.
    Diffuse,
    /// Reflected by a smooth or rough layer.
    Glossy,
    /// Refracted, or let through by a thin wall.
    Transmission,
}

/// A direction drawn for a viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BsdfSample {
    /// Where the light comes from.
    pub(crate) wi: Vec3,
    /// Value over density: what the radiance from there is multiplied by.
    pub(crate) weight: Rgb,
    /// Density of `wi` among all that may be drawn; infinite for the one direction of a mirror or of clear glass.
    pub(crate) pdf: f32,
    /// Which of the layers it was.
    pub(crate) event: Event,
}

impl BsdfSample {
    /// Whether no other way than sampling finds the direction.
    pub(crate) fn is_delta(&self) -> bool {
        self.pdf == f32::INFINITY
    }
}

/// The closed list of surface models, at one point.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bsdf {
    /// The physically based model.
    Standard(StandardBsdf),
}

impl Bsdf {
    /// The value, without mirrors and clear glass.
    pub(crate) fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        match self {
            Self::Standard(bsdf) => bsdf.eval(wo, wi),
        }
    }

    /// Density of `wi` among the directions that [`Self::sample`] draws, without mirrors and clear glass.
    pub(crate) fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        match self {
            Self::Standard(bsdf) => bsdf.pdf(wo, wi),
        }
    }

    /// A direction; `None` where the numbers lead nowhere, for which light is 0.
    pub(crate) fn sample(&self, wo: Vec3, u: Vec3) -> Option<BsdfSample> {
        match self {
            Self::Standard(bsdf) => bsdf.sample(wo, u),
        }
    }

    /// About the share of light from all around that goes to the viewer.
    pub(crate) fn albedo(&self, wo: Vec3) -> Rgb {
        match self {
            Self::Standard(bsdf) => bsdf.albedo(wo),
        }
    }
}
