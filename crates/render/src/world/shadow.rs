//! What is left of light on its way: solid things stop it, cut-outs and (as an option) glass let a part through.

use super::World;
use super::filter::Filter;
use super::hull::Hull;
use super::level::Candidates;
use super::shaft::Shaft;
use super::solid::Content;
use heliostat_geometry::{Ray, SurfacePoint};
use heliostat_scene::Rgb;

impl World<'_> {
    /// Whether something that lets no light through lies in the range of the ray.
    pub fn occluded(&self, ray: &Ray, time: f32) -> bool {
        self.is_stopped(ray, time, Candidates::All)
    }

    /// The share of light that comes along a ray past everything that throws shadows.
    ///
    /// Light goes straight on: glass colours it by `transparency` at each surface and by its absorption inside, but does
    /// not bend it.
    pub fn transmittance(&self, ray: &Ray, time: f32) -> Rgb {
        self.transmittance_past(ray, time, Candidates::All)
    }

    /// What may stop rays that leave a surface point of object `own`, to the side of its normal.
    pub(crate) fn casters(&self, start: &SurfacePoint, own: Option<u32>) -> Candidates {
        match own.filter(|&own| self.solids[own as usize].is_left_by_rays(start)) {
            Some(own) => self.level.narrow(self.casters, |i| i != own),
            None => self.casters,
        }
    }

    /// Those of the candidates that may stop rays from a surface point to a light in the hull `light`.
    pub(crate) fn blockers(&self, start: &SurfacePoint, casters: Candidates, light: &Hull) -> Candidates {
        // A ray starts at most so far from the point.
        let moved = 2.0 * start.p_err.element_sum();
        let shaft = Shaft::new(start.p, moved, light);
        self.level.narrow(casters, |i| self.solids[i as usize].may_block(&shaft))
    }

    /// [`World::transmittance`] where only the candidates can stop the light.
    #[inline]
    pub(crate) fn transmittance_past(&self, ray: &Ray, time: f32, candidates: Candidates) -> Rgb {
        if self.is_stopped(ray, time, candidates) {
            Rgb::ZERO
        } else if self.has_filters {
            self.filtered(ray, time, candidates)
        } else {
            Rgb::ONE
        }
    }

    #[inline]
    fn is_stopped(&self, ray: &Ray, time: f32, candidates: Candidates) -> bool {
        self.level.any(ray, candidates.among(self.stoppers), |i, ray| {
            self.shadows[i as usize].stops && self.solids[i as usize].blocks(ray, time)
        })
    }

    /// The share that passes the things that let light through.
    fn filtered(&self, ray: &Ray, time: f32, candidates: Candidates) -> Rgb {
        let mut share = Rgb::ONE;
        self.level.each(ray, candidates.among(self.filters), |i| {
            if self.shadows[i as usize].filters && share != Rgb::ZERO {
                share *= self.share_past(i, ray, time);
            }
        });
        share
    }

    /// The share that passes what lets light through in one solid.
    pub(super) fn share_past(&self, solid: u32, ray: &Ray, time: f32) -> Rgb {
        let object = &self.scene.objects[solid as usize];
        let solid = &self.solids[solid as usize];
        let filter = |object| Filter { scene: self.scene, object, clear: self.clear };
        let mut room = None;
        // Without a place at this moment it stops nothing.
        let Some(place) = solid.place.at(time, &mut room) else { return Rgb::ONE };
        match &solid.content {
            Content::Body(body) => filter(object).share(ray, body, place),
            Content::Group(group) => {
                let mut share = Rgb::ONE;
                group.each_filter(ray, time, place, &mut |part| {
                    if let Some(object) = part.object.filter(|_| share != Rgb::ZERO) {
                        share *= filter(object).share(ray, part.body, part.place);
                    }
                });
                share
            }
        }
    }
}
