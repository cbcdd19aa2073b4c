//! Media against the laws that they follow: what gets through, what is scattered once, and that no light is made or lost.

#![expect(clippy::unwrap_used, reason = "a stage that does not stand fails its test")]

mod common;

use common::{Estimate, Looker, Stage, at, black, cuboid, plane, sphere, white};
use glam::{DAffine3, DVec3, Vec3};
use heliostat_geometry::Transform;
use heliostat_render::render;
use heliostat_scene::camera::Projection;
use heliostat_scene::light::LightKind;
use heliostat_scene::medium::{Atmosphere, DensityGrid};
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::{DepthLimits, IntegratorKind};
use heliostat_scene::{Camera, Medium, MediumId, Motion, RenderSettings, Rgb};
use std::f32::consts::PI;

const FROM: Vec3 = Vec3::new(0.1, 0.2, 5.0);
const TO: Vec3 = Vec3::new(0.15, 0.1, 0.0);

fn stage() -> Stage {
    let mut stage = Stage::new();
    stage.settings.integrator = IntegratorKind::VolPath;
    stage
}

trait Fill {
    /// Adds a body without a surface that a medium fills.
    fn filled(self, geometry: Geometry, medium: Medium, place: Transform) -> Self;
}

impl Fill for Stage {
    fn filled(mut self, geometry: Geometry, mut medium: Medium, place: Transform) -> Self {
        let id = MediumId(self.scene.media.len() as u32);
        medium.name = format!("medium {}", id.0);
        self.scene.media.push(medium);
        self = self.with(geometry, black(), place).with_opacity(0.0);
        self.last_material().interior = Some(id);
        self
    }
}

fn even(absorption: Rgb, scattering: Rgb, g: f32) -> Medium {
    Medium::homogeneous("", absorption, scattering, g)
}

/// The same everywhere in a box of that size around the origin, but on a grid, with holes of other matter beyond it.
fn gridded(medium: Medium, size: f32) -> Medium {
    let cells = [13, 9, 20];
    let place = DAffine3::from_scale_rotation_translation(
        DVec3::splat(size.into()),
        glam::DQuat::IDENTITY,
        DVec3::splat(-0.5 * f64::from(size)),
    );
    let values = vec![1.0; cells.iter().product::<u32>() as usize].into();
    let density = DensityGrid { size: cells, values, place: Transform::new(place).unwrap() };
    Medium { density: Some(density), ..medium }
}

/// A grid whose density grows along z from 0 to 2 in a box of size 2, bumpy across.
fn ramp(medium: Medium) -> Medium {
    let mut medium = gridded(medium, 2.0);
    let grid = medium.density.as_mut().unwrap();
    grid.size = [4, 4, 32];
    grid.values = (0..4 * 4 * 32).map(|i| (i / 16) as f32 / 16.0 + 1.0 / 32.0).collect();
    medium
}

#[test]
fn what_only_absorbs_follows_the_law_of_beer() {
    let sigma = Rgb::new(0.2, 0.7, 2.0);
    let medium = || even(sigma, Rgb::ZERO, 0.0);
    let dir = (TO - FROM).normalize();
    let through = 2.0 / -dir.z;
    let expected = 3.0 * (-through * sigma).exp();
    let slab = || cuboid(2.0, 2.0, 2.0);
    let plain = stage().filled(slab(), medium(), Transform::IDENTITY).with_sky(3.0);
    let seen = plain.look(FROM, TO).radiance;
    assert!((seen - expected).abs().max_element() < 1e-5, "{seen} for {expected}");
    let grid = stage().filled(slab(), gridded(medium(), 2.0), Transform::IDENTITY).with_sky(3.0);
    Estimate::new(&grid, FROM, TO, 64).assert_is(expected, "grid");
    // The mean density of the ramp is 1.
    let straight = Vec3::new(0.1, 0.2, -5.0);
    let grid = stage().filled(slab(), ramp(medium()), Transform::IDENTITY).with_sky(3.0);
    Estimate::new(&grid, FROM, straight, 512).assert_is(3.0 * (-2.0 * sigma).exp(), "ramp");
}

#[test]
fn coverage_is_what_a_medium_takes() {
    let sigma = Rgb::new(0.3, 0.6, 0.9);
    let through = 2.0 / -(TO - FROM).normalize().z;
    let expected = 1.0 - (-through * sigma).exp().element_sum() / 3.0;
    for medium in [even(0.5 * sigma, 0.5 * sigma, 0.3), gridded(even(Rgb::ZERO, sigma, 0.0), 2.0)] {
        let mut stage = stage().filled(cuboid(2.0, 2.0, 2.0), medium, Transform::IDENTITY).with_sky(3.0);
        stage.settings.transparent_background = true;
        let looker = Looker::new(&stage);
        let n = 1 << 14;
        let dir = (TO - FROM).normalize();
        let mean = (0..n).map(|i| looker.look(FROM, dir, i).alpha).sum::<f32>() / n as f32;
        assert!((mean - expected).abs() < 0.01, "{mean} for {expected}");
    }
}

