//! How a surface scatters light at one point: bidirectional scattering distribution functions.
//!
//! Directions are unit vectors in the local frame of the point: z is the shading normal on the viewer's side, x the tangent.
//! `wo` goes to the viewer, so `wo.z > 0`; `wi` goes to where the light comes from, `wi.z < 0` for light from behind the surface.
//! What is called the value is `f(wo, wi) |wi.z|`; densities are by solid angle. Mirrors and clear glass have no value: they
//! answer to samples alone.
//!
//! Radiance is basic radiance, divided by the square of the index of refraction where it is: refraction leaves that as it is,
//! and in free space it is radiance.

mod diffuse;
mod fresnel;
mod ggx;
mod glass;
mod known;
mod phong;
mod quadrature;
mod reflect;
mod sheen;
mod standard;
mod table;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use known::KnownBsdfs;
pub(crate) use standard::view::View as StandardView;
pub(crate) use standard::{StandardBsdf, StandardPoint};

use crate::material_eval::MaterialEval;
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;
use heliostat_scene::material::Surface;
use phong::PhongBsdf;

/// What a sampled direction does at the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Event {
    /// Scattered by a matte layer, to either side.
    Diffuse,
    /// Reflected by a smooth or rough layer.
    Glossy,
    /// Refracted, or let through by a thin wall.
    Transmission,
    /// Let in to walk below the surface: where it comes out is not known yet.
    Subsurface,
}

/// What a surface has around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surroundings {
    /// Index of refraction of what it lies in, 1 for vacuum.
    pub(crate) ior: f32,
    /// Whether light is followed below surfaces; else matter that lets it in is taken for matte.
    pub(crate) walks: bool,
}

impl Surroundings {
    /// Open space, and light that stays above surfaces.
    pub(crate) const OPEN: Self = Self { ior: 1.0, walks: false };
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

impl Bsdf {
    /// One that scatters all light evenly to its side: what comes out from below a surface.
    pub(crate) fn white() -> Self {
        Self::Phong(PhongBsdf::matte(Rgb::ONE))
    }
}

/// The closed list of surfaces at a point.
#[expect(
    clippy::large_enum_variant,
    reason = "it is worked out where it stays; a box would cost more than its size"
)]
#[derive(Clone, Debug)]
pub(crate) enum Bsdf {
    /// The report's surface.
    Phong(PhongBsdf),
    /// The physically based surface.
    Standard(StandardBsdf),
}

impl Bsdf {
    /// A surface where a ray meets it, from outside if it `enters`. A vertex colour tints what is matte; `coat_normal` is the
    /// normal of a coat in the local frame.
    #[inline]
    pub(crate) fn new(
        surface: &Surface,
        eval: &MaterialEval<'_>,
        vertex_color: Option<Rgb>,
        enters: bool,
        coat_normal: Vec3,
        around: Surroundings,
    ) -> Self {
        match surface {
            Surface::Standard(standard) => {
                let mut point = eval.standard(standard, vertex_color);
                point.ior /= around.ior;
                point.walks = around.walks && enters;
                if let Some(albedo) = point.as_matte() {
                    return Self::Phong(PhongBsdf::matte(albedo));
                }
                Self::Standard(StandardBsdf::new(&point, enters, coat_normal))
            }
            Surface::Phong(_) | Surface::Unlit(_) => {
                let mut point = eval.phong(&surface.phong(), vertex_color);
                point.ior /= around.ior;
                Self::Phong(PhongBsdf::new(&point, enters))
            }
        }
    }

    /// What a viewer sees of it.
    #[inline]
    pub(crate) fn seen_from(&self, wo: Vec3) -> View<'_> {
        match self {
            Self::Phong(phong) => View::Phong(phong, wo),
            Self::Standard(standard) => View::Standard(standard.seen_from(wo)),
        }
    }
}

/// A surface at a point and a viewer of it, in the unit direction `wo`: what both decide is worked out once.
#[derive(Clone, Copy, Debug)]
pub(crate) enum View<'b> {
    /// The report's surface.
    Phong(&'b PhongBsdf, Vec3),
    /// The physically based surface.
    Standard(StandardView<'b>),
}

impl View<'_> {
    /// Whether light is scattered into more than a few directions: only then lights are worth asking.
    #[inline]
    pub(crate) fn scatters(&self) -> bool {
        match self {
            Self::Phong(phong, _) => phong.scatters(),
            Self::Standard(view) => view.scatters(),
        }
    }

    /// Whether light from behind the surface is scattered to the viewer, too.
    #[inline]
    pub(crate) fn is_open(&self) -> bool {
        match self {
            Self::Phong(..) => false,
            Self::Standard(view) => view.is_open(),
        }
    }

    /// The value, and the density with which [`Self::sample`] draws `wi`; mirror and clear glass left out.
    #[inline]
    pub(crate) fn eval(&self, wi: Vec3) -> (Rgb, f32) {
        match self {
            Self::Phong(phong, wo) => phong.eval(*wo, wi),
            Self::Standard(view) => view.answer(wi),
        }
    }

    /// A direction by random numbers in `[0, 1)`: `layer` chooses among layers, `u` the direction. `None` where the light is
    /// lost. What the channels of the path carry decides which colours glass parts.
    #[inline]
    pub(crate) fn sample(&self, carried: Rgb, layer: f32, u: Vec2) -> Option<BsdfSample> {
        match self {
            Self::Phong(phong, wo) => phong.sample(*wo, layer, u),
            Self::Standard(view) => view.sample_for(carried, u.extend(layer)),
        }
    }

    /// The density with which [`Self::sample`] draws `wi` as an [`Event::Diffuse`].
    #[inline]
    pub(crate) fn matte_pdf(&self, wi: Vec3) -> f32 {
        match self {
            Self::Phong(phong, _) => phong.matte_pdf(wi),
            Self::Standard(view) => view.matte_pdf(wi),
        }
    }

    /// Whether any direction is drawn as an [`Event::Diffuse`].
    #[inline]
    pub(crate) fn is_matte(&self) -> bool {
        match self {
            Self::Phong(phong, _) => phong.is_matte(),
            Self::Standard(view) => view.is_matte(),
        }
    }

    /// How broadly it scatters, from 0 where mirrors and clear glass are all there is to 1 where all of it is matte: the mean width of
    /// what [`Self::sample`] draws. A guess, of which nothing depends but noise.
    #[inline]
    pub(crate) fn breadth(&self) -> f32 {
        match self {
            Self::Phong(phong, _) => phong.breadth(),
            Self::Standard(view) => view.breadth(),
        }
    }

    /// The share of the light that goes through without a bend, per channel in `[0, 1]`; 0 where it is bent or scattered.
    #[inline]
    pub(crate) fn straight(&self) -> Rgb {
        match self {
            Self::Phong(phong, wo) => phong.straight(*wo),
            Self::Standard(view) => view.straight(),
        }
    }

    /// The share of the light that it sends on, highlights left out; per channel in `[0, 1]`.
    pub(crate) fn albedo(&self) -> Rgb {
        match self {
            Self::Phong(phong, _) => phong.albedo(),
            Self::Standard(view) => view.albedo(),
        }
    }
}
