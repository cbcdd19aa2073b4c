//! The physically based surface: layers and their mixture.
//!
//! From the top: coat, fibres, and a base of facets that are metal or clear in shares; under clear facets lies matte
//! matter, or what is on the other side. Facets and fibres under a cover send back the smaller of what passes the cover on
//! the way in and on the way out, and parts that send light anywhere send the product, scaled to keep what is due. Seen from
//! inside a solid body, cover and matte side of the cover do not exist.

mod balance;
mod base;
mod cover;
mod fill;
mod glass_fill;
mod point;
mod spread;
pub(crate) mod view;

pub(crate) use point::StandardPoint;

use base::{Base, Passage};
use cover::Cover;
use fill::Fill;
use glam::Vec3;
use heliostat_scene::Rgb;
use view::View;

/// The physically based surface at one point, for any viewer on one of its sides.
#[derive(Clone, Debug)]
pub(crate) struct StandardBsdf {
    cover: Cover,
    base: Base,
    fill: Fill,
}

impl StandardBsdf {
    /// `is_outside` says whether the viewer is where the normal of the body points, and `coat_normal` is the normal of the
    /// coat in the local frame.
    pub(crate) fn new(point: &StandardPoint, is_outside: bool, coat_normal: Vec3) -> Self {
        // What is no body is the same on both sides.
        let is_inside = !is_outside && !point.thin_walled && point.transmission > 0.0;
        let base = Base::new(point, !is_inside);
        let cover = if is_inside { Cover::NONE } else { Cover::new(point, coat_normal) };
        let fill = Fill::new(point, &base, &cover);
        Self { cover, base, fill }
    }

    /// What a viewer sees of it.
    #[inline]
    pub(crate) fn seen_from(&self, wo: Vec3) -> View<'_> {
        View::new(self, wo)
    }

    /// About what facets reflect to a viewer: the rougher, the less the angle matters.
    fn reflected_about(&self, wo: Vec3) -> Rgb {
        let alpha = self.base.ggx.map_or(0.0, |ggx| ggx.mean_alpha());
        self.base.reflected(wo.z.min(1.0)).lerp(self.base.reflected(0.5), alpha)
    }

    /// About what facets let through to a viewer.
    fn passed_about(&self, wo: Vec3) -> Rgb {
        match (&self.base.ggx, self.base.passage) {
            (Some(ggx), Passage::Bent | Passage::Sheet) => {
                self.base.passed(wo.z.min(1.0)).lerp(self.base.passed(1.0), ggx.mean_alpha())
            }
            _ => self.smooth_passed(wo),
        }
    }

    /// What a boundary that bends light as a smooth one lets through; it may reflect as a rough one.
    fn smooth_passed(&self, wo: Vec3) -> Rgb {
        match self.base.passage {
            Passage::Straight => self.base.glass_share() * self.base.tint * self.fill.face_passed(wo),
            _ => self.base.passed(wo.z.min(1.0)),
        }
    }
}
