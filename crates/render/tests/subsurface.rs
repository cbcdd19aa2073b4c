//! Light below surfaces: nothing is lost where nothing absorbs, and a thick body has the colour that it was given.

mod common;

use common::{Estimate, Stage, cuboid, sphere};
use glam::Vec3;
use heliostat_geometry::Transform;
use heliostat_scene::material::{ColorInput, FloatInput, Standard, Surface};
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::IntegratorKind;
use heliostat_scene::{Material, Rgb};

const FROM: Vec3 = Vec3::new(0.3, 0.8, 6.0);

fn lit_in(geometry: Geometry, standard: Standard) -> Stage {
    let mut stage = Stage::new().with(geometry, common::black(), Transform::IDENTITY).with_sky(1.0);
    stage.settings.integrator = IntegratorKind::VolPath;
    let name = stage.last_material().name.clone();
    *stage.last_material() = Material::of(name, Surface::Standard(Box::new(standard)));
    stage
}

fn wax(color: Rgb, radius: Rgb) -> Standard {
    Standard {
        subsurface: FloatInput::constant(1.0),
        subsurface_color: ColorInput::constant(color),
        subsurface_radius: radius,
        ..Standard::default()
    }
}

#[test]
fn white_bodies_lose_nothing() {
    let radius = Rgb::new(0.5, 0.1, 0.02);
    for specular in [0.0, 1.0] {
        for (name, geometry) in [("ball", sphere(1.0)), ("box", cuboid(1.6, 1.2, 1.0))] {
            let gloss = FloatInput::constant(specular);
            let stage = lit_in(geometry, Standard { specular: gloss, ..wax(Rgb::ONE, radius) });
            let seen = Estimate::new(&stage, FROM, Vec3::new(0.2, 0.3, 0.0), 64);
            // Facets and the table of their losses: see the furnaces of the surfaces themselves.
            let error = (seen.mean - Rgb::ONE).abs() - 4.5 * seen.deviation;
            assert!(error.max_element() < 4e-3, "{name}, {specular}: {seen:?}");
        }
    }
}

#[test]
fn a_thick_body_has_the_colour_that_it_was_given() {
    let color = Rgb::new(0.2, 0.5, 0.9);
    for g in [0.0, 0.5] {
        let matte = Standard { specular: FloatInput::constant(0.0), ..wax(color, Rgb::splat(0.01)) };
        let stage = lit_in(cuboid(3.0, 3.0, 3.0), Standard { subsurface_anisotropy: g, ..matte });
        let seen = Estimate::new(&stage, FROM, Vec3::new(0.2, 0.3, 0.0), 128);
        // The inversion is a fit, of one of its own.
        let error = (seen.mean - color).abs() - 4.5 * seen.deviation;
        assert!(error.max_element() < 0.02, "g {g}: {seen:?}");
    }
}

#[test]
fn a_body_in_which_light_hardly_gets_anywhere_is_matte() {
    // Lit from one side: what comes out does so where it went in.
    let color = Rgb::new(0.3, 0.6, 0.8);
    let specular = FloatInput::constant(0.0);
    let thin = Standard { specular, ..wax(color, Rgb::splat(1e-4)) };
    let matte = Standard { specular, base_color: ColorInput::constant(color), ..Standard::default() };
    let lamp = Vec3::new(3.0, 3.0, 3.0);
    let lit = |standard| {
        let mut stage = lit_in(sphere(1.0), standard);
        stage = stage.with_sky(0.0).with_point_light(20.0, lamp);
        Estimate::new(&stage, FROM, Vec3::new(0.3, 0.4, 0.0), 128)
    };
    let (walked, expected) = (lit(thin), lit(matte));
    let error = (walked.mean / expected.mean - 1.0).abs() - 4.5 * walked.deviation / expected.mean;
    assert!(error.max_element() < 0.04, "{walked:?} for {expected:?}");
}

#[test]
fn other_integrators_show_it_as_matte() {
    let mut stage = lit_in(sphere(1.0), wax(Rgb::new(0.3, 0.6, 0.8), Rgb::splat(0.1)));
    stage.settings.integrator = IntegratorKind::Path;
    let seen = Estimate::new(&stage, FROM, Vec3::new(0.3, 0.4, 0.0), 64);
    let plain = Standard { base_color: ColorInput::constant(Rgb::new(0.3, 0.6, 0.8)), ..Standard::default() };
    let mut matte = lit_in(sphere(1.0), plain);
    matte.settings.integrator = IntegratorKind::Path;
    seen.assert_same(&Estimate::new(&matte, FROM, Vec3::new(0.3, 0.4, 0.0), 64), "matte");
}

#[test]
fn light_comes_out_elsewhere() {
    // A lamp behind a slab that is matte to the eye: only light that walks through gets to the camera.
    let mut wax = wax(Rgb::splat(0.9), Rgb::splat(0.2));
    wax.specular = FloatInput::constant(0.0);
    let stage = lit_in(cuboid(2.0, 2.0, 0.2), wax).with_sky(0.0);
    let stage = stage.with_point_light(10.0, Vec3::new(0.0, 0.0, -2.0));
    let walked = Estimate::new(&stage, FROM, Vec3::ZERO, 64);
    assert!(walked.mean.min_element() > 0.05, "{walked:?}");
    let mut matte = stage;
    matte.settings.integrator = IntegratorKind::Path;
    assert_eq!(matte.grey(FROM, Vec3::ZERO), 0.0);
}
