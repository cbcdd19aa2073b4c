//! Lamps beside a ray through fog: light that they send to points of the way is found where there is most of it.
//!
//! A flight ends where the medium says, and seldom close to a lamp, though light there grows with one over the square of
//! the distance: the glow around a lamp is all sparks. So of each way through a medium that is the same everywhere a second point is
//! drawn for one of the lamps that are points, even by the angle under which the lamp sees the way, for a spot the part in
//! its cone. Both points ask the lamp, each by the share that the other would not have found.
//!
//! # Source
//! Kulla, Fajardo, "Importance Sampling Techniques for Path Tracing in Participating Media", EGSR 2012 (equi-angular sampling).

use super::shadow::{Ask, ray_to};
use super::{LAMP, Step};
use crate::integrator::next_event::heuristic;
use crate::interiors::Interiors;
use crate::light::Lookout;
use crate::medium::PreparedMedium;
use crate::medium::flight::Way;
use crate::world::World;
use glam::Vec3;
use heliostat_scene::Rgb;

/// A way through a medium.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<'a, 's> {
    pub(super) medium: &'a PreparedMedium<'s>,
    pub(super) way: Way,
    /// Whether a lamp is asked from a point of its own: the medium is the same everywhere, and there are lamps.
    pub(super) asks_lamps: bool,
}

/// A way as a lamp sees it.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Where on the way the lamp is nearest, and how near.
    foot: f32,
    height: f32,
    /// Angles from there to the start of the way, and to its end.
    angles: [f32; 2],
}

impl Seen {
    fn new(way: &Way, lamp: Vec3) -> Self {
        let to_lamp = lamp - way.origin;
        let foot = to_lamp.dot(way.dir);
        let height = (to_lamp - foot * way.dir).length();
        let angles = [way.from, way.to].map(|t| ((t - foot) / height).atan());
        Self { foot, height, angles }
    }

    /// A distance on the way, even by angle, for `u` in `[0, 1)`.
    fn draw(&self, u: f32) -> f32 {
        let [a, b] = self.angles;
        self.foot + self.height * (a + u * (b - a)).tan()
    }

    /// The density of [`Self::draw`] per metre; 0 for a lamp on the way, which sees all of it in one direction.
    fn density(&self, t: f32) -> f32 {
        let [a, b] = self.angles;
        let beyond = t - self.foot;
        let density = self.height / ((b - a) * (self.height * self.height + beyond * beyond));
        if density.is_finite() { density } else { 0.0 }
    }
}

impl<'a, 's> Stretch<'a, 's> {
    pub(super) fn new(world: &World<'_>, medium: &'a PreparedMedium<'s>, way: Way) -> Self {
        Self { medium, way, asks_lamps: medium.is_even_fog() && world.light_table().has_lamps() }
    }

    /// What a path that carries so much finds of a lamp on the way.
    pub(super) fn glow(&self, step: &mut Step<'_, '_, '_>, carried: Rgb, around: &Interiors) -> Rgb {
        let mut draws = step.draws.fork(LAMP);
        let u = draws.next_2d();
        let lights = step.world.light_table();
        let Some((lamp, at)) = lights.pick_lamp(u.x) else { return Rgb::ZERO };
        let t = Seen::new(&lights.lit_by_lamp(lamp, &self.way), at).draw(u.y);
        let own = self.density(step, lamp, t);
        let is_on_way = self.way.from < t && t < self.way.to && own > 0.0;
        let p = self.way.at(t);
        let Some(light) = lights.of_lamp(lamp, p).filter(|_| is_on_way) else { return Rgb::ZERO };
        let (scattered, flight) = self.medium.scattered_after(t - self.way.from);
        let pdf = self.medium.phase.density(self.way.dir, light.to_light);
        let ask = Ask { light: &light, ray: ray_to(p, &light), carried: carried * scattered * pdf, pdf };
        let weight = heuristic(own, flight * lights.odds(&self.lookout(step, t), lamp));
        weight / own * ask.answer(step, around)
    }

    /// The share of a light that is left to a flight that asks it `t` metres from the origin.
    pub(super) fn left(&self, step: &Step<'_, '_, '_>, lamp: usize, t: f32) -> f32 {
        let (_, flight) = self.medium.scattered_after(t - self.way.from);
        let own = flight * step.world.light_table().odds(&self.lookout(step, t), lamp);
        heuristic(own, self.density(step, lamp, t))
    }

    /// The density with which a distance is drawn for a lamp here, the choice of the lamp included.
    fn density(&self, step: &Step<'_, '_, '_>, lamp: usize, t: f32) -> f32 {
        let lights = step.world.light_table();
        let Some((at, probability)) = lights.lamp(lamp) else { return 0.0 };
        let lit = lights.lit_by_lamp(lamp, &self.way);
        let is_lit = lit.from < t && t < lit.to;
        if is_lit { probability * Seen::new(&lit, at).density(t) } else { 0.0 }
    }

    fn lookout(&self, step: &Step<'_, '_, '_>, t: f32) -> Lookout {
        Lookout::in_medium(self.way.at(t), step.time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_drawn_by_their_density() {
        for (from, to, lamp) in [
            (0.0, 4.0, Vec3::new(1.0, 0.5, 0.0)),
            (0.0, 4.0, Vec3::new(-3.0, 0.0, 2.0)),
            (1.5, f32::INFINITY, Vec3::new(7.0, 0.0, 0.1)),
        ] {
            let way = Way { origin: Vec3::ZERO, dir: Vec3::X, from, to };
            let seen = Seen::new(&way, lamp);
            assert!((seen.draw(0.0) - from).abs() < 1e-3);
            // The density is the share of draws over the length on which they lie.
            let step = 1e-3;
            for i in 1..10 {
                let u = 0.1 * i as f32;
                let (before, after) = (seen.draw(u - step), seen.draw(u + step));
                let share = seen.density(seen.draw(u)) * (after - before);
                assert!((share / (2.0 * step) - 1.0).abs() < 1e-2, "{lamp}: {u} has {share}");
            }
        }
        let along = Way { origin: Vec3::ZERO, dir: Vec3::X, from: 0.0, to: 2.0 };
        assert_eq!(Seen::new(&along, Vec3::X).density(0.5), 0.0);
    }
}
