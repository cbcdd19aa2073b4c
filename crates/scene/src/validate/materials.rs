//! Rules of materials.

use super::collect::Collector;
use super::issue::ItemKind;
use crate::material::{ColorInput, Conductor, FloatInput, Material, Phong, Relief, Standard, Surface};
use crate::scene::Scene;

pub(super) fn materials<'a>(scene: &'a Scene, c: &mut Collector<'a>) {
    for (i, material) in scene.materials.iter().enumerate() {
        c.turn_to_named(ItemKind::Material, i, &material.name);
        check_material(material, c);
    }
}

fn check_material(material: &Material, c: &mut Collector<'_>) {
    match &material.surface {
        Surface::Phong(phong) => check_phong(phong, c),
        Surface::Standard(standard) => check_standard(standard, c),
        Surface::Unlit(color) => check_color("color", color, c),
    }
    c.number("opacity", material.opacity.factor, "from 0 to 1", is_share);
    material.opacity.texture.into_iter().for_each(|id| c.texture(id));
    if let Some(cutoff) = material.cutoff {
        c.number("cutoff", cutoff, "from 0 to 1", is_share);
    }
    material.interior.into_iter().for_each(|id| c.medium(id));
    material.relief.into_iter().for_each(|relief| check_relief(relief, c));
}

fn is_share(v: f32) -> bool {
    (0.0..=1.0).contains(&v)
}

fn check_relief(relief: Relief, c: &mut Collector<'_>) {
    let (Relief::Bump { texture, strength } | Relief::Normal { texture, strength }) = relief;
    c.texture(texture);
    c.finite("the strength of the relief", strength.is_finite());
}

fn check_color(what: &'static str, input: &ColorInput, c: &mut Collector<'_>) {
    c.color(what, input.factor);
    input.texture.into_iter().for_each(|id| c.texture(id));
}

fn check_standard(standard: &Standard, c: &mut Collector<'_>) {
    for (what, input) in standard.colors() {
        check_color(what, input, c);
    }
    for (what, input) in standard.shares() {
        c.number(what, input.factor, "from 0 to 1", is_share);
        input.texture.into_iter().for_each(|id| c.texture(id));
    }
    c.positive("ior", standard.ior);
    c.positive("coat_ior", standard.coat_ior);
    c.finite("anisotropy_rotation", standard.anisotropy_rotation.is_finite());
    standard.anisotropy_direction.into_iter().for_each(|id| c.texture(id));
    c.color("absorption", standard.absorption);
    let radius = standard.subsurface_radius;
    c.number("subsurface_radius", radius.min_element(), "above 0", |v| v > 0.0 && radius.is_finite());
    c.number("subsurface_anisotropy", standard.subsurface_anisotropy, "above -1 and below 1", |v| {
        v.abs() < 1.0
    });
    c.not_negative("dispersion", standard.dispersion);
    standard.coat_relief.into_iter().for_each(|relief| check_relief(relief, c));
    let film = &standard.thin_film;
    c.positive("thin_film_ior", film.ior);
    c.not_negative("thin_film_thickness", film.thickness.factor);
    c.not_negative("thin_film_least", film.least);
    film.thickness.texture.into_iter().for_each(|id| c.texture(id));
    if let Some(Conductor { n, k }) = standard.conductor {
        c.number("n of the conductor", n.min_element(), "above 0", |v| v > 0.0 && n.is_finite());
        c.color("k of the conductor", k);
    }
}

fn check_phong(phong: &Phong, c: &mut Collector<'_>) {
    check_color("ambient", &phong.ambient, c);
    check_color("diffuse", &phong.diffuse, c);
    check_color("specular", &phong.specular, c);
    check_color("emission", &phong.emission, c);
    check_color("mirror", &phong.mirror, c);
    check_color("transparency", &phong.transparency, c);
    let FloatInput { factor, texture, .. } = phong.shininess;
    c.not_negative("shininess", factor);
    texture.into_iter().for_each(|id| c.texture(id));
    c.positive("ior", phong.ior);
    c.color("absorption", phong.absorption);
}
