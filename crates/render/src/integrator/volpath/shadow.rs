//! Light that comes straight from a light through media and their boundaries.

use super::{SHADOW, Step};
use crate::integrator::next_event::{heuristic, left_of};
use crate::interiors::Interiors;
use crate::light::{LightSample, Target};
use crate::medium::flight;
use crate::medium::lead::Lead;
use crate::path_point::Covering;
use crate::world::PassingRay;
use glam::Vec3;
use heliostat_geometry::{Ray, SurfacePoint};
use heliostat_scene::Rgb;

/// The shadow ray from a point of a medium.
pub(super) fn ray_to(p: Vec3, light: &LightSample) -> Ray {
    let start = SurfacePoint { p, p_err: Vec3::ZERO, ng: light.to_light };
    match &light.target {
        Target::Sky => Ray::new(p, light.to_light),
        Target::Point(target) => start.spawn_to(*target),
        Target::Surface(at) => start.spawn_to_surface(at),
    }
}

/// A shadow ray passes so many boundaries of media at most.
const MOST_BOUNDARIES: usize = 256;

/// A point asks a light.
pub(super) struct Ask<'a> {
    pub(super) light: &'a LightSample,
    pub(super) ray: Ray,
    /// Weight of the path times what the point sends on of light from there.
    pub(super) carried: Rgb,
    /// The density with which the point sends a path there.
    pub(super) pdf: f32,
}

/// What gets through media, with the densities of a flight and of this ray on the same way.
struct Passed {
    share: Rgb,
    own: f32,
    asked: f32,
}

impl Ask<'_> {
    /// What the path carries of the light, by the share that it does not find by itself.
    pub(super) fn answer(&self, step: &mut Step<'_, '_, '_>, around: &Interiors) -> Rgb {
        let answer = self.carried * self.light.arriving;
        if answer == Rgb::ZERO {
            return Rgb::ZERO;
        }
        step.counters.shadow += 1;
        let shown = answer * step.world.transmittance(&self.ray, step.time);
        if shown == Rgb::ZERO {
            return Rgb::ZERO;
        }
        let Passed { share, own, asked } = self.through_media(step, *around);
        let weight = match self.light.pdf {
            f32::INFINITY => 1.0,
            pdf => heuristic(pdf * asked, self.pdf * own),
        };
        weight * shown * share / asked
    }

    /// What gets through all that lies on the way, surfaces aside.
    fn through_media(&self, step: &Step<'_, '_, '_>, mut around: Interiors) -> Passed {
        let (world, ray) = (step.world, self.ray);
        let (mut passed, mut lead) = (Rgb::ONE, None);
        if !world.has_media() && around.ruling().is_none() {
            return Passed { share: passed, own: 1.0, asked: 1.0 };
        }
        let mut draws = step.draws.fork(SHADOW);
        let (length, mut left) = (ray.dir.length(), ray.range.max);
        let mut passing = PassingRay::free(ray);
        for _ in 0..MOST_BOUNDARIES {
            let boundary = world.boundary(&passing, step.time);
            if boundary.is_none() && !left.is_finite() {
                around.retain(|inside| !world.bounds_of(inside.thing).is_finite());
            }
            let end = boundary.map_or(left, |surface| surface.hit.t);
            // What does not bend light is known to the surfaces that the ray passes.
            if let Some(inside) = around.ruling().filter(|inside| inside.bends && end.is_finite()) {
                passed *= left_of(inside.absorption, end * length);
            }
            if let Some(matter) = world.matter(&around) {
                let (origin, dir) = (passing.ray.origin, ray.dir / length);
                let way = matter.clip(flight::Way { origin, dir, from: 0.0, to: end * length });
                if way.from < way.to {
                    lead = lead.or_else(|| Lead::new(self.carried, draws.next_1d()));
                    let Some(lead) = &mut lead else { break };
                    matter.medium.pass(&way, lead, &mut passed, &mut draws);
                }
            }
            let Some((surface, material)) = boundary.as_ref().and_then(|s| Some((s, s.material()?))) else {
                break;
            };
            if passed == Rgb::ZERO {
                break;
            }
            let covering = Covering::new(world, surface, material);
            around.change(&covering.straight_change(surface, ray.dir));
            left -= end;
            passing = passing.behind(surface, ray.dir);
            passing.ray.range.max = left;
        }
        let (own, asked) = lead.map_or((1.0, 1.0), |lead: Lead| (lead.own(), lead.asked()));
        Passed { share: passed, own, asked }
    }
}
