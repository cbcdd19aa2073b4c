//! What a path finds on its way, by the share that asking for it has left over.

use super::VolPath;
use super::way::Way;
use crate::integrator::FirstHit;
use crate::integrator::next_event::heuristic;
use crate::light::Lookout;
use crate::world::{SurfaceHit, World};
use heliostat_scene::Rgb;

/// What a path has found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Found {
    pub(super) radiance: Rgb,
    /// Weight with which it left the scene where the background is to stay transparent.
    pub(super) through: f32,
    pub(super) first: Option<FirstHit>,
}

impl VolPath {
    /// Adds the light of a surface that shines, by the share that asking for it has left over.
    #[inline]
    pub(super) fn add_light(
        &self,
        world: &World<'_>,
        way: &Way,
        surface: &SurfaceHit,
        shine: Rgb,
        found: &mut Found,
    ) {
        if shine == Rgb::ZERO {
            return;
        }
        let (own, asked) = way.chances();
        let share = |(from, pdf): (Lookout, f32)| {
            heuristic(pdf * own, world.light_table().density(&from, surface) * asked)
        };
        let share = way.scattered.map_or(1.0, share);
        found.radiance += self.clamped(share * way.settled() * shine, way.depth.all().saturating_sub(1));
    }

    /// Adds what comes from infinitely far, or leaves it transparent.
    pub(super) fn leave(&self, world: &World<'_>, way: &Way, found: &mut Found) {
        let weight = way.settled();
        if !weight.is_finite() {
            return;
        }
        if self.transparent_background && way.passed_only {
            found.through = weight.element_sum() / 3.0;
            return;
        }
        let (lights, dir) = (world.light_table(), way.track.dir().normalize());
        let (own, asked) = way.chances();
        let radiance = match &way.scattered {
            Some((from, pdf)) => lights.beyond(from, dir, |other| heuristic(pdf * own, other * asked)),
            None if way.passed_only => lights.seen(dir),
            None => lights.mirrored(dir),
        };
        found.radiance += self.clamped(weight * radiance, way.depth.all().saturating_sub(1));
    }

    /// Light that was scattered so often before, weakened to what is let through of indirect light; nothing where rounding has
    /// lost it.
    #[inline]
    pub(super) fn clamped(&self, light: Rgb, scatterings: u32) -> Rgb {
        let most = light.max_element();
        match scatterings > 0 && most > self.clamp {
            _ if !light.is_finite() => Rgb::ZERO,
            true => self.clamp / most * light,
            false => light,
        }
    }
}
