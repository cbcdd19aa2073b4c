//! Shared by the tests: integrators that are formulas, cameras and settings.
#![allow(dead_code, reason = "each test file uses its part")]

use glam::{DAffine3, DQuat, DVec3, Vec3};
use heliostat_render::{
    CameraRay, Control, Film, FirstHit, Integrator, PassOutcome, Prepared, RayCounters, Sample, Sampler,
    World,
};
use heliostat_scene::camera::Projection;
use heliostat_scene::settings::PixelRect;
use heliostat_scene::{Camera, Frame, MaterialId, Motion, RenderSettings, Rgb, Scene};
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// An integrator that is a formula of the camera ray: what it should be is known without tracing.
pub(crate) struct Formula<F>(pub(crate) F);

impl<F: Fn(&CameraRay, &mut Sampler) -> Sample + Sync> Integrator for Formula<F> {
    fn radiance(
        &self,
        _: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        counters.shadow += 1;
        (self.0)(ray, sampler)
    }
}

/// A sample without a surface.
pub(crate) fn light(radiance: Rgb) -> Sample {
    Sample { radiance, alpha: 1.0, first: None }
}

/// A ground of checks at y = 0 under a sky that is empty, noisy enough to catch every exchange of random numbers.
pub(crate) fn ground(ray: &CameraRay, sampler: &mut Sampler) -> Sample {
    let t = -ray.ray.origin.y / ray.ray.dir.y;
    let noise = sampler.next_1d() + sampler.array_2d(3).map(|p| p.x * p.y).sum::<f32>() + ray.time;
    if !(t > 0.0 && t < 1e4) {
        return Sample { radiance: 0.1 * noise * Vec3::ONE, alpha: 0.0, first: None };
    }
    let p = ray.ray.at(t);
    let check = (p.x.floor() + p.z.floor()).rem_euclid(2.0);
    let color = Vec3::new(0.2 + 0.6 * check, 0.5, 0.9 - 0.5 * check);
    Sample {
        radiance: color * (0.5 + noise),
        alpha: 1.0,
        first: Some(FirstHit {
            p,
            normal: Vec3::Y,
            albedo: color,
            uv: p.truncate(),
            object: Some(check as u32),
            material: Some(MaterialId(3 + check as u32)),
        }),
    }
}

/// From camera to world space, turned and off the origin.
pub(crate) fn pose() -> DAffine3 {
    let turn = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(-0.4) * DQuat::from_rotation_z(0.1);
    DAffine3::from_rotation_translation(turn, DVec3::new(12.0, 3.0, -40.0))
}

pub(crate) fn camera(projection: Projection) -> Camera {
    Camera { name: "main".into(), motion: Motion::still(pose()), projection, focus: None }
}

pub(crate) fn perspective() -> Camera {
    camera(Projection::Perspective { fov_y: 1.2 })
}

/// A scene of nothing but a camera.
pub(crate) fn scene(camera: Camera) -> Scene {
    Scene { cameras: vec![camera], ..Scene::default() }
}

pub(crate) fn small() -> RenderSettings {
    RenderSettings { width: 53, height: 37, samples: 8, threads: 2, ..RenderSettings::default() }
}

pub(crate) fn prepare<'s>(
    scene: &'s Scene,
    settings: &RenderSettings,
    formula: impl Fn(&CameraRay, &mut Sampler) -> Sample + Sync + Send + 's,
) -> Prepared<'s> {
    Prepared::with_integrator(scene, settings, Box::new(Formula(formula))).expect("renderable")
}

/// A pass that nobody watches.
pub(crate) fn pass(prepared: &Prepared<'_>, film: &mut Film, samples: Range<u32>) -> PassOutcome {
    let control = Control { cancel: &AtomicBool::new(false), on_tile: &|_| () };
    prepared.pass(film, samples, &control)
}

/// All samples in one pass.
pub(crate) fn frame(
    scene: &Scene,
    settings: &RenderSettings,
    formula: impl Fn(&CameraRay, &mut Sampler) -> Sample + Sync + Send,
) -> Frame {
    let prepared = prepare(scene, settings, formula);
    let mut film = prepared.film();
    assert!(pass(&prepared, &mut film, 0..settings.samples).finished);
    prepared.frame(&film)
}

/// The value of a channel at a pixel of the whole picture.
pub(crate) fn value(frame: &Frame, name: &str, x: u32, y: u32) -> f32 {
    let window = frame.window;
    let i = (y - window.y0) as usize * window.width() as usize + (x - window.x0) as usize;
    frame.channel(name).unwrap_or_else(|| panic!("no channel {name}")).values[i]
}

/// Asserts that two frames have the same bits in every channel, without printing them.
pub(crate) fn assert_same_channels(found: &Frame, want: &Frame, what: &str) {
    assert_eq!(found.window, want.window, "{what}");
    assert_eq!(found.channels.len(), want.channels.len(), "{what}");
    for (found, want) in found.channels.iter().zip(&want.channels) {
        assert_eq!((&found.name, found.depth), (&want.name, want.depth), "{what}");
        for (i, (a, b)) in found.values.iter().zip(&want.values).enumerate() {
            assert_eq!(a.to_bits(), b.to_bits(), "{what}: {} of pixel {i} is {a}, not {b}", found.name);
        }
    }
}

/// The part of a frame in a window.
pub(crate) fn crop(frame: &Frame, window: PixelRect) -> Frame {
    let mut part = Frame { window, ..frame.clone() };
    for channel in &mut part.channels {
        channel.values = (window.y0..window.y1)
            .flat_map(|y| (window.x0..window.x1).map(move |x| (x, y)))
            .map(|(x, y)| value(frame, &channel.name, x, y))
            .collect();
    }
    part
}
