//! How a surface scatters light at one point: bidirectional scattering distribution functions.
//!
//! Directions are unit vectors in the local frame of the point: z is the shading normal on the viewer's side, x the tangent.
//! `wo` goes to the viewer, so `wo.z > 0`; `wi` goes to where the light comes from, `wi.z < 0` for light from behind the surface.
//! What is called the value is `f(wo, wi) |wi.z|`; densities are by solid angle. Mirrors and clear glass have no value: they
//! answer to samples alone.

use glam::Vec3;
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
