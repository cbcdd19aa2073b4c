//! `KHR_draco_mesh_compression`: primitives whose accessors are packed together.
//!
//! An accessor of such a primitive has no bytes of its own. When it is asked for, the primitive is unpacked, once, and the numbers come out
//! in the form that the accessor says.
//!
//! # Source
//! Khronos, "`KHR_draco_mesh_compression`"; the bitstream through the crate `draco-core`.

use super::accessor::Component;
use super::document::{Bytes, Document};
use super::extensions::extension;
use super::flaw::Flaw;
use crate::image_file::{Refusal, shield};
use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};
use gltf::json::Root;
use gltf::json::validation::Checked;
use serde::Deserialize;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// The name of the extension.
pub(super) const NAME: &str = "KHR_draco_mesh_compression";
/// Bytes that one primitive may unpack to.
const MOST_BYTES: u64 = 1 << 30;

/// The extension of a primitive.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Packed {
    buffer_view: usize,
    attributes: HashMap<String, u32>,
}

/// What of a primitive is in an accessor.
#[derive(Clone, Copy, Debug)]
enum Part {
    Indices,
    /// The attribute of this number in the packed bytes.
    Attribute(u32),
}

/// The accessors that are packed.
#[derive(Debug, Default)]
pub(super) struct Draco {
    accessors: HashMap<usize, (usize, Part)>,
    /// Buffer views with packed primitives, and what is in them.
    views: HashMap<usize, OnceLock<Result<Arc<Unpacked>, Flaw>>>,
}

/// A primitive.
struct Unpacked(Mesh);

impl std::fmt::Debug for Unpacked {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Unpacked").field(&self.0.num_faces()).finish()
    }
}

impl Draco {
    /// Finds the packed accessors of a file.
    ///
    /// # Errors
    /// When an extension does not have its form.
    pub(super) fn of(root: &Root) -> Result<Self, Flaw> {
        let mut all = Self::default();
        for (i, mesh) in root.meshes.iter().enumerate() {
            for (j, primitive) in mesh.primitives.iter().enumerate() {
                let others = primitive.extensions.as_ref().map(|extensions| &extensions.others);
                let place = format!("meshes[{i}].primitives[{j}]");
                let Some(packed) = extension::<Packed>(others, NAME, &place)? else { continue };
                let view = packed.buffer_view;
                all.views.entry(view).or_default();
                if let Some(indices) = primitive.indices {
                    all.accessors.insert(indices.value(), (view, Part::Indices));
                }
                for (name, accessor) in &primitive.attributes {
                    let Checked::Valid(name) = name else { continue };
                    if let Some(&id) = packed.attributes.get(&name.to_string()) {
                        all.accessors.insert(accessor.value(), (view, Part::Attribute(id)));
                    }
                }
            }
        }
        Ok(all)
    }
}

impl Document {
    /// The numbers of a packed accessor without gaps, and how many elements there are; `None` for an accessor that is not packed.
    pub(super) fn unpacked_elements(
        &self,
        accessor: usize,
        component: Component,
        components: usize,
        place: &str,
    ) -> Result<Option<(Bytes, usize)>, Flaw> {
        let Some(&(view, part)) = self.draco.accessors.get(&accessor) else { return Ok(None) };
        let unpack = || self.unpack_draco(view, place);
        let Unpacked(mesh) = &*self.draco.views[&view].get_or_init(unpack).clone()?;
        let points = mesh.num_points();
        let attribute = match part {
            Part::Attribute(id) => mesh
                .attribute_by_unique_id(id)
                .ok_or_else(|| damaged(place, &format!("have no attribute {id}")))?,
            Part::Indices => {
                let corners = mesh.faces().iter().flatten();
                let bytes: Vec<u8> = corners.flat_map(|point| component.whole(point.0)).collect();
                return Ok(Some((bytes.into(), 3 * mesh.num_faces())));
            }
        };
        let numbers = attribute.read_f32s(points, components);
        let bytes: Vec<u8> = numbers.iter().flat_map(|&v| component.stored(v)).collect();
        Ok(Some((bytes.into(), points)))
    }

    fn unpack_draco(&self, view: usize, place: &str) -> Result<Arc<Unpacked>, Flaw> {
        let (bytes, _) = self.raw_view(view, place)?;
        let decode = || {
            let limits = DecodeLimits::default().with_max_decoded_bytes(MOST_BYTES);
            let mut buffer = DecoderBuffer::new(&bytes).with_limits(limits);
            let mut mesh = Mesh::new();
            let decoded = MeshDecoder::new().decode(&mut buffer, &mut mesh);
            decoded.map_err(|error| Refusal::Damaged(format!("cannot be unpacked: {error}")))?;
            Ok(mesh)
        };
        match shield(decode) {
            Ok(mesh) => Ok(Arc::new(Unpacked(mesh))),
            Err(Refusal::Damaged(why) | Refusal::Variant(why) | Refusal::Large(why)) => {
                Err(damaged(&format!("bufferViews[{view}]"), &why))
            }
        }
    }
}

