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
