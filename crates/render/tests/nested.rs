//! Clear bodies that overlap: the one with the highest priority is there, and indices of refraction are those of the two that
//! meet.

mod common;

use common::{Estimate, Stage, at, black, cuboid, grey, sphere};
use glam::Vec3;
use heliostat_geometry::Transform;
use heliostat_scene::Rgb;
use heliostat_scene::material::{FresnelMode, Phong};
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::IntegratorKind;

const KINDS: [IntegratorKind; 3] =
    [IntegratorKind::Path, IntegratorKind::PathSimple, IntegratorKind::VolPath];

fn clear(ior: f32) -> Phong {
    Phong { transparency: grey(1.0), ior, fresnel: FresnelMode::Dielectric, ..black() }
}

trait Nest {
    fn body(self, geometry: Geometry, ior: f32, priority: u32, place: Transform) -> Self;
}

impl Nest for Stage {
    fn body(mut self, geometry: Geometry, ior: f32, priority: u32, place: Transform) -> Self {
        self = self.with(geometry, clear(ior), place);
        self.last_material().priority = Some(priority);
        self
    }
}

/// The reflectance at normal incidence.
fn fresnel(a: f32, b: f32) -> f32 {
    ((a - b) / (a + b)).powi(2)
}

#[test]
fn boundaries_have_the_indices_of_the_bodies_that_meet() {
    // A black wall behind a slab of glass that overlaps one of water, seen at a right angle; the sky is mirrored by each boundary.
    for kind in KINDS {
        for overlap in [0.1, 0.3] {
            let mut stage = Stage::new()
                .body(cuboid(4.0, 4.0, 1.0), 1.5, 2, at(0.0, 0.0, 0.5))
                .body(cuboid(4.0, 4.0, 1.0 + overlap), 1.33, 1, at(0.0, 0.0, -0.5 + 0.5 * overlap))
                .with(cuboid(3.9, 3.9, 0.1), black(), at(0.0, 0.0, -0.9))
                .with_sky(1.0);
            stage.settings.integrator = kind;
            // What is reflected by both boundaries in turn and gets out again, an endless sum.
            let (a, b) = (fresnel(1.0, 1.5), fresnel(1.5, 1.33));
            let reflected = a + (1.0 - a) * (1.0 - a) * b / (1.0 - a * b);
            let from = Vec3::new(0.2, 0.1, 5.0);
            let seen = Estimate::new(&stage, from, from - Vec3::Z, 1024);

            seen.assert_is(Rgb::splat(reflected), &format!("{kind:?}, {overlap}"));
        }
    }
}

#[test]
fn a_body_inside_one_of_its_own_kind_is_not_seen() {
    for kind in KINDS {
        let mut stage = Stage::new()
            .body(sphere(1.0), 1.4, 1, Transform::IDENTITY)
            .body(sphere(0.5), 1.4, 2, at(0.2, 0.1, 0.0))
            .with_sky(0.5)
            .with_point_light(0.0, Vec3::Y);
        stage.settings.integrator = kind;
        let mut plain = Stage::new().body(sphere(1.0), 1.4, 1, Transform::IDENTITY).with_sky(0.5);
        plain.settings.integrator = kind;
        let (from, to) = (Vec3::new(0.3, 0.4, 4.0), Vec3::new(0.1, 0.2, 0.0));
        let (nested, plain) = (Estimate::new(&stage, from, to, 32), Estimate::new(&plain, from, to, 32));
        nested.assert_same(&plain, &format!("{kind:?}"));
    }
}

#[test]
fn a_camera_under_water_loses_no_light() {
    for kind in KINDS {
        let mut stage =
            Stage::new().body(cuboid(10.0, 10.0, 10.0), 1.33, 1, at(0.0, -5.0, 0.0)).with_sky(1.0);
        stage.settings.integrator = kind;
        let up = Estimate::new(&stage, Vec3::new(0.0, -1.0, 0.0), Vec3::new(0.0, 0.0, 0.0), 256);
        // Straight up: what is reflected goes down and out of the box, and finds the same sky.
        up.assert_is(Rgb::ONE, &format!("{kind:?}"));
    }
}
