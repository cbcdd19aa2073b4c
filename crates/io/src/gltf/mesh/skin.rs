//! Skins: vertices that follow bones.

use super::attributes::{Picked, attribute};
use crate::gltf::document::Document;
use crate::gltf::flaw::Flaw;
use glam::{DAffine3, DMat3, DMat4, DVec3, Vec3};
use gltf::json::accessor::Type;
use gltf::json::mesh::{Primitive, Semantic};
use heliostat_geometry::TriMesh;

/// The places of the bones of a skin: each a map from where the vertices were bound to where they are in the world.
#[derive(Clone, Debug)]
pub(in crate::gltf) struct Bones {
    maps: Vec<DAffine3>,
}

impl Bones {
    /// The bones of a skin when nodes stand at `places`.
    ///
    /// # Errors
    /// When the skin names nodes or numbers that are not there.
    pub(in crate::gltf) fn of(document: &Document, index: usize, places: &[DAffine3]) -> Result<Self, Flaw> {
        let skins = &document.root.skins;
        let skin = skins.get(index).ok_or_else(|| Flaw::dangling("nodes", "skins", index, skins.len()))?;
        let place = format!("skins[{index}]");
        let bound = match skin.inverse_bind_matrices {
            None => None,
            Some(matrices) => {
                let accessor =
                    document.accessor(matrices.value(), &format!("{place}.inverseBindMatrices"))?;
                Some(accessor.of(&[Type::Mat4])?.at_least(skin.joints.len())?)
            }
        };
        let map = |(i, joint): (usize, &gltf::json::Index<_>)| {
            let joint = joint.value();
            let there = places.get(joint);
            let there = there.ok_or_else(|| Flaw::dangling(&place, "nodes", joint, places.len()))?;
            let bind = bound.as_ref().map_or(DAffine3::IDENTITY, |bound| affine(bound.floats(i)));
            Ok(*there * bind)
        };
        Ok(Self { maps: skin.joints.iter().enumerate().map(map).collect::<Result<_, Flaw>>()? })
    }
}

/// The map of a matrix of columns.
pub(in crate::gltf) fn affine(columns: [f32; 16]) -> DAffine3 {
    DAffine3::from_mat4(DMat4::from_cols_array(&columns.map(f64::from)))
}

/// Moves the vertices of a mesh into the world by the bones that they follow.
pub(super) fn bend(
    document: &Document,
    primitive: &Primitive,
    bones: &Bones,
    picked: &Picked,
    mesh: &mut TriMesh,
    place: &str,
) -> Result<(), Flaw> {
    let mut sums = vec![(DAffine3::ZERO, 0.0_f64); mesh.positions.len()];
    for set in 0.. {
        let get = |semantic| attribute(document, primitive, semantic, &[Type::Vec4], None, place);
        let (Some(joints), Some(weights)) = (get(Semantic::Joints(set))?, get(Semantic::Weights(set))?)
        else {
            break;
        };
        let (joints, weights) = (joints.at_least(picked.end())?, weights.at_least(picked.end())?);
        let mut followed = picked.map(|i| (joints.integers::<4>(i), weights.floats::<4>(i))).into_iter();
        for (sum, total) in &mut sums {
            let Some((joints, weights)) = followed.next() else { break };
            for (joint, weight) in joints.into_iter().zip(weights).filter(|&(_, weight)| weight != 0.0) {
                let Some(map) = bones.maps.get(joint as usize) else {
                    let place = format!("{place}.attributes.JOINTS_{set}");
                    return Err(Flaw::dangling(place, "joints", joint as usize, bones.maps.len()));
                };
                *sum = added(sum, map, weight.into());
                *total += f64::from(weight);
            }
        }
    }
    for (i, (sum, total)) in sums.iter().enumerate() {
        // Weights add up to 1, but for rounding; a vertex that follows nothing follows the first bone.
        let map = if *total > 0.0 { added(&DAffine3::ZERO, sum, 1.0 / total) } else { bones.first() };
        mesh.positions[i] = map.transform_point3(mesh.positions[i].as_dvec3()).as_vec3();
        // Cofactors turn normals as the inverse transpose does, flat maps included.
        let [x, y, z] = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis];
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let sign = if map.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
        if let Some(normal) = mesh.normals.get_mut(i) {
            *normal = unit(sign * (cofactors * normal.as_dvec3()));
        }
        if let Some(tangent) = mesh.tangents.get_mut(i) {
            *tangent = unit(map.matrix3 * tangent.truncate().as_dvec3()).extend(tangent.w);
        }
    }
    Ok(())
}

impl Bones {
    fn first(&self) -> DAffine3 {
        self.maps.first().copied().unwrap_or(DAffine3::IDENTITY)
    }
}

/// `a + weight * b`, number by number.
fn added(a: &DAffine3, b: &DAffine3, weight: f64) -> DAffine3 {
    DAffine3 { matrix3: a.matrix3 + b.matrix3 * weight, translation: a.translation + b.translation * weight }
}

fn unit(v: DVec3) -> Vec3 {
    v.normalize_or_zero().as_vec3()
}
