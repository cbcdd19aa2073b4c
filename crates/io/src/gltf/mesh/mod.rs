//! Primitives as meshes: attributes read through their accessors, morphed and bent by bones.

mod attributes;
mod morph;
mod primitive;
mod skin;
mod tangents;

pub(super) use primitive::{PrimitiveKey, ShapeOf};
pub(super) use skin::{Bones, affine};

use super::document::Document;
use super::flaw::Flaw;
use attributes::{Attributes, Picked};
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked;
use heliostat_geometry::TriMesh;

/// What a mode draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Drawn {
    Triangles,
    Points,
    Lines,
}

/// What a primitive draws.
pub(super) fn drawn(primitive: &Primitive) -> Drawn {
    match primitive.mode {
        Checked::Valid(Mode::Points) => Drawn::Points,
        Checked::Valid(Mode::Lines | Mode::LineLoop | Mode::LineStrip) => Drawn::Lines,
        _ => Drawn::Triangles,
    }
}

/// Reads the triangles of a primitive; `place` is where it is.
///
/// # Errors
/// When an accessor is damaged, or corners name vertices that are not there.
pub(super) fn read(
    document: &Document,
    primitive: &Primitive,
    shape: &ShapeOf<'_>,
    place: &str,
) -> Result<TriMesh, Flaw> {
    let attributes = Attributes::of(document, primitive, shape.alpha, place)?;
    let mut triangles = primitive::triangles(document, primitive, attributes.count(), place)?;
    // Primitives often share the vertices of a whole model: only those of their triangles are read.
    let picked = Picked::by(&mut triangles, attributes.count());
    let mut mesh = attributes.read(&picked)?;
    mesh.triangles = triangles;
    morph::apply(document, primitive, shape.weights, &picked, &mut mesh, place)?;
    if let Some(bones) = shape.bones {
        skin::bend(document, primitive, bones, &picked, &mut mesh, place)?;
    }
    // Shading wants unit vectors; quantised, morphed and bent ones are not.
    mesh.normals.iter_mut().for_each(|n| *n = n.normalize_or_zero());
    for t in &mut mesh.tangents {
        *t = t.truncate().normalize_or_zero().extend(if t.w < 0.0 { -1.0 } else { 1.0 });
    }
    if let Some(set) = shape.normal_map.filter(|_| mesh.tangents.is_empty()) {
        tangents::add(&mut mesh, set);
    }
    mesh.validate()
        .map_err(|error| Flaw::new(place, error.to_string()).with_help("export the file again"))?;
    Ok(mesh)
}
