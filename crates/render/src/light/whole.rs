//! All lights of a scene as one, for paths: a light is chosen, and asked for a sample.

use super::choice::LightSampler;
use super::sky::Sky;
use super::{LightSample, LightTable, Owners, PreparedLight, Source};
use crate::world::{Owner, SurfaceHit};
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;

/// From where light is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lookout {
    /// A point of a surface.
    pub(crate) p: Vec3,
    /// The normal there, on the viewer's side.
    pub(crate) n: Vec3,
    /// Over the shutter.
    pub(crate) time: f32,
}

impl LightTable<'_> {
    /// Light for a point, by the random numbers `choice` and `u`, with everything that the choice of the light does to weight
    /// and density. `None` where nothing comes this way.
    #[inline]
    pub(crate) fn draw(&self, from: &Lookout, choice: f32, u: Vec2) -> Option<LightSample> {
        let (light, probability, _) = self.sampler.pick(from.p, from.n, choice)?;
        let sample = match self.lights.get(light) {
            Some(light) => light.sample(from.p, u, from.time)?,
            None => self.sky.sample(u)?,
        };
        Some(LightSample { arriving: sample.arriving / probability, pdf: sample.pdf * probability, ..sample })
    }

    /// The density by solid angle with which [`Self::draw`] finds, from there, the light at a hit on a surface that shines;
    /// infinite where it is all that counts, 0 where it finds nothing.
    #[inline]
    pub(crate) fn density(&self, from: &Lookout, hit: &SurfaceHit) -> f32 {
        let Some(light) = self.owners.light_of(hit) else { return 0.0 };
        let Source::Area(area) = &self.lights[light].source else { return 0.0 };
        self.sampler.probability(from.p, from.n, light) * area.density(from.p, hit, from.time)
    }

    /// What lights a surface from infinitely far, in a unit direction, by the share that `weight` gives for the density of
    /// [`Self::draw`].
    #[inline]
    pub(crate) fn beyond(&self, from: &Lookout, dir: Vec3, weight: impl Fn(f32) -> f32) -> Rgb {
        let density = |light: usize, pdf: f32| {
            if pdf > 0.0 { pdf * self.sampler.probability(from.p, from.n, light) } else { 0.0 }
        };
        let mut sum = weight(density(self.lights.len(), self.sky.density(dir))) * self.sky.radiance(dir);
        for &sun in &self.suns {
            if let Source::Directional(light) = &self.lights[sun].source
                && let Some((radiance, pdf)) = light.seen(dir)
            {
                sum += weight(density(sun, pdf)) * radiance;
            }
        }
        sum
    }

    /// What a mirror shows of infinitely far away.
    pub(crate) fn mirrored(&self, dir: Vec3) -> Rgb {
        let sun = |&sun: &usize| match &self.lights[sun].source {
            Source::Directional(light) => light.seen(dir).map_or(Rgb::ZERO, |(radiance, _)| radiance),
            Source::Point(_) | Source::Area(_) => Rgb::ZERO,
        };
        self.sky.seen(dir) + self.suns.iter().map(sun).sum::<Rgb>()
    }
}

/// The choice among lights, the sky behind them where it is worth asking.
pub(super) fn sampler(lights: &[PreparedLight<'_>], sky: &Sky<'_>, scene_radius: f32) -> LightSampler {
    let powers = lights.iter().map(|light| light.power(scene_radius));
    let sky = sky.is_sampled().then(|| sky.power(scene_radius));
    LightSampler::new(&powers.chain(sky).collect::<Vec<_>>())
}

impl Owners {
    /// The index of the light behind a hit.
    #[inline]
    fn light_of(&self, hit: &SurfaceHit) -> Option<usize> {
        match hit.owner {
            Owner::Light(light) => self.declared[light as usize],
            Owner::Object { index, .. } => {
                let key = (index, hit.part);
                let found = self.shining.binary_search_by_key(&key, |&(owner, _)| owner).ok()?;
                Some(self.shining[found].1)
            }
        }
    }
}
