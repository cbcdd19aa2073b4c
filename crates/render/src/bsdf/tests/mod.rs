//! The surfaces against what is known of all surfaces: no light is made, none is lost where nothing absorbs, directions may
//! be swapped, and draws follow their density.

mod draws;
mod furnace;
mod hostile;
mod reciprocity;

use super::{StandardBsdf, StandardPoint};
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;
use std::f32::consts::TAU;

/// A count for a deep run (`HELIOSTAT_DEEP`), or for a short one.
fn fewer(deep: usize, short: usize) -> usize {
    if std::env::var_os("HELIOSTAT_DEEP").is_some() { deep } else { short }
}

/// A white surface that absorbs nothing: matte under a boundary of glass.
pub(crate) fn white() -> StandardPoint {
    StandardPoint {
        base_color: Rgb::ONE,
        diffuse_roughness: 0.0,
        metalness: 0.0,
        edge_color: Rgb::ONE,
        conductor: None,
        roughness: 0.0,
        specular: 1.0,
        specular_color: Rgb::ONE,
        ior: 1.5,
        anisotropy: 0.0,
        anisotropy_direction: Vec2::X,
        transmission: 0.0,
        thin_walled: false,
        dispersion: 0.0,
        diffuse_transmission: 0.0,
        diffuse_transmission_color: Rgb::ONE,
        subsurface: 0.0,
        subsurface_color: Rgb::ONE,
        walks: false,
        coat: 0.0,
        coat_roughness: 0.0,
        coat_ior: 1.5,
        sheen_color: Rgb::ZERO,
        sheen_roughness: 0.0,
        film: 0.0,
        film_ior: 1.3,
        film_thickness: 0.0,
    }
}

/// A change of the white surface.
type Change = fn(&mut StandardPoint);

/// Lobes and their combinations, none of which absorbs.
const LOSSLESS: &[(&str, Change)] = &[
    ("metal", |p| p.metalness = 1.0),
    ("metal, anisotropic", |p| {
        (p.metalness, p.anisotropy, p.anisotropy_direction) = (1.0, 0.7, Vec2::from_angle(0.6));
    }),
    ("matte", |p| p.specular = 0.0),
    ("matte, rough", |p| (p.specular, p.diffuse_roughness) = (0.0, 1.0)),
    ("plastic", |_| ()),
    ("plastic, light let in", |p| (p.subsurface, p.walks) = (0.7, true)),
    ("plastic, rough matte", |p| p.diffuse_roughness = 1.0),
    ("plastic, ior 2.4", |p| p.ior = 2.4),
    ("plastic, ior 1", |p| p.ior = 1.0),
    ("plastic, ior 0", |p| p.ior = 0.0),
    ("plastic, half specular", |p| (p.specular, p.specular_color) = (0.5, Rgb::new(4.0, 1.0, 0.2))),
    ("plastic, half metal", |p| p.metalness = 0.5),
    ("plastic, anisotropic", |p| p.anisotropy = 0.7),
    ("plastic, film", |p| (p.film, p.film_thickness) = (1.0, 400.0)),
    ("leaf", |p| p.diffuse_transmission = 0.4),
    ("glass", |p| p.transmission = 1.0),
    ("glass, ior 1.05", |p| (p.transmission, p.ior) = (1.0, 1.05)),
    ("glass, ior 1", |p| (p.transmission, p.ior) = (1.0, 1.0)),
    ("glass, ior 2.4", |p| (p.transmission, p.ior) = (1.0, 2.4)),
    ("glass, ior 0.7", |p| (p.transmission, p.ior) = (1.0, 0.7)),
    ("glass, half", |p| p.transmission = 0.5),
    ("glass, half specular", |p| (p.transmission, p.specular) = (1.0, 0.5)),
    ("glass, dispersed", |p| (p.transmission, p.dispersion) = (1.0, 1.0)),
    ("glass, anisotropic", |p| (p.transmission, p.anisotropy) = (1.0, 0.7)),
    ("glass, film", |p| (p.transmission, p.film, p.film_thickness) = (1.0, 1.0, 400.0)),
    ("thin glass", |p| (p.transmission, p.thin_walled) = (1.0, true)),
    ("thin glass, half", |p| (p.transmission, p.thin_walled) = (0.5, true)),
    ("coat over metal", |p| (p.coat, p.metalness) = (1.0, 1.0)),
    ("coat over metal, anisotropic", |p| (p.coat, p.metalness, p.anisotropy) = (1.0, 1.0, 0.7)),
    ("coat over plastic", |p| p.coat = 1.0),
    ("rough coat over metal", |p| (p.coat, p.coat_roughness, p.metalness) = (1.0, 0.5, 1.0)),
    ("rough coat over plastic", |p| (p.coat, p.coat_roughness) = (1.0, 0.5)),
    ("coat over glass", |p| (p.coat, p.coat_roughness, p.transmission) = (1.0, 0.3, 1.0)),
    ("coat over matte", |p| (p.coat, p.specular) = (1.0, 0.0)),
    ("coat over rough matte", |p| (p.coat, p.specular, p.diffuse_roughness) = (1.0, 0.0, 1.0)),
    ("sheen over plastic", |p| (p.sheen_color, p.sheen_roughness) = (Rgb::ONE, p.roughness)),
    ("sheen over metal", |p| (p.sheen_color, p.sheen_roughness, p.metalness) = (Rgb::ONE, 0.5, 1.0)),
    ("coat over sheen", |p| (p.coat, p.sheen_color, p.sheen_roughness) = (1.0, Rgb::ONE, 0.5)),
    ("all layers", |p| {
        (p.coat, p.coat_roughness, p.sheen_color, p.sheen_roughness) = (0.5, 0.2, Rgb::splat(0.7), 0.4);
        (p.metalness, p.transmission, p.thin_walled, p.diffuse_transmission) = (0.3, 0.4, true, 0.2);
    }),
];

/// Roughness of tests, from a mirror on.
const ROUGHNESS: [f32; 12] = [0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Cosines of viewers, from the normal to grazing angles.
const COSINES: [f32; 7] = [1.0, 0.9, 0.6, 0.3, 0.1, 0.03, 0.005];

fn rough(change: Change, roughness: f32) -> StandardPoint {
    let mut point = StandardPoint { roughness, ..white() };
    change(&mut point);
    point
}

/// A viewer at an angle of cosine `cos`, a little off the tangent.
fn viewer(cos: f32) -> Vec3 {
    let (sin, around) = ((1.0 - cos * cos).sqrt(), Vec2::from_angle(0.35));
    (sin * around).extend(cos)
}

fn outside(point: &StandardPoint) -> StandardBsdf {
    StandardBsdf::new(point, true, Vec3::Z)
}

/// Points of a lattice in the unit cube, from a set that fills it evenly.
///
/// # Source
/// Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018.
fn lattice(count: u32) -> impl Iterator<Item = Vec3> {
    let g = 1.220_744_084_605_76_f64;
    let step = [1.0 / g, 1.0 / (g * g), 1.0 / (g * g * g)];
    (0..count).map(move |i| {
        let at = |k: usize| (0.5 + step[k] * f64::from(i)).fract().min(0.999_999_9) as f32;
        Vec3::new(at(0), at(1), at(2))
    })
}

/// A direction on the unit sphere from its height and turn.
fn direction(z: f32, turn: f32) -> Vec3 {
    ((1.0 - z * z).max(0.0).sqrt() * Vec2::from_angle(TAU * turn)).extend(z)
}
