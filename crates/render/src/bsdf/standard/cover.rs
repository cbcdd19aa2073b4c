//! What lies over the base: a clear coat, and under it standing fibres.

use crate::bsdf::fresnel::Boundary;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::reflect::Facet;
use crate::bsdf::sheen::Sheen;
use crate::bsdf::standard::StandardPoint;
use crate::bsdf::table::{Curve, Reflection, sheen_albedo, sheen_scale};
use glam::{Vec2, Vec3};
use heliostat_geometry::OrthonormalFrame;
use heliostat_scene::Rgb;
use std::f32::consts::FRAC_1_PI;

/// The layers over the base; each lets pass what it does not send back.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cover {
    pub(super) coat: Option<Coat>,
    pub(super) fibres: Option<Fibres>,
}

impl Cover {
    /// Nothing over the base: what lies there is outside, and not seen from inside.
    pub(super) const NONE: Self = Self { coat: None, fibres: None };

    /// `coat_normal` is that of the coat in the frame of the surface.
    pub(super) fn new(point: &StandardPoint, coat_normal: Vec3) -> Self {
        let has_sheen = point.sheen_color.max_element() > 0.0;
        Self {
            coat: (point.coat > 0.0).then(|| Coat::new(point, coat_normal)),
            fibres: has_sheen.then(|| Fibres::new(point)),
        }
    }

    pub(super) fn is_none(&self) -> bool {
        self.coat.is_none() && self.fibres.is_none()
    }

    /// Share of the light that passes on its way in or out along `w`, which may be on either side.
    pub(super) fn passed(&self, w: Vec3) -> f32 {
        self.coat_passed(w) * self.fibres.map_or(1.0, |fibres| 1.0 - fibres.kept(w))
    }

    /// The same for the coat alone.
    pub(super) fn coat_passed(&self, w: Vec3) -> f32 {
        self.coat.map_or(1.0, |coat| 1.0 - coat.kept(w))
    }
}

/// A clear coat, white.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coat {
    /// Share of the surface under it.
    weight: f32,
    frame: OrthonormalFrame,
    /// `None` for a smooth coat.
    pub(super) ggx: Option<Ggx>,
    boundary: Boundary,
    curve: Curve,
    reflection: Reflection,
    /// What is left of light that facets throw at each other.
    between: f32,
}

impl Coat {
    fn new(point: &StandardPoint, normal: Vec3) -> Self {
        let ggx = Ggx::new(point.coat_roughness, 0.0, Vec2::X);
        let boundary = Boundary::new(point.coat_ior.max(1.0), true, 1.0, Rgb::ONE);
        let curve = Curve::new(|cos| boundary.reflectance(cos));
        let reflection = Reflection::of(ggx);
        let between = reflection.between(&curve).x;
        let frame = OrthonormalFrame::around(normal);
        Self { weight: point.coat, frame, ggx, boundary, curve, reflection, between }
    }

    /// From the frame of the surface to that of the coat.
    pub(super) fn local(&self, w: Vec3) -> Vec3 {
        self.frame.to_local(w)
    }

    /// Back from there.
    pub(super) fn world(&self, w: Vec3) -> Vec3 {
        self.frame.to_world(w)
    }

    /// The reflectance of a smooth coat.
    pub(super) fn smooth(&self, wo: Vec3) -> f32 {
        self.weight * self.boundary.reflectance(wo.dot(self.frame.z).clamp(0.0, 1.0)).x
    }

    /// Share of the light that goes to a viewer in all.
    pub(super) fn share(&self, wo: Vec3) -> f32 {
        if self.ggx.is_some() { self.kept(wo) } else { self.smooth(wo) }
    }

    /// Share of the light along `w` that the coat sends back.
    fn kept(&self, w: Vec3) -> f32 {
        let w = self.local(w);
        let once = self.reflection.albedo(&self.curve, w).x;
        (self.weight * (once + self.between * self.reflection.lost(w))).clamp(0.0, 1.0)
    }

    /// The value of a rough coat, with what facets throw at each other.
    pub(super) fn value(&self, wo: Vec3, wi: Vec3) -> f32 {
        let (wo, wi) = (self.local(wo), self.local(wi));
        let (Some(ggx), Some(facet)) = (&self.ggx, Facet::between(wo, wi)) else { return 0.0 };
        let once = self.boundary.reflectance(facet.cos).x * facet.value(ggx, wo, wi);
        let lost = self.reflection.lost(wo) * self.reflection.lost(wi) / self.reflection.lost_mean();
        let again = self.between * lost * wi.z * FRAC_1_PI;
        self.weight * (once + again)
    }

    /// Density of `wi` among directions drawn for facets of a rough coat.
    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let (wo, wi) = (self.local(wo), self.local(wi));
        match (&self.ggx, Facet::between(wo, wi)) {
            (Some(ggx), Some(facet)) => facet.pdf(ggx, wo),
            _ => 0.0,
        }
    }
}

/// Standing fibres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fibres {
    color: Rgb,
    roughness: f32,
    sheen: Sheen,
}

impl Fibres {
    fn new(point: &StandardPoint) -> Self {
        let roughness = point.sheen_roughness;
        let color = sheen_scale(roughness) * point.sheen_color;
        Self { color, roughness, sheen: Sheen::new(roughness) }
    }

    /// Share of the light along `w` that the brightest fibres send back.
    pub(super) fn kept(&self, w: Vec3) -> f32 {
        (self.color.max_element() * sheen_albedo(self.roughness, w.z.abs())).clamp(0.0, 1.0)
    }

    /// Share of the light that goes to a viewer.
    pub(super) fn albedo(&self, wo: Vec3) -> Rgb {
        self.color * sheen_albedo(self.roughness, wo.z)
    }

    /// The value.
    pub(super) fn value(&self, wo: Vec3, wi: Vec3) -> Rgb {
        self.color * self.sheen.single(wo, wi)
    }
}
