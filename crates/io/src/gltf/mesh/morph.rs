//! Morph targets: differences that are added by weight.

use super::attributes::Picked;
use crate::gltf::document::Document;
use crate::gltf::flaw::Flaw;
use glam::Vec3;
use gltf::json::Index;
use gltf::json::accessor::{self, Type};
use gltf::json::mesh::Primitive;
use heliostat_geometry::TriMesh;

/// Adds the targets of a primitive to a mesh of its vertices.
pub(super) fn apply(
    document: &Document,
    primitive: &Primitive,
    weights: &[f32],
    picked: &Picked,
    mesh: &mut TriMesh,
    place: &str,
) -> Result<(), Flaw> {
    for (i, (target, &weight)) in primitive.targets.iter().flatten().zip(weights).enumerate() {
        if weight == 0.0 {
            continue;
        }
        let differences = |index: Option<Index<accessor::Accessor>>, name: &str| {
            let Some(index) = index else { return Ok(Vec::new()) };
            let place = format!("{place}.targets[{i}].{name}");
            let accessor = document.accessor(index.value(), &place)?.of(&[Type::Vec3])?;
            let accessor = accessor.at_least(picked.end())?;
            Ok(picked.map(|vertex| weight * Vec3::from(accessor.floats(vertex))))
        };
        let add = |to: &mut [Vec3], by: Vec<Vec3>| to.iter_mut().zip(by).for_each(|(v, d)| *v += d);
        add(&mut mesh.positions, differences(target.positions, "POSITION")?);
        add(&mut mesh.normals, differences(target.normals, "NORMAL")?);
        let turned = differences(target.tangents, "TANGENT")?;
        mesh.tangents.iter_mut().zip(turned).for_each(|(t, d)| *t += d.extend(0.0));
    }
    Ok(())
}
