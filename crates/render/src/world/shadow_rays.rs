//! The shadow rays of one point to many points of a light, asked together.

use super::World;
use super::blocker::Chords;
use super::filter::Filter;
use super::level::Candidates;
use crate::lanes::{Mask, Vec3Lanes, lanes_of};
use crate::world::blocker::Blocker;
use glam::Vec3;
use heliostat_geometry::{Departure, Ray};
use heliostat_scene::Rgb;

/// Rays from one place to many.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadowRays<'a> {
    /// Where they start.
    pub(crate) start: Departure,
    /// Where they end, at `t = 1`.
    pub(crate) targets: &'a Vec3Lanes,
    /// They are at most so long, per axis.
    pub(crate) reach: Vec3,
    /// Lanes that are asked for; the others hold any point of the light.
    pub(crate) wanted: Mask,
}

impl ShadowRays<'_> {
    /// The ray of a lane.
    pub(super) fn ray(&self, lane: usize) -> Ray {
        self.start.spawn_to(self.targets.get(lane))
    }
}

impl World<'_> {
    /// [`World::transmittance_past`] for each ray; zero for rays that are not wanted.
    pub(crate) fn transmittances(
        &self,
        rays: &ShadowRays<'_>,
        time: f32,
        candidates: Candidates,
    ) -> Vec3Lanes {
        let mut shares = Vec3Lanes::splat(Rgb::ZERO);
        let few = |kind: Candidates| self.level.few(candidates.among(kind));
        let (Some(stoppers), Some(filters)) = (few(self.stoppers), few(self.filters)) else {
            for lane in lanes_of(rays.wanted) {
                shares.set(lane, self.transmittance_past(&rays.ray(lane), time, candidates));
            }
            return shares;
        };
        let mut open = rays.wanted;
        stoppers.for_each(|i| open &= !self.stopped(i, rays, open, time));
        lanes_of(open).for_each(|lane| shares.set(lane, Rgb::ONE));
        filters.for_each(|i| self.filter(i, rays, open, time, &mut shares));
        shares
    }

    /// The rays among `open` that a thing stops, and perhaps others.
    fn stopped(&self, thing: u32, rays: &ShadowRays<'_>, open: Mask, time: f32) -> Mask {
        if open == 0 {
            return 0;
        }
        let solid = &self.solids[thing as usize];
        let verdict = solid.verdict(rays);
        let in_doubt = lanes_of(verdict.doubt & open);
        in_doubt
            .filter(|&lane| solid.blocks(&rays.ray(lane), time))
            .fold(verdict.hit, |hit, lane| hit | 1 << lane)
    }

    /// Multiplies the shares of the rays `open` by what a thing lets through.
    fn filter(&self, thing: u32, rays: &ShadowRays<'_>, open: Mask, time: f32, shares: &mut Vec3Lanes) {
        if open == 0 {
            return;
        }
        let object = &self.scene.objects[thing as usize];
        let chords = match self.solids[thing as usize].blocker {
            Some(Blocker::Sphere(sphere)) => {
                let filter = Filter { scene: self.scene, object, clear: self.clear };
                filter.plain().and_then(|pane| Some((pane, Chords::new(&sphere, rays)?)))
            }
            _ => None,
        };
        let mut in_doubt = open;
        if let Some((pane, chords)) = chords {
            pane.filter_chords(&chords, open, shares);
            in_doubt &= chords.verdict.doubt;
        }
        for lane in lanes_of(in_doubt) {
            shares.set(lane, shares.get(lane) * self.share_past(thing, &rays.ray(lane), time));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{LANES, holds};
    use heliostat_geometry::shape::{Cuboid, Disk, Shape, Sphere};
    use heliostat_geometry::{SurfacePoint, Transform};
    use heliostat_scene::material::{ColorInput, FloatInput, FresnelMode, Phong};
    use heliostat_scene::object::Geometry;
    use heliostat_scene::{Material, MaterialId, Motion, Object, RenderSettings, Scene};
    use proptest::prelude::*;

    /// A wall, a glass ball that absorbs, one that does not, and a cut-out disk.
    fn scene() -> Scene {
        let glass = |absorption, fresnel| Phong {
            transparency: ColorInput::constant(Rgb::new(0.9, 0.8, 0.7)),
            absorption,
            fresnel,
            ..Phong::default()
        };
        let cut_out =
            Material { opacity: FloatInput::constant(0.25), ..Material::new("net", Phong::default()) };
        let object = |shape, material, to: Vec3| Object {
            name: format!("object at {to}"),
            geometry: Geometry::Shape(shape),
            materials: vec![MaterialId(material)],
            motion: Motion::still(Transform::translation(to)),
            visible: true,
            casts_shadow: true,
        };
        Scene {
            materials: vec![
                Material::new("wall", Phong::default()),
                Material::new("green", glass(Rgb::new(0.5, 0.1, 0.4), FresnelMode::Dielectric)),
                Material::new("clear", glass(Rgb::ZERO, FresnelMode::Off)),
                cut_out,
            ],
            objects: vec![
                object(Shape::Cuboid(Cuboid { size: Vec3::new(1.0, 1.0, 0.1) }), 0, Vec3::new(1.0, 0.0, 2.0)),
                object(Shape::Sphere(Sphere { radius: 1.0 }), 1, Vec3::ZERO),
                object(Shape::Sphere(Sphere { radius: 0.5 }), 2, Vec3::new(-1.2, 0.3, 0.0)),
                object(Shape::Disk(Disk { radius: 2.0, inner_radius: 0.0 }), 3, Vec3::new(0.0, -1.5, 0.0)),
            ],
            ..Scene::default()
        }
    }

    #[test]
    fn light_is_absorbed_on_its_way_out_of_glass() {
        let scene = scene();
        let settings = RenderSettings { transparent_shadows: true, ..RenderSettings::default() };
        let world = World::new(&scene, &settings).unwrap();
        // Half of the radius of the green ball is left; at a right angle a 25th is reflected.
        let ray = Ray::new(Vec3::new(0.0, 0.5, 0.0), 4.0 * Vec3::Y).until(1.0);
        let found = world.transmittance(&ray, 0.0);
        let expected = 0.96 * Rgb::new(0.9, 0.8, 0.7) * (-0.5 * Rgb::new(0.5, 0.1, 0.4)).exp();
        assert!((found - expected).abs().max_element() < 1e-6, "{found} for {expected}");
    }

    fn point() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-3.0_f32..3.0).prop_map(Vec3::from_array)
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn rays_together_are_as_rays_alone(
            start in point(),
            targets in prop::collection::vec(point(), LANES),
            wanted in any::<Mask>(),
        ) {
            let scene = scene();
            let settings = RenderSettings { transparent_shadows: true, ..RenderSettings::default() };
            let world = World::new(&scene, &settings).unwrap();
            let start = SurfacePoint { p: start, p_err: Vec3::ZERO, ng: Vec3::Y }.departure();
            let mut lanes = Vec3Lanes::splat(Vec3::ZERO);
            (0..).zip(targets).for_each(|(lane, target)| lanes.set(lane, target));
            let rays = ShadowRays { start, targets: &lanes, reach: Vec3::splat(6.1), wanted };
            let shares = world.transmittances(&rays, 0.0, world.casters);
            for lane in 0..LANES {
                let alone = world.transmittance(&rays.ray(lane), 0.0);
                let expected = if holds(wanted, lane) { alone } else { Rgb::ZERO };
                let found = shares.get(lane);
                prop_assert!((found - expected).abs().max_element() < 2e-4, "{lane}: {found} for {expected}");
            }
        }
    }
}
