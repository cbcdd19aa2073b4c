//! Light for a model that brings none, and a little help for one that does.

use super::fit::View;
use super::parts::each_part;
use crate::obj::unique;
use glam::{DAffine3, DVec3, Quat, Vec2, Vec3};
use heliostat_geometry::shape::Rectangle;
use heliostat_geometry::{Aabb, Shape, Transform};
use heliostat_scene::color::luminance;
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::{Light, MaterialId, Rgb, Scene};
use std::f32::consts::PI;

/// The model lights itself when its emitters give its box this irradiance on the mean.
const ENOUGH: f32 = 0.05;

/// The irradiance by its own emitters that leaves a model's picture as it is.
const MIDDLING: f32 = 0.3;

/// Degrees across a light that gives shadows a soft edge.
const EDGED: f32 = 3.0;

/// Degrees across a light like the soft boxes of a studio: mirrors and glass show it as such, and what they throw on matte
/// surfaces is found by chance without bright specks.
const SOFT: f32 = 36.0;

/// Stops from the model's own light to a middling one; 0 where it does not light itself.
pub(super) fn exposure(scene: &Scene, bounds: Aabb) -> f32 {
    let own = luminance(own_irradiance(scene, bounds));
    if own >= ENOUGH { (MIDDLING / own).log2() } else { 0.0 }
}

/// Sets lights and background of a scene that holds a model in `bounds`. `is_inside` tells that the camera looks into a box.
pub(super) fn light(scene: &mut Scene, bounds: Aabb, view: &View, is_inside: bool) {
    let own = own_irradiance(scene, bounds);
    if luminance(own) >= ENOUGH {
        // What walls of a third reflectance throw at each other: r / (1 - r) of the first light, taken as even.
        // Cohen et al., "A Progressive Refinement Approach to Fast Radiosity Image Generation", 1988, section 4.
        scene.lights = vec![ambient(0.5 * own)];
        scene.background = if is_inside { Background::default() } else { backdrop(0.1, view) };
    } else if is_inside {
        scene.lights = vec![ambient(Rgb::splat(0.2)), ceiling(bounds)];
    } else {
        let from = |x: f64, y: f64, z: f64| (view.axes() * DVec3::new(x, y, z)).as_vec3();
        scene.lights = vec![
            ambient(Rgb::splat(0.12)),
            distant("key", 0.85, from(-0.8, 0.9, 0.6), EDGED),
            distant("fill", 0.15, from(1.0, 0.2, 0.5), EDGED),
        ];
        scene.background = backdrop(1.0, view);
    }
}

/// Lights a glTF model that brings no lights of its own: a soft key and a fill beside the camera, in a studio.
pub(super) fn studio(scene: &mut Scene, view: &View) {
    let from = |x: f64, y: f64, z: f64| (view.axes() * DVec3::new(x, y, z)).as_vec3();
    surround(scene, 1.0);
    scene.lights.extend([
        distant("key", 0.65, from(-0.7, 0.9, 0.8), SOFT),
        distant("fill", 0.12, from(1.0, 0.1, 0.6), SOFT),
    ]);
}

/// Puts a glTF model into a studio whose light comes from above: that is what metal and glass show. The ambient light stands
/// for it where it lights nothing.
pub(super) fn surround(scene: &mut Scene, strength: f32) {
    let grey = |value: f32| Rgb::splat(strength * value);
    scene.background = Background::Gradient { top: grey(1.0), horizon: grey(0.3), bottom: grey(0.12) };
    let mut taken = scene.lights.iter().map(|light| light.name.clone()).collect();
    let ambient = ambient(grey(0.15));
    scene.lights.push(Light { name: unique(ambient.name, &mut taken), ..ambient });
}

/// Stops for a model by lights of its own in any unit: those that keep the light on its middle between dim and bright.
pub(super) fn exposure_by_lights(lights: &[Light], bounds: Aabb) -> f32 {
    /// Irradiance that leaves the picture as it is: from and to, where white paper is nearly white.
    const USUAL: [f32; 2] = [0.8, 3.0];
    let centre = bounds.centre();
    let near = |position: Vec3| position.distance(centre).max(bounds.radius());
    let at_centre = |light: &Light| {
        let strength = luminance(light.intensity);
        match light.kind {
            LightKind::Point { position, .. } | LightKind::Measured { position, .. } => {
                strength / near(position).powi(2)
            }
            LightKind::Spot { position, direction, outer, .. } => {
                let is_lit = (centre - position).angle_between(direction) < outer + outer;
                if is_lit { strength / near(position).powi(2) } else { 0.0 }
            }
            LightKind::Ambient | LightKind::Directional { .. } | LightKind::Area { .. } => strength,
        }
    };
    let sum: f32 = lights.iter().map(at_centre).sum();
    let stops = (sum.clamp(USUAL[0], USUAL[1]) / sum).log2();
    if stops.is_finite() { stops } else { 0.0 }
}

/// Irradiance that the emitters of the model would give the inside of its box if they lit it evenly.
fn own_irradiance(scene: &Scene, bounds: Aabb) -> Rgb {
    let mut flux = Rgb::ZERO;
    let shines = |id: &MaterialId| !scene.materials[id.index()].surface.emission().is_zero();
    each_part(scene, &mut |part| {
        if part.object.materials.iter().any(shines) {
            for (material, _, doubled_area) in part.triangles(scene) {
                let emission = material.surface.emission();
                if !emission.is_zero() {
                    flux += PI * emission.factor * (0.5 * doubled_area.length()) as f32;
                }
            }
        }
    });
    let area = bounds.surface_area() as f32;
    if area > 0.0 { flux / area } else { Rgb::ZERO }
}

fn ambient(intensity: Rgb) -> Light {
    Light { name: "ambient".to_owned(), intensity, samples: 1, kind: LightKind::Ambient }
}

/// Light from `from`, infinitely far, from a disk of so many degrees across.
fn distant(name: &str, intensity: f32, from: Vec3, degrees: f32) -> Light {
    let kind = LightKind::Directional { direction: -from.normalize(), angle: degrees.to_radians() };
    Light { name: name.to_owned(), intensity: Rgb::splat(intensity), samples: 1, kind }
}

/// A panel under the ceiling, invisible itself, that gives the middle of the floor an irradiance near 1.
fn ceiling(bounds: Aabb) -> Light {
    let size = bounds.size();
    let panel = 0.3 * Vec2::new(size.x, size.z);
    let at = bounds.centre().with_y(bounds.max.y - 0.03 * size.y);
    let facing_down =
        DAffine3::from_rotation_translation(Quat::from_rotation_x(PI).as_dquat(), at.as_dvec3());
    let kind = LightKind::Area {
        geometry: Geometry::Shape(Shape::Rectangle(Rectangle { size: panel })),
        transform: Transform::new(facing_down).unwrap_or_default(),
        two_sided: false,
        visible: false,
        falloff: Falloff::InverseSquare,
    };
    let intensity = Rgb::splat(size.y * size.y / (panel.x * panel.y));
    Light { name: "ceiling".to_owned(), intensity, samples: 4, kind }
}

/// Neutral grey, lightest at the horizon; even where the horizon does not lie level in the picture.
fn backdrop(strength: f32, view: &View) -> Background {
    let grey = |value: f32| Rgb::splat(strength * value);
    if view.up == DVec3::Y {
        Background::Gradient { top: grey(0.06), horizon: grey(0.22), bottom: grey(0.06) }
    } else {
        Background::Constant(grey(0.18))
    }
}