#[test]
fn media_that_scatter_all_are_not_seen_in_even_light() {
    let colored = Rgb::new(0.5, 2.0, 8.0);
    for g in [-0.6, 0.0, 0.9] {
        let medium = || even(Rgb::ZERO, colored, g);
        let cases = [
            ("even", stage().filled(sphere(1.0), medium(), Transform::IDENTITY)),
            ("grid", stage().filled(cuboid(2.0, 2.0, 2.0), gridded(medium(), 2.0), Transform::IDENTITY)),
            ("ramp", stage().filled(cuboid(2.0, 2.0, 2.0), ramp(medium()), Transform::IDENTITY)),
        ];
        for (name, stage) in cases {
            let stage = stage.with_sky(1.0);
            let seen = Estimate::new(&stage, FROM, TO, 64);
            seen.assert_is(Rgb::ONE, &format!("{name} {g}"));
            // No noisier than a choice of one colour of three: the sum of all is always the same.
            let most = (2.0 / (32.0 * 64.0_f32)).sqrt();
            assert!(seen.deviation.max_element() < 1.2 * most, "{name} {g}: {seen:?}");
        }
    }
}

#[test]
fn a_grid_of_one_density_is_the_same_everywhere() {
    let medium = || even(Rgb::new(0.1, 0.2, 0.05), Rgb::new(0.4, 1.0, 2.5), 0.4);
    let lit = |medium| {
        let lamp = LightKind::Area {
            geometry: sphere(0.5),
            transform: at(1.0, 2.0, 1.5),
            two_sided: false,
            visible: true,
            falloff: heliostat_scene::light::Falloff::InverseSquare,
        };
        stage()
            .filled(cuboid(2.0, 2.0, 2.0), medium, Transform::IDENTITY)
            .with(plane(), white(), at(0.0, -1.2, 0.0))
            .with_light(3.0, 1, lamp)
            .with_point_light(2.0, Vec3::new(-0.3, 0.2, 0.4))
            .with_sky(0.3)
    };
    let (plain, grid) = (lit(medium()), lit(gridded(medium(), 2.0)));
    for to in [TO, Vec3::new(0.8, -0.5, 0.0), Vec3::new(0.5, -1.2, 1.0)] {
        let expected = Estimate::new(&plain, FROM, to, 256);
        Estimate::new(&grid, FROM, to, 256).assert_same(&expected, &format!("to {to}"));
    }
}

#[test]
fn light_scattered_once_is_the_integral() {
    let (absorption, scattering, g) = (Rgb::new(0.05, 0.0, 0.3), Rgb::new(0.1, 0.5, 1.5), 0.5_f32);
    let lamp = Vec3::new(0.4, 0.5, -0.2);
    for is_grid in [false, true] {
        let medium = even(absorption, scattering, g);
        let medium = if is_grid { gridded(medium, 2.0) } else { medium };
        let mut stage =
            stage().filled(cuboid(2.0, 2.0, 2.0), medium, Transform::IDENTITY).with_point_light(5.0, lamp);
        stage.settings.depth_limits = DepthLimits { volume: 0, ..DepthLimits::default() };
        // Straight through the box, from z = 1 to z = -1.
        let (dir, sigma, n) = (Vec3::NEG_Z, absorption + scattering, 20_000);
        let mut expected = Rgb::ZERO;
        for i in 0..n {
            let t = 2.0 * (i as f32 + 0.5) / n as f32;
            let p = Vec3::new(FROM.x, FROM.y, 1.0) + t * dir;
            let way = lamp - p;
            let (r, cos) = (way.length(), way.normalize().dot(dir));
            let phase = (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cos).powf(1.5));
            expected += 2.0 / n as f32 * scattering * (-(t + r) * sigma).exp() * phase * 5.0 / (r * r);
        }
        let seen = Estimate::new(&stage, FROM, FROM - Vec3::Z, 1024);
        seen.assert_is(expected, &format!("grid {is_grid}"));
    }
}

#[test]
fn a_camera_in_a_medium_knows_it() {
    let sigma = Rgb::new(0.2, 0.7, 2.0);
    let fog = || even(sigma, Rgb::ZERO, 0.0);
    let inside = stage().filled(sphere(2.0), fog(), Transform::IDENTITY).with_sky(1.0);
    let seen = inside.look(Vec3::ZERO, Vec3::X).radiance;
    assert!((seen - (-2.0 * sigma).exp()).abs().max_element() < 1e-5, "{seen}");
    // A second body around the camera, inside of the first, takes its place.
    let both = inside.filled(sphere(1.0), even(Rgb::ZERO, Rgb::ZERO, 0.0), Transform::IDENTITY);
    let seen = both.look(Vec3::ZERO, Vec3::X).radiance;
    assert!((seen - (-sigma).exp()).abs().max_element() < 1e-5, "{seen}");
}

