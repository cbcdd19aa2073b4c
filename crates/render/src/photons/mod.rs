//! Caustics by photons: light that mirrors and clear glass throw onto what is matte.
//!
//! Sample `s` of every pixel sees photons of its own, `s`-th iteration, and each counts within a radius that shrinks from one
//! iteration to the next. No iteration knows of another, so that any can be made anywhere, at any time. The mean over
//! iterations tends to the truth: its bias goes with `s^(alpha - 1)`, its variance with `s^-alpha`.
//!
//! # What is counted
//! Ways lamp, (mirror or clear glass) once or more, matte layer. At a surface of several layers the matte share of the light is
//! that with which the surface draws directions from its matte layers; the path leaves out exactly what it finds after such a
//! draw over mirrors and clear glass at a lamp that sends photons. All else is left to paths: rough glass, glossy receivers,
//! the sky (but not its sun), and lights infinitely far away where what is smooth has no end.
//!
//! # Source
//! Knaus, Zwicker, "Progressive Photon Mapping: A Probabilistic Approach", ACM Transactions on Graphics 30(3), 2011; Jensen,
//! "Global Illumination using Photon Maps", EGWR 1996.

mod aim;
mod flight;
mod map;
mod smooth;

pub(crate) use aim::Aim;
pub(crate) use map::{Bounces, PhotonMap};

use crate::light::emission::Emission;
use crate::sampler::Sampler;
use crate::world::{SurfaceHit, World};
use flight::Flight;
use heliostat_scene::RenderSettings;
use heliostat_scene::settings::{Caustics, IntegratorKind};
use rayon::prelude::*;

/// How fast the radius shrinks, in (0, 1): the value for which the error of an estimate of density falls fastest, says Kaplanyan,
/// Dachsbacher, "Adaptive Progressive Photon Mapping", 2013; and that of the paper.
const ALPHA: f32 = 2.0 / 3.0;

/// The first radius over that of what is smooth.
const RADIUS_SHARE: f32 = 0.02;

/// Photons that are followed in a row by one thread.
const ROW: u32 = 1024;

/// Photons that are held at once, about.
const HELD: u32 = 1 << 21;

/// Most maps that are held at once.
const MOST_MAPS: u32 = 8;

/// What settings ask of photons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PhotonSettings {
    count: u32,
    radius: Option<f32>,
    seed: u64,
}

/// The photons of a few samples.
#[derive(Debug)]
pub(crate) struct Photons {
    first: u32,
    maps: Vec<PhotonMap>,
    emission: Emission,
}

impl PhotonSettings {
    /// `None` where none are asked for.
    pub(crate) fn of(settings: &RenderSettings) -> Option<Self> {
        let RenderSettings { caustic_photons: count, caustic_radius: radius, seed, .. } = *settings;
        let is_asked = settings.caustics == Caustics::Photons && settings.integrator == IntegratorKind::Path;
        is_asked.then_some(Self { count, radius, seed })
    }

    /// The samples whose photons fit into memory together.
    pub(crate) fn at_once(&self) -> u32 {
        (HELD / self.count).clamp(1, MOST_MAPS)
    }

    /// The photons of some samples; `None` where no lamp or nothing smooth is.
    pub(crate) fn photons(&self, world: &World<'_>, samples: std::ops::Range<u32>) -> Option<Photons> {
        let aim = Aim::new(world)?;
        let emission = world.light_table().emission(&aim)?;
        let radius = self.radius.or_else(|| natural_radius(&aim))?;
        let first = samples.start;
        let maps = samples.map(|sample| {
            let sent = self.send(world, &aim, &emission, sample);
            PhotonMap::new(&sent, radius * (sample as f32 + 1.0).powf(0.5 * (ALPHA - 1.0)))
        });
        Some(Photons { first, maps: maps.collect(), emission })
    }

    /// All photons of a sample, in their order.
    fn send(&self, world: &World<'_>, aim: &Aim, emission: &Emission, sample: u32) -> Vec<map::Photon> {
        let row = |row: u32| {
            let mut photons = Vec::new();
            for photon in row * ROW..self.count.min((row + 1) * ROW) {
                let mut draws = Sampler::of_photon(self.seed, sample, photon);
                let time = draws.next_1d();
                let emitted = world.light_table().emit(emission, aim, world, time, &mut draws);
                let Some(mut emitted) = emitted else { continue };
                emitted.flux /= self.count as f32;
                Flight::new(world, &emitted, time).run(&draws, &mut photons);
            }
            photons
        };
        let rows: Vec<_> = (0..self.count.div_ceil(ROW)).into_par_iter().map(row).collect();
        rows.concat()
    }
}

impl Photons {
    /// Those of a sample.
    #[inline]
    pub(crate) fn of(&self, sample: u32) -> Option<&PhotonMap> {
        self.maps.get(sample.checked_sub(self.first)? as usize)
    }

    /// Whether the light of a surface that shines has come as photons.
    #[inline]
    pub(crate) fn are_of(&self, world: &World<'_>, surface: &SurfaceHit) -> bool {
        world.light_table().light_of(surface).is_some_and(|light| self.emission.sends(light))
    }

    /// Whether light from infinitely far has, the sky aside.
    #[inline]
    pub(crate) fn are_from_afar(&self) -> bool {
        self.emission.sends_afar()
    }
}

/// The radius of the first iteration where settings do not say, if they ask for photons: a share of that of the largest thing that
/// is smooth. 1 cm where one has no end.
pub(crate) fn first_radius(world: &World<'_>, settings: &RenderSettings) -> Option<f32> {
    PhotonSettings::of(settings)?;
    natural_radius(&Aim::new(world)?)
}

fn natural_radius(aim: &Aim) -> Option<f32> {
    /// In metres.
    const ENDLESS: f32 = 0.01;
    Some(aim.radius().map_or(ENDLESS, |radius| RADIUS_SHARE * radius))
}
