//! Light that leaves the lamps towards what may throw it on: where photons begin.
//!
//! A lamp is chosen by what it sends there, then a point of it and a direction; or, for what is infinitely far, a direction and a
//! place. Densities are exact, so what is left to chance is noise alone.
//!
//! # Source
//! Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd edition, section 16.1.2 (sampling of emitted rays).

use super::area::AreaLight;
use super::choice::{Piece, Reach};
use super::sums;
use super::{LightTable, Source};
use crate::photons::Aim;
use crate::sampler::Sampler;
use crate::world::World;
use glam::Vec3;
use heliostat_geometry::Ray;
use heliostat_scene::Rgb;

/// Share of the choices among lamps that is made without regard to what they send: that is only guessed.
const EVEN: f64 = 0.1;

/// The lamps that send photons.
#[derive(Debug)]
pub(crate) struct Emission {
    pieces: Vec<Piece>,
    /// Running sums of their probabilities.
    sums: Vec<f64>,
    /// By lights, whether they send photons.
    sends: Vec<bool>,
    /// Whether lights do that are infinitely far.
    far: bool,
}

/// A photon that leaves a lamp.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emitted {
    pub(crate) ray: Ray,
    /// Its share of the flux of all lamps if it is the only one, in W.
    pub(crate) flux: Rgb,
}

impl Emission {
    /// Whether a light sends photons.
    #[inline]
    pub(crate) fn sends(&self, light: usize) -> bool {
        self.sends[light]
    }

    /// Whether lights send photons that are infinitely far.
    #[inline]
    pub(crate) fn sends_afar(&self) -> bool {
        self.far
    }
}

impl LightTable<'_> {
    /// The lamps that send photons to where `aim` says; `None` where there are none.
    pub(crate) fn emission(&self, aim: &Aim) -> Option<Emission> {
        let far = aim.is_bounded();
        let sends = self.lights.iter().map(|light| match &light.source {
            Source::Point(light) => light.falls_off(),
            Source::Area(light) => light.falls_off(),
            Source::Directional(_) | Source::Sun(..) => far,
        });
        let sends: Vec<bool> = sends.collect();
        let (mut pieces, mut powers) = (Vec::new(), Vec::new());
        for (light, _) in sends.iter().enumerate().filter(|(_, sends)| **sends) {
            for (piece, reach) in self.lights[light].reaches().iter().enumerate() {
                pieces.push(Piece { light, piece });
                powers.push(f64::from(match reach {
                    Reach::Near(near) => near.intensity * aim.solid_angle(near.bounds.centre()),
                    Reach::Far(irradiance) => irradiance * aim.area(),
                }));
            }
        }
        let total: f64 = powers.iter().sum();
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        let even = EVEN / powers.len() as f64;
        let sums =
            sums::running(powers.into_iter().map(|power| even + (1.0 - EVEN) * power / total)).collect();
        Some(Emission { pieces, sums, sends, far })
    }

    /// A photon by random numbers; `None` where a lamp sends nothing, or something stands before a light that is infinitely far.
    pub(crate) fn emit(
        &self,
        emission: &Emission,
        aim: &Aim,
        world: &World<'_>,
        time: f32,
        draws: &mut Sampler,
    ) -> Option<Emitted> {
        let choices = draws.next_2d();
        let (chosen, _) = sums::pick(&emission.sums, choices.x);
        let probability = sums::share(&emission.sums, chosen) as f32;
        let Piece { light, piece } = emission.pieces[chosen];
        let Emitted { ray, flux } = match &self.lights[light].source {
            Source::Point(light) => {
                let (dir, pdf) = aim.direction(light.position(), choices.y, draws.next_2d());
                Emitted { ray: Ray::new(light.position(), dir), flux: light.intensity(dir) / pdf }
            }
            Source::Area(light) => from_area(light, piece, aim, choices.y, time, draws)?,
            Source::Directional(_) | Source::Sun(..) => {
                // Whatever the place, what comes from infinitely far is the same.
                let sample = self.lights[light].sample(Vec3::ZERO, piece, draws.next_2d(), time)?;
                let (place, pdf) = aim.place(sample.to_light, choices.y, draws.next_2d());
                let origin = place + aim.way_out(world.bounds(), place) * sample.to_light;
                // Beyond all that ends somewhere only what has no end can stand in the way.
                if world.closest_hit(&Ray::new(origin, sample.to_light), time).is_some() {
                    return None;
                }
                Emitted { ray: Ray::new(origin, -sample.to_light), flux: sample.arriving / pdf }
            }
        };
        (flux != Rgb::ZERO).then(|| Emitted { ray, flux: flux / probability })
    }
}

/// A photon from a piece of a surface that shines.
fn from_area(
    light: &AreaLight<'_>,
    piece: usize,
    aim: &Aim,
    choice: f32,
    time: f32,
    draws: &mut Sampler,
) -> Option<Emitted> {
    let (point, slot, radiance) = light.point(piece, draws.next_2d(), time)?;
    let (dir, pdf) = aim.direction(point.at.p, choice, draws.next_2d());
    let cos = dir.dot(point.at.ng);
    let flux = cos.abs() / (point.pdf * pdf) * radiance;
    let leaves = light.shines(slot, cos) && flux.is_finite();
    leaves.then(|| Emitted { ray: point.at.spawn(dir), flux })
}
