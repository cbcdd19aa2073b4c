//! The walk of light below a surface, from where it was let in to where it comes out.
//!
//! The boundary of the body lets all light out: what it reflects is reflected where light is seen.
//!
//! # Source
//! Chiang, Kutz, Burley, "Practical and Controllable Subsurface Scattering for Production Path Tracing", SIGGRAPH Talks 2016;
//! Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", 2017.

use crate::medium::PreparedMedium;
use crate::medium::lead::Lead;
use crate::sampler::Sampler;
use crate::world::{PassingRay, SurfaceHit, Thing, World};
use heliostat_geometry::Ray;
use heliostat_scene::Rgb;

/// From so many scatterings on a walk ends by chance.
const CERTAIN: u32 = 3;
/// Most scatterings of a walk: a body so large and clear that light wanders longer would take for ever.
const MOST: u32 = 1 << 20;

/// Where light walks.
pub(super) struct Walk<'w, 's> {
    pub(super) world: &'w World<'s>,
    /// Inside of which thing.
    pub(super) thing: Thing,
    /// What fills it.
    pub(super) medium: &'w PreparedMedium<'static>,
    pub(super) time: f32,
}

impl Walk<'_, '_> {
    /// Follows a ray that was let in: where it comes out, and what it carries; `None` where it is absorbed, or lost through a
    /// hole of the body.
    pub(super) fn follow(
        &self,
        mut passing: PassingRay,
        carried: Rgb,
        draws: &mut Sampler,
    ) -> Option<(SurfaceHit, Rgb)> {
        let (bounds, start) = (self.world.bounds_of(self.thing), carried.max_element());
        let mut carried = carried;
        passing.ray.dir = passing.ray.dir.normalize();
        for scattering in 0..MOST {
            let u = draws.next_2d();
            let mut lead = Lead::new(carried, u.x)?;
            let ray = passing.ray;
            let reach = self.medium.reach(&lead, u.y);
            let search = PassingRay { ray: ray.until(reach), ..passing };
            if let Some(surface) = self.world.own_surface(self.thing, &search, self.time) {
                self.medium.get_through(surface.hit.t, &mut lead, &mut carried);
                carried /= lead.own();
                if surface.hit.at.ng.dot(ray.dir) > 0.0 {
                    return carried.is_finite().then_some((surface, carried));
                }
                // Rounding had let it out.
                passing = passing.behind(&surface, ray.dir);
                continue;
            }
            self.medium.stop(reach, &mut lead, &mut carried);
            carried /= lead.own();
            let p = ray.at(reach);
            if !bounds.contains(p) {
                return None;
            }
            let u = draws.next_2d();
            passing = PassingRay::free(Ray::new(p, self.medium.phase.sample(ray.dir, u).0));
            if scattering >= CERTAIN {
                let survives = (carried.max_element() / start).min(1.0);
                if survives < 1.0 && draws.next_1d() >= survives {
                    return None;
                }
                carried /= survives;
            }
        }
        None
    }
}