fn damaged(place: &str, why: &str) -> Flaw {
    Flaw::new(place, format!("packed bytes {why}"))
        .with_help("unpack it with `gltf-transform copy in.glb out.glb`")
}

#[cfg(test)]
mod tests {
    use super::*;
    use draco_core::{DataType, EncoderBuffer, EncoderOptions, GeometryAttributeType, MeshEncoder};
    use draco_core::{PointAttribute, PointIndex};
    use std::fmt::Write;

    /// Corners of a grid of 4 by 4 squares.
    fn positions() -> Vec<[f32; 3]> {
        (0..25).map(|i| [(i % 5) as f32, (i / 5) as f32, 0.25 * (i % 3) as f32]).collect()
    }

    fn triangles() -> Vec<[u32; 3]> {
        let square = |i: u32| {
            let a = i % 4 + 5 * (i / 4);
            [[a, a + 1, a + 6], [a, a + 6, a + 5]]
        };
        (0..16).flat_map(square).collect()
    }

    /// The grid as the crate packs it.
    fn packed() -> Vec<u8> {
        let positions = positions();
        let mut mesh = Mesh::new();
        mesh.set_num_points(positions.len());
        let mut attribute = PointAttribute::new();
        attribute.init(GeometryAttributeType::Position, 3, DataType::Float32, false, positions.len());
        attribute.buffer_mut().update_f32s_le(0, positions.as_flattened());
        mesh.add_attribute(attribute);
        triangles().iter().for_each(|t| mesh.add_face(t.map(PointIndex)));
        let mut encoder = MeshEncoder::new();
        encoder.set_mesh(mesh);
        let mut out = EncoderBuffer::new();
        encoder.encode(&EncoderOptions::new(), &mut out).expect("it packs");
        out.data().to_vec()
    }

    /// A file whose only primitive is packed into these bytes.
    fn document(bytes: &[u8]) -> Document {
        let mut uri = String::from("data:application/octet-stream,");
        bytes.iter().for_each(|byte| write!(uri, "%{byte:02x}").expect("text grows"));
        let length = bytes.len();
        let json = format!(
            r#"{{"asset": {{"version": "2.0"}}, "extensionsRequired": ["{NAME}"],
                "buffers": [{{"byteLength": {length}, "uri": "{uri}"}}],
                "bufferViews": [{{"buffer": 0, "byteLength": {length}}}],
                "accessors": [{{"componentType": 5126, "type": "VEC3", "count": 25}},
                              {{"componentType": 5123, "type": "SCALAR", "count": 96}}],
                "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1,
                    "extensions": {{"{NAME}": {{"bufferView": 0, "attributes": {{"POSITION": 0}}}}}}}}]}}]}}"#
        );
        Document::new("a.gltf".as_ref(), json.into_bytes()).expect("a sound file")
    }

    #[test]
    fn a_packed_grid_comes_out_as_it_went_in() {
        let document = document(&packed());
        let points = document.accessor(0, "POSITION").expect("positions");
        let corners = document.accessor(1, "indices").expect("corners");
        assert_eq!((points.len(), corners.len()), (25, 96));
        // Packing renumbers points and triangles: compare the corners' places, each triangle as a set.
        let place = |p: [f32; 3]| p.map(|v| (v * 64.0).round() as i32);
        let sorted = |mut all: Vec<Vec<[i32; 3]>>| {
            all.iter_mut().for_each(|triangle| triangle.sort_unstable());
            all.sort_unstable();
            all
        };
        let index = |i: usize| corners.integers::<1>(i)[0] as usize;
        let found =
            (0..32).map(|t| (0..3).map(|c| place(points.floats(index(3 * t + c)))).collect()).collect();
        let planted =
            triangles().iter().map(|t| t.map(|v| place(positions()[v as usize])).to_vec()).collect();
        assert_eq!(sorted(found), sorted(planted));
    }

    #[test]
    fn damage_is_told_and_never_a_panic() {
        let bytes = packed();
        for cut in 0..bytes.len() {
            assert!(document(&bytes[..cut]).accessor(0, "POSITION").is_err() || cut + 4 > bytes.len());
        }
        for i in 0..bytes.len() {
            let mut flipped = bytes.clone();
            flipped[i] ^= 0x55;
            // Some flips give another sound mesh.
            let _ = document(&flipped).accessor(0, "POSITION");
        }
        let error = document(b"DRACO").accessor(0, "POSITION").unwrap_err();
        let told = error.into_error("a.gltf".as_ref()).to_string();
        assert!(told.contains("bufferViews[0]: packed bytes cannot be unpacked"), "{told}");
    }
}
