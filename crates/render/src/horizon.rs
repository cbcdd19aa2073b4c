//! Which light meets a surface whose facets stand for a smooth one.

use crate::world::{SurfaceHit, World};
use glam::Vec3;
use heliostat_geometry::SurfacePoint;

/// What a point of a surface can see of the light on the viewer's side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Horizon {
    /// Where light arrives and leaves; its normal is turned to the viewer.
    pub(crate) start: SurfacePoint,
    /// Whether `start` was lifted off the facet onto the smooth surface that the facets stand for.
    pub(crate) lifted: bool,
    /// The smooth normal on the viewer's side, without relief: light from behind it is not seen.
    pub(crate) smooth: Vec3,
}

impl Horizon {
    /// That of a hit whose normals, the geometric `ng` and the interpolated `smooth`, were turned to the viewer; against
    /// those of the hit where it is `turned`.
    pub(crate) fn new(
        world: &World<'_>,
        surface: &SurfaceHit,
        [ng, smooth]: [Vec3; 2],
        turned: bool,
        time: f32,
    ) -> Self {
        let at = surface.hit.at;
        let lift = world.lift(surface, turned, time);
        // A lift within the rounding of the point is none.
        let lifted = lift.dot(ng) > ng.abs().dot(at.p_err);
        let start = if lifted {
            SurfacePoint { p: at.p + lift, ng: smooth, ..at }
        } else {
            SurfacePoint { ng, ..at }
        };
        Self { start, lifted, smooth }
    }

    /// Whether light fades out towards the side of a facet: the smooth surface is another one, and lies below.
    #[inline]
    pub(crate) fn fades(&self) -> bool {
        !self.lifted && self.start.ng != self.smooth
    }

    /// The share of the light from a unit direction that the shape of the surface lets in: none from behind it, whatever the
    /// shading normal says. It fades where [`Horizon::fades`], so that facets do not show when they turn away.
    ///
    /// # Source
    /// Chiang, Li, Burley, "Taming the Shadow Terminator", SIGGRAPH Talks 2019.
    #[inline]
    pub(crate) fn facing(&self, to_light: Vec3) -> f32 {
        let (cos, facet_cos) = (self.smooth.dot(to_light), self.start.ng.dot(to_light));
        if cos <= 0.0 || (facet_cos <= 0.0 && !self.lifted) {
            return 0.0;
        }
        if !self.fades() {
            return 1.0;
        }
        let g = (facet_cos / (cos * self.start.ng.dot(self.smooth))).clamp(0.0, 1.0);
        g * (1.0 + g * (1.0 - g))
    }
}