#[test]
fn an_atmosphere_fills_the_ball_around_everything() {
    let sigma = Rgb::new(0.01, 0.02, 0.1);
    let mut stage = stage().with(sphere(0.1), white(), at(0.0, -1.0, 0.0)).with_sky(1.0);
    stage.scene.media.push(even(sigma, Rgb::ZERO, 0.0));
    stage.scene.atmosphere = Some(Atmosphere { medium: MediumId(0), radius: Some(20.0) });
    let centre = Vec3::new(0.0, -1.0, 0.0);
    let seen = stage.look(centre + 5.0 * Vec3::X, centre + 9.0 * Vec3::X).radiance;
    assert!((seen - (-15.0 * sigma).exp()).abs().max_element() < 1e-4, "{seen}");
    let from_outside = stage.look(centre + Vec3::new(30.0, 3.0, 0.0), centre + Vec3::new(0.0, 3.0, 0.0));
    let way = 2.0 * (400.0_f32 - 9.0).sqrt();
    assert!((from_outside.radiance - (-way * sigma).exp()).abs().max_element() < 1e-4, "{from_outside:?}");
}

#[test]
fn shadow_rays_pass_boundaries_and_media_between() {
    // A floor under a slab that only absorbs, lit from above; the lamp cannot be seen otherwise.
    let sigma = Rgb::new(0.5, 1.0, 2.0);
    for is_grid in [false, true] {
        let medium = even(sigma, Rgb::ZERO, 0.0);
        let medium = if is_grid { gridded(medium, 2.0) } else { medium };
        let slab = stage()
            .with(plane(), white(), at(0.0, -2.0, 0.0))
            .filled(cuboid(2.0, 1.0, 2.0), medium, Transform::IDENTITY)
            .with_light(1.0, 1, LightKind::Directional { direction: Vec3::NEG_Y, angle: 0.0 });
        let floor = Vec3::new(0.0, -2.0, 0.0);
        let expected = (-sigma).exp() / PI;
        let seen = Estimate::new(&slab, Vec3::new(3.0, -1.5, 0.0), floor, 256);
        seen.assert_is(expected, &format!("grid {is_grid}"));
    }
}

#[test]
fn paths_by_chance_and_by_question_find_the_same_in_media() {
    // A lamp inside a medium that is found by both: without the question the mean is the same.
    let medium = || even(Rgb::splat(0.1), Rgb::new(0.3, 1.0, 3.0), 0.2);
    let lamp = |visible| LightKind::Area {
        geometry: sphere(0.6),
        transform: at(0.8, 0.4, 0.0),
        two_sided: false,
        visible,
        falloff: heliostat_scene::light::Falloff::InverseSquare,
    };
    let lit = |medium, visible| {
        stage().filled(cuboid(2.0, 2.0, 2.0), medium, Transform::IDENTITY).with_light(2.0, 1, lamp(visible))
    };
    // A lamp that is not seen is found by questions alone; the ray looks past it.
    let past = Vec3::new(-0.7, -0.3, 0.0);
    for grid in [false, true] {
        let filled = || if grid { gridded(medium(), 2.0) } else { medium() };
        let (both, asked) = (lit(filled(), true), lit(filled(), false));
        let mut limited = [both, asked];
        // Only light that was scattered once: beyond that the lamp stands in the way or not.
        for stage in &mut limited {
            stage.settings.depth_limits = DepthLimits { volume: 0, ..DepthLimits::default() };
        }
        let [both, asked] = limited.map(|stage| Estimate::new(&stage, FROM, past, 2048));
        both.assert_same(&asked, &format!("grid {grid}"));
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let medium = even(Rgb::splat(0.1), Rgb::new(0.3, 1.0, 3.0), 0.2);
    let mut stage = stage()
        .filled(cuboid(2.0, 2.0, 2.0), ramp(medium), Transform::IDENTITY)
        .with(plane(), white(), at(0.0, -1.2, 0.0))
        .with_point_light(9.0, Vec3::new(0.5, 3.0, 1.0))
        .with_sky(0.3);
    stage.scene.cameras.push(Camera {
        name: "front".into(),
        motion: Motion::still(DAffine3::from_translation(DVec3::new(0.0, 0.0, 5.0))),
        projection: Projection::Perspective { fov_y: 0.7 },
        focus: None,
    });
    let frame = |threads| {
        let settings =
            RenderSettings { width: 40, height: 32, samples: 4, threads, ..stage.settings.clone() };
        render(&stage.scene, &settings).unwrap().channels
    };
    let (one, three) = (frame(1), frame(3));
    for (a, b) in one.iter().zip(&three) {
        assert!(a.values.iter().zip(&b.values).all(|(a, b)| a.to_bits() == b.to_bits()), "{}", a.name);
    }
}
