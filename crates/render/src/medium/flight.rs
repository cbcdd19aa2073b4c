//! How far light flies through a medium before it is scattered, and what of it gets through.
//!
//! Where a medium is the same everywhere, the distance is drawn in closed form. Where it is not, the rest up to the largest
//! density of a block is filled with matter that changes nothing, and collisions with that are flown on (delta tracking); a
//! shadow ray takes their share instead (ratio tracking). Absorption never ends a flight: it weakens it.
//!
//! # Source
//! Woodcock et al., "Techniques Used in the GEM Code", 1965; Novák, Selle, Jarosz, "Residual Ratio Tracking", SIGGRAPH Asia
//! 2014; Miller, Georgiev, Jarosz, "A Null-Scattering Path Integral Formulation of Light Transport", SIGGRAPH 2019.

use super::grid::Grid;
use super::lead::Lead;
use super::{PreparedMedium, transmitted};
use crate::sampler::Sampler;
use glam::Vec3;
use heliostat_scene::Rgb;

/// Below this share a shadow ray ends by chance, and else goes on with so much more.
const LITTLE: f32 = 0.05;
const SURVIVAL: f32 = 0.25;

/// A way through a medium: points at distances in metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    pub(crate) origin: Vec3,
    /// Unit direction.
    pub(crate) dir: Vec3,
    /// From this distance to that one, which may be infinite.
    pub(crate) from: f32,
    pub(crate) to: f32,
}

impl Way {
    #[inline]
    pub(crate) fn at(&self, t: f32) -> Vec3 {
        self.origin + t * self.dir
    }
}

impl PreparedMedium<'_> {
    /// Whether it scatters, and does so alike everywhere.
    #[inline]
    pub(crate) fn is_even_fog(&self) -> bool {
        self.grid.is_none() && self.scatters()
    }

    /// What a medium that is the same everywhere scatters of light per metre, after so many metres, and the density with which flights
    /// end there, the mean of those of the channels.
    pub(crate) fn scattered_after(&self, way: f32) -> (Rgb, f32) {
        let through = transmitted(self.extinction, way);
        (through * self.scattering, (through * self.extinction).element_sum() / 3.0)
    }

    /// Whether it scatters; else it only absorbs.
    fn scatters(&self) -> bool {
        self.scattering != Rgb::ZERO
    }

    /// Flies along a way: the distance of the scattering, `None` at its end. What is carried is multiplied by value over density
    /// of the channel that leads.
    pub(crate) fn fly(
        &self,
        way: &Way,
        lead: &mut Lead,
        carried: &mut Rgb,
        draws: &mut Sampler,
    ) -> Option<f32> {
        match &self.grid {
            Some(grid) => self.fly_grid(grid, way, lead, carried, draws),
            None if self.scatters() => self.fly_even(way, lead, carried, draws),
            None => {
                *carried *= transmitted(self.extinction, way.to - way.from);
                None
            }
        }
    }

    /// Lets light for a shadow ray through: multiplies what is carried by value over density of the channel that leads.
    pub(crate) fn pass(&self, way: &Way, lead: &mut Lead, carried: &mut Rgb, draws: &mut Sampler) {
        let Some(grid) = &self.grid else {
            let through = transmitted(self.extinction, way.to - way.from);
            *carried *= through;
            if self.scatters() {
                lead.own *= through;
            }
            return;
        };
        self.pass_grid(grid, way, lead, carried, draws);
    }

    fn fly_even(&self, way: &Way, lead: &mut Lead, carried: &mut Rgb, draws: &mut Sampler) -> Option<f32> {
        let t = way.from + self.reach(lead, draws.next_1d());
        if t < way.to {
            self.stop(t - way.from, lead, carried);
            return Some(t);
        }
        self.get_through(way.to - way.from, lead, carried);
        None
    }

    /// How far light gets in a medium that is the same everywhere, for `u` in `[0, 1)`.
    pub(crate) fn reach(&self, lead: &Lead, u: f32) -> f32 {
        free_way(u, lead.of(self.extinction))
    }

    /// What is carried when light is scattered after that way.
    pub(crate) fn stop(&self, way: f32, lead: &mut Lead, carried: &mut Rgb) {
        let through = transmitted(self.extinction, way);
        let chance = lead.of(through * self.extinction);
        *carried *= through * self.scattering / chance;
        lead.own *= through * self.extinction / chance;
    }

    /// What is carried when light is not scattered on that way.
    pub(crate) fn get_through(&self, way: f32, lead: &mut Lead, carried: &mut Rgb) {
        let through = transmitted(self.extinction, way);
        let chance = lead.of(through);
        *carried *= through / chance;
        lead.own *= through / chance;
        // A shadow ray gets there without chance.
        lead.asked /= chance;
    }

    fn fly_grid(
        &self,
        grid: &Grid<'_>,
        way: &Way,
        lead: &mut Lead,
        carried: &mut Rgb,
        draws: &mut Sampler,
    ) -> Option<f32> {
        for block in grid.blocks(way) {
            let most = block.most * self.extinction;
            let rate = lead.of(most);
            let mut t = block.from;
            loop {
                let u = draws.next_2d();
                let step = free_way(u.x, rate);
                // Written so that an endless way ends.
                if t + step >= block.to || step == f32::INFINITY {
                    leave_block(most, block.to - t, lead, carried);
                    break;
                }
                t += step;
                let through = transmitted(most, step);
                let share = grid.density(way.at(t)).min(block.most) / block.most;
                if u.y < share {
                    let chance = lead.of(through) * rate * share;
                    let density = share * block.most;
                    *carried *= through * density * self.scattering / chance;
                    lead.own *= through * density * self.extinction / chance;
                    return Some(t);
                }
                let chance = lead.of(through) * rate * (1.0 - share);
                let onward = through * most * (1.0 - share) / chance;
                *carried *= onward;
                lead.own *= onward;
                lead.asked *= through * most / chance;
            }
        }
        None
    }

    fn pass_grid(&self, grid: &Grid<'_>, way: &Way, lead: &mut Lead, carried: &mut Rgb, draws: &mut Sampler) {
        let start = carried.max_element();
        for block in grid.blocks(way) {
            let most = block.most * self.extinction;
            let rate = lead.of(most);
            let mut t = block.from;
            loop {
                let u = draws.next_2d();
                let step = free_way(u.x, rate);
                if t + step >= block.to || step == f32::INFINITY {
                    leave_block(most, block.to - t, lead, carried);
                    break;
                }
                t += step;
                let through = transmitted(most, step);
                let chance = lead.of(through) * rate;
                let share = grid.density(way.at(t)).min(block.most) / block.most;
                let any = through * most / chance;
                *carried *= (1.0 - share) * any;
                lead.own *= (1.0 - share) * any;
                lead.asked *= any;
                if carried.max_element() < LITTLE * start * lead.asked() {
                    if u.y >= SURVIVAL {
                        *carried = Rgb::ZERO;
                        return;
                    }
                    *carried /= SURVIVAL;
                }
            }
        }
    }
}

/// A distance with density `rate * exp(-rate * t)`, for `u` in `[0, 1)`.
#[inline]
fn free_way(u: f32, rate: f32) -> f32 {
    if rate > 0.0 { -(-u).ln_1p() / rate } else { f32::INFINITY }
}

/// What is carried out of a block of a grid, after the way that is left in it.
fn leave_block(most: Rgb, way: f32, lead: &mut Lead, carried: &mut Rgb) {
    let rest = transmitted(most, way);
    let through = rest / lead.of(rest);
    *carried *= through;
    lead.own *= through;
    lead.asked *= through;
}
