//! `EXT_mesh_gpu_instancing`: a mesh at many places of a node.

use super::accessor::Accessor;
use super::document::Document;
use super::extensions::extension;
use super::flaw::Flaw;
use glam::{DAffine3, DQuat, DVec3};
use gltf::json::accessor::Type;
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Deserialize)]
struct Instancing {
    attributes: BTreeMap<String, usize>,
}

/// The places of the copies in the space of a node; `None` where it has the extension not. Flat ones are left out.
///
/// # Errors
/// When accessors are damaged or do not agree in number.
pub(super) fn places(document: &Document, node: usize) -> Result<Option<Vec<DAffine3>>, Flaw> {
    let place = format!("nodes[{node}]");
    let others = document.root.nodes[node].extensions.as_ref().map(|extensions| &extensions.others);
    let Some(instancing) = extension::<Instancing>(others, "EXT_mesh_gpu_instancing", &place)? else {
        return Ok(None);
    };
    let mut count = None;
    let mut get = |name: &str, kind: Type| -> Result<Option<Accessor>, Flaw> {
        let Some(&index) = instancing.attributes.get(name) else { return Ok(None) };
        let accessor = document.accessor(index, &format!("{place}.{name}"))?.of(&[kind])?;
        accessor.counted_like(&mut count).map(Some)
    };
    let translations = get("TRANSLATION", Type::Vec3)?;
    let rotations = get("ROTATION", Type::Vec4)?;
    let scales = get("SCALE", Type::Vec3)?;
    let vector = |accessor: &Option<Accessor>, i: usize, usual: DVec3| {
        accessor.as_ref().map_or(usual, |accessor| DVec3::from(accessor.floats::<3>(i).map(f64::from)))
    };
    let turn = |i: usize| {
        let xyzw = rotations.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |accessor| accessor.floats::<4>(i));
        DQuat::from_array(xyzw.map(f64::from)).normalize()
    };
    let copy = |i: usize| {
        let (scale, shift) = (vector(&scales, i, DVec3::ONE), vector(&translations, i, DVec3::ZERO));
        DAffine3::from_scale_rotation_translation(scale, turn(i), shift)
    };
    let copies = (0..count.unwrap_or(0)).map(copy);
    Ok(Some(copies.filter(|copy| heliostat_geometry::Transform::new(*copy).is_some()).collect()))
}
