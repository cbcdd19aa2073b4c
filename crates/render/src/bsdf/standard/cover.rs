//! What lies over the base: a clear coat, and under it standing fibres.

use crate::bsdf::fresnel::Boundary;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::reflect::Facet;
use crate::bsdf::sheen::Sheen;
use crate::bsdf::standard::StandardPoint;
use crate::bsdf::table::{Curve, CurveSeen, Reflection, SheenAlbedo, SheenStopped};
use glam::{Vec2, Vec3};
use heliostat_geometry::OrthonormalFrame;
use heliostat_scene::Rgb;
use std::f32::consts::FRAC_1_PI;

/// The layers over the base; each lets pass what it does not send back.
#[derive(Clone, Debug)]
pub(super) struct Cover {
    pub(super) coat: Option<Coat>,
    pub(super) fibres: Option<Fibres>,
    /// What the coat stops of light of white fibres.
    stopped: Option<SheenStopped>,
}

impl Cover {
    /// Nothing over the base: what lies there is outside, and not seen from inside.
    pub(super) const NONE: Self = Self { coat: None, fibres: None, stopped: None };

    /// `coat_normal` is that of the coat in the frame of the surface.
    pub(super) fn new(point: &StandardPoint, coat_normal: Vec3) -> Self {
        let has_sheen = point.sheen_color.max_element() > 0.0;
        let coat = (point.coat > 0.0).then(|| Coat::new(point, coat_normal));
        let stopped = coat.as_ref().filter(|_| has_sheen).map(|coat| {
            SheenStopped::new(point.sheen_roughness, |cos| {
                1.0 - coat.kept(Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos))
            })
        });
        Self { coat, fibres: has_sheen.then(|| Fibres::new(point)), stopped }
    }

    pub(super) fn is_none(&self) -> bool {
        self.coat.is_none() && self.fibres.is_none()
    }

    /// Share of the light that passes on its way in or out along `w`, which may be on either side.
    pub(super) fn passed(&self, w: Vec3) -> f32 {
        self.coat_passed(w) * self.fibres.as_ref().map_or(1.0, |fibres| 1.0 - fibres.kept(w))
    }

    /// The same for the coat alone.
    pub(super) fn coat_passed(&self, w: Vec3) -> f32 {
        self.coat.as_ref().map_or(1.0, |coat| 1.0 - coat.kept(w))
    }
}

impl Cover {
    /// Share of the light that fibres send to a viewer through the coat, and what the coat stops of it.
    pub(super) fn fibres_albedo(&self, wo: Vec3) -> Rgb {
        let Some(fibres) = &self.fibres else { return Rgb::ZERO };
        self.coat_passed(wo) * fibres.albedo(wo)
    }

    /// The value of fibres under the coat, with what fibres and coat throw at each other until it leaves.
    pub(super) fn fibres_value(&self, wo: Vec3, wi: Vec3) -> Rgb {
        let Some(fibres) = &self.fibres else { return Rgb::ZERO };
        let once = self.coat_passed(wo).min(self.coat_passed(wi)) * fibres.value(wo, wi);
        match &self.stopped {
            None => once,
            Some(stopped) => {
                let again = stopped.at(wo.z) * stopped.at(wi.z) / stopped.mean();
                once + fibres.color * (again * wi.z * FRAC_1_PI)
            }
        }
    }
}

/// A clear coat, white.
#[derive(Clone, Debug)]
pub(super) struct Coat {
    /// Share of the surface under it.
    weight: f32,
    frame: OrthonormalFrame,
    /// `None` for a smooth coat.
    pub(super) ggx: Option<Ggx>,
    boundary: Boundary,
    curve: CurveSeen,
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
        let (frame, curve) = (OrthonormalFrame::around(normal), reflection.seen(&curve));
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

    /// Share of the light along `w`, which may be on either side, that the coat sends back.
    pub(super) fn kept(&self, w: Vec3) -> f32 {
        let w = self.local(w);
        if self.ggx.is_none() {
            return self.weight * self.boundary.reflectance(w.z.abs().min(1.0)).x;
        }
        let place = self.reflection.place(w);
        let lost = self.reflection.lost(&place);
        let once = (1.0 - lost) * self.curve.at(&place).x;
        (self.weight * (once + self.between * lost)).clamp(0.0, 1.0)
    }

    /// The value of a rough coat, with what facets throw at each other.
    pub(super) fn value(&self, wo: Vec3, wi: Vec3) -> f32 {
        let (wo, wi) = (self.local(wo), self.local(wi));
        let (Some(ggx), Some(facet)) = (&self.ggx, Facet::between(wo, wi)) else { return 0.0 };
        let once = self.boundary.reflectance(facet.cos).x * facet.value(ggx, wo, wi);
        let lost = |w: Vec3| self.reflection.lost(&self.reflection.place(w));
        let again = self.between * lost(wo) * lost(wi) / self.reflection.lost_mean();
        self.weight * (once + again * wi.z * FRAC_1_PI)
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
    albedo: SheenAlbedo,
    sheen: Sheen,
}

impl Fibres {
    fn new(point: &StandardPoint) -> Self {
        let albedo = SheenAlbedo::new(point.sheen_roughness);
        Self { color: albedo.scale() * point.sheen_color, albedo, sheen: Sheen::new(point.sheen_roughness) }
    }

    /// Share of the light along `w` that the brightest fibres send back.
    pub(super) fn kept(&self, w: Vec3) -> f32 {
        (self.color.max_element() * self.albedo.at(w.z.abs())).clamp(0.0, 1.0)
    }

    /// Share of the light that goes to a viewer.
    pub(super) fn albedo(&self, wo: Vec3) -> Rgb {
        self.color * self.albedo.at(wo.z)
    }

    /// The value.
    pub(super) fn value(&self, wo: Vec3, wi: Vec3) -> Rgb {
        self.color * self.sheen.single(wo, wi)
    }
}
