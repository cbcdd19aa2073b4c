//! `KHR_materials_variants`: other materials by name.

use super::document::Document;
use super::extensions::extension;
use super::flaw::Flaw;
use gltf::json::mesh::Primitive;
use serde::Deserialize;

const NAME: &str = "KHR_materials_variants";

#[derive(Deserialize)]
struct All {
    variants: Vec<Variant>,
}

#[derive(Deserialize)]
struct Variant {
    name: String,
}

#[derive(Deserialize)]
struct Mappings {
    mappings: Vec<Mapping>,
}

#[derive(Deserialize)]
struct Mapping {
    material: usize,
    variants: Vec<usize>,
}

/// The names of the variants of a file.
pub(super) fn names(document: &Document) -> Result<Vec<String>, Flaw> {
    let others = document.root.extensions.as_ref().map(|extensions| &extensions.others);
    let all = extension::<All>(others, NAME, "")?;
    Ok(all.map_or(Vec::new(), |all| all.variants.into_iter().map(|variant| variant.name).collect()))
}

/// The material of a primitive in a variant, or without one.
pub(super) fn material(
    primitive: &Primitive,
    variant: Option<usize>,
    place: &str,
) -> Result<Option<usize>, Flaw> {
    let usual = primitive.material.map(|material| material.value());
    let Some(variant) = variant else { return Ok(usual) };
    let others = primitive.extensions.as_ref().map(|extensions| &extensions.others);
    let mappings = extension::<Mappings>(others, NAME, place)?.map_or(Vec::new(), |all| all.mappings);
    let chosen = mappings.iter().find(|mapping| mapping.variants.contains(&variant));
    Ok(chosen.map(|mapping| mapping.material).or(usual))
}
