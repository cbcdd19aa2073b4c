//! All lights of a scene as one, for paths: a light is chosen, and asked for a sample.

use super::choice::{LightSampler, Piece, Reach};
use super::sky::Sky;
use super::{LightSample, LightTable, Owners, PreparedLight, Source};
use crate::world::{Owner, SurfaceHit};
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;
use heliostat_scene::settings::LightChoice;

/// From where light is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lookout {
    /// A point of a surface, or in a medium.
    pub(crate) p: Vec3,
    /// The normal there, on the viewer's side; 0 in a medium.
    pub(crate) n: Vec3,
    /// Over the shutter.
    pub(crate) time: f32,
    /// Whether light from behind the surface matters too.
    pub(crate) is_open: bool,
}

impl Lookout {
    /// A point of a medium.
    pub(crate) fn in_medium(p: Vec3, time: f32) -> Self {
        Self { p, n: Vec3::ZERO, time, is_open: true }
    }
}

impl LightTable<'_> {
    /// Light for a point, by the random numbers `choice` and `u`, with everything that the choice of the light does to weight
    /// and density. `None` where nothing comes this way.
    #[inline]
    pub(crate) fn draw(&self, from: &Lookout, choice: f32, u: Vec2) -> Option<LightSample> {
        Some(self.draw_one(from, choice, u)?.1)
    }

    /// [`Self::draw`] with the number of the light.
    #[inline]
    pub(crate) fn draw_one(&self, from: &Lookout, choice: f32, u: Vec2) -> Option<(usize, LightSample)> {
        let (Piece { light, piece }, probability) = self.sampler.pick(from, choice)?;
        let sample = match self.lights.get(light) {
            Some(source) => source.sample(from.p, piece, u, from.time)?,
            None => self.sky.sample(u)?,
        };
        let (arriving, pdf) = (sample.arriving / probability, sample.pdf * probability);
        Some((light, LightSample { arriving, pdf, ..sample }))
    }

    /// The density by solid angle with which [`Self::draw`] finds, from there, the light at a hit on a surface that shines;
    /// infinite where it is all that counts, 0 where it finds nothing.
    #[inline]
    pub(crate) fn density(&self, from: &Lookout, hit: &SurfaceHit) -> f32 {
        let Some(light) = self.owners.light_of(hit) else { return 0.0 };
        let Source::Area(area) = &self.lights[light].source else { return 0.0 };
        let Some(piece) = area.piece_of(hit) else { return 0.0 };
        let probability = self.sampler.probability(from, Piece { light, piece });
        if probability > 0.0 { probability * area.density(from.p, piece, hit, from.time) } else { 0.0 }
    }

    /// What lights a surface from infinitely far, in a unit direction, by the share that `weight` gives for the density of
    /// [`Self::draw`].
    #[inline]
    pub(crate) fn beyond(&self, from: &Lookout, dir: Vec3, weight: impl Fn(f32) -> f32) -> Rgb {
        let density = |light: usize, pdf: f32| {
            if pdf > 0.0 { pdf * self.sampler.probability(from, Piece { light, piece: 0 }) } else { 0.0 }
        };
        let mut sum = weight(density(self.lights.len(), self.sky.density(dir))) * self.sky.radiance(dir);
        for &sun in &self.suns {
            if let Some((radiance, pdf)) = self.lights[sun].seen_afar(dir) {
                sum += weight(density(sun, pdf)) * radiance;
            }
        }
        sum
    }

    /// What a mirror shows of infinitely far away.
    pub(crate) fn mirrored(&self, dir: Vec3) -> Rgb {
        let sun = |&sun: &usize| self.lights[sun].seen_afar(dir).map_or(Rgb::ZERO, |(radiance, _)| radiance);
        self.sky.seen(dir) + self.suns.iter().map(sun).sum::<Rgb>()
    }

    /// What a mirror shows of infinitely far away, without what has a shape there.
    pub(crate) fn mirrored_sky(&self, dir: Vec3) -> Rgb {
        self.sky.seen(dir)
    }

    /// The index of the light that a hit lies on, if it is one.
    pub(crate) fn light_of(&self, hit: &SurfaceHit) -> Option<usize> {
        self.owners.light_of(hit)
    }

    /// What the camera sees of infinitely far away: lights hide from it, the sun of the sky does not.
    pub(crate) fn seen(&self, dir: Vec3) -> Rgb {
        let disk = |&sun: &usize| match &self.lights[sun].source {
            Source::Sun(disk, _) => disk.seen(dir).map_or(Rgb::ZERO, |(radiance, _)| radiance),
            Source::Point(_) | Source::Area(_) | Source::Directional(_) => Rgb::ZERO,
        };
        self.sky.seen(dir) + self.suns.iter().map(disk).sum::<Rgb>()
    }
}

impl PreparedLight<'_> {
    /// Radiance and density of what covers a part of the sky; `None` beside it.
    #[inline]
    fn seen_afar(&self, dir: Vec3) -> Option<(Rgb, f32)> {
        match &self.source {
            Source::Directional(light) => light.seen(dir),
            Source::Sun(disk, _) => disk.seen(dir),
            Source::Point(_) | Source::Area(_) => None,
        }
    }
}

/// The choice among lights, the sky behind them where it is worth asking.
pub(super) fn sampler(lights: &[PreparedLight<'_>], sky: &Sky<'_>, choice: LightChoice) -> LightSampler {
    let sky = sky.is_sampled().then(|| vec![Reach::Far(sky.irradiance())]);
    let reaches: Vec<_> = lights.iter().map(PreparedLight::reaches).chain(sky).collect();
    LightSampler::new(&reaches, choice)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;
    use crate::world::World;
    use glam::{DAffine3, DQuat, DVec3};
    use heliostat_geometry::shape::{Cuboid, Disk, Rectangle, Sphere, Torus};
    use heliostat_geometry::warp::{SPHERE_PDF, square_to_sphere};
    use heliostat_geometry::{Ray, Shape, Transform};
    use heliostat_scene::light::{Falloff, LightKind};
    use heliostat_scene::object::Geometry;
    use heliostat_scene::settings::IntegratorKind;
    use heliostat_scene::{Light, RenderSettings, Scene};

    /// Lamps of all shapes, round and squeezed, around the origin.
    fn scene() -> Scene {
        let shapes = [
            Shape::Rectangle(Rectangle { size: Vec2::new(2.0, 1.0) }),
            Shape::Disk(Disk { radius: 0.7, inner_radius: 0.2 }),
            Shape::Disk(Disk { radius: 0.7, inner_radius: 0.0 }),
            Shape::Sphere(Sphere { radius: 0.8 }),
            Shape::Cuboid(Cuboid { size: Vec3::ONE }),
            Shape::Torus(Torus { major: 0.6, minor: 0.2 }),
        ];
        let light = |(i, shape): (usize, Shape), squeeze: DVec3, y: f64| Light {
            name: format!("{i} {y}"),
            intensity: Rgb::splat(1.0 + i as f32),
            samples: 1,
            kind: LightKind::Area {
                geometry: Geometry::Shape(shape),
                transform: Transform::new(DAffine3::from_scale_rotation_translation(
                    squeeze,
                    DQuat::from_rotation_x(0.4 * i as f64),
                    DVec3::new(3.0 * (1.1 * i as f64).cos(), y, 3.0 * (1.1 * i as f64).sin()),
                ))
                .unwrap(),
                two_sided: true,
                visible: true,
                falloff: Falloff::InverseSquare,
            },
        };
        let of = |squeeze, y| shapes.into_iter().enumerate().map(move |s| light(s, squeeze, y));
        let lights = of(DVec3::ONE, -1.0).chain(of(DVec3::new(1.0, 0.4, 1.5), 1.5)).collect();
        Scene { lights, ..Scene::default() }
    }

    fn looked(scene: &Scene, test: impl Fn(&World<'_>, &Lookout)) {
        let settings = RenderSettings { integrator: IntegratorKind::Path, ..RenderSettings::default() };
        let world = World::new(scene, &settings).unwrap();
        for p in [Vec3::ZERO, Vec3::new(2.4, -0.8, 0.5), Vec3::new(-3.0, 1.1, 5.0)] {
            test(&world, &Lookout { p, n: Vec3::Y, time: 0.0, is_open: true });
        }
    }

    #[test]
    fn a_ray_to_a_sample_is_told_the_density_of_the_sample() {
        let scene = scene();
        looked(&scene, |world, from| {
            let mut met = 0;
            for i in 0..4000 {
                let mut draws = Sampler::new(5, [0, 0], i);
                let Some(light) = world.light_table().draw(from, draws.next_1d(), draws.next_2d()) else {
                    continue;
                };
                let hit = world.closest_hit(&Ray::new(from.p, light.to_light), 0.0);
                let super::super::Target::Surface(at) = light.target else { panic!("{light:?}") };
                // Something else may stand before it, or the other side of the same lamp.
                let is_it = |hit: &SurfaceHit| {
                    (hit.hit.at.p - at.p).length() < 1e-3 && hit.hit.at.ng.dot(at.ng) > 0.999
                };
                // Where it is seen at a small angle, the rounding of the direction matters.
                let is_flat = |hit: &SurfaceHit| hit.hit.at.ng.dot(light.to_light).abs() < 0.1;
                let Some(hit) = hit.filter(|hit| is_it(hit) && !is_flat(hit)) else { continue };
                met += 1;
                let told = world.light_table().density(from, &hit);
                assert!((told / light.pdf - 1.0).abs() < 2e-2, "{told} for {light:?} on {hit:?}");
            }
            assert!(met > 1000, "{met}");
        });
    }

    #[test]
    fn densities_of_all_that_is_seen_add_up_to_one() {
        // One lamp at a time: what is hidden by another is drawn as well.
        for light in scene().lights {
            let scene = Scene { lights: vec![light], ..Scene::default() };
            looked(&scene, |world, from| {
                // From far away few of the directions meet a lamp.
                if from.p.z > 4.0 {
                    return;
                }
                let n = 400;
                let mut sum = 0.0;
                for i in 0..n * n {
                    let u = (Vec2::new((i % n) as f32, (i / n) as f32) + 0.5) / n as f32;
                    // Every surface on the ray may have been drawn.
                    let mut ray = Ray::new(from.p, square_to_sphere(u));
                    while let Some(hit) = world.closest_hit(&ray, 0.0) {
                        sum += f64::from(world.light_table().density(from, &hit) / SPHERE_PDF);
                        ray = hit.hit.spawn(ray.dir);
                    }
                }
                let sum = sum / f64::from(n * n);
                assert!((sum - 1.0).abs() < 0.1, "{sum} from {from:?} for {:?}", scene.lights);
            });
        }
    }
}
