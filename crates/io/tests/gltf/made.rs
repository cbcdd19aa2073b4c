//! A small model with a bit of everything, made byte by byte.

use heliostat_io::gltf::{GltfModel, Moment};
use heliostat_io::{LoadError, Warning};
use heliostat_scene::Scene;
use std::path::Path;

/// Little-endian floats.
pub(crate) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// A GLB of a JSON text and the bytes of its first buffer.
pub(crate) fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let chunk =
        |kind: &[u8; 4], bytes: Vec<u8>| [&(bytes.len() as u32).to_le_bytes()[..], kind, &bytes].concat();
    let chunks = [chunk(b"JSON", padded(json.as_bytes(), b' ')), chunk(b"BIN\0", padded(binary, 0))].concat();
    let length = chunks.len() as u32 + 12;
    [b"glTF", &2_u32.to_le_bytes()[..], &length.to_le_bytes(), &chunks].concat()
}

/// A model over one buffer, its arrays given as JSON without the outer brackets.
pub(crate) fn model(json: &str, binary: &[u8]) -> Vec<u8> {
    let length = binary.len();
    glb(
        &format!(r#"{{"asset": {{"version": "2.0"}}, "buffers": [{{"byteLength": {length}}}], {json}}}"#),
        binary,
    )
}

/// The scene of a model at a moment.
pub(crate) fn scene_at(bytes: Vec<u8>, moment: &Moment) -> Result<(Scene, Vec<Warning>), LoadError> {
    GltfModel::parse(Path::new("made.glb"), bytes)?.scene(moment)
}

/// The scene of a good model at its beginning.
pub(crate) fn scene_of(bytes: Vec<u8>) -> Scene {
    scene_at(bytes, &Moment::default()).unwrap_or_else(|error| panic!("{error}")).0
}

/// Two triangles that are skinned, morphed, animated, sparse and instanced, with a texture, a camera and a light.
pub(crate) fn everything() -> Vec<u8> {
    let mut binary = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.]);
    binary.extend([0, 1, 2, 2, 1, 3, 0, 0].map(u16::to_le_bytes).concat());
    binary.extend([0, 0, 0, 0].repeat(4));
    binary.extend(floats(&[1., 0., 0., 0.]).repeat(4));
    binary.extend(floats(&[0., 1.]));
    binary.extend(floats(&[0., 0., 0., 5., 0., 0.]));
    binary.extend([0, 255, 128, 64].repeat(4));
    binary.extend(floats(&[0., 0., 2., 3., 0., 0.]));
    binary.extend(PNG);
    let view = |offset: usize, length: usize| {
        format!(r#"{{"buffer": 0, "byteOffset": {offset}, "byteLength": {length}}}"#)
    };
    let views =
        [(0, 48), (48, 12), (64, 16), (80, 64), (144, 8), (152, 24), (176, 16), (192, 24), (216, PNG.len())];
    let views = views.map(|(offset, length)| view(offset, length)).join(",");
    let json = r#""scene": 0, "scenes": [{"nodes": [0, 1, 4]}],
        "nodes": [{"mesh": 0, "skin": 0, "name": "bent"}, {"children": [2, 3]}, {"translation": [1, 2, 3], "camera": 0},
            {"rotation": [0, 0, 0, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 5}}}}],
        "meshes": [{"weights": [0.5], "primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3, "COLOR_0": 6},
            "indices": 1, "material": 0, "targets": [{"POSITION": 7}]}]}],
        "skins": [{"joints": [1]}], "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
        "materials": [{"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"bufferView": 8, "mimeType": "image/png"}],
        "animations": [{"samplers": [{"input": 4, "output": 5}], "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot"}]}},
        "accessors": [{"bufferView": 0, "count": 4, "componentType": 5126, "type": "VEC3"},
            {"bufferView": 1, "count": 6, "componentType": 5123, "type": "SCALAR"},
            {"bufferView": 2, "count": 4, "componentType": 5121, "type": "VEC4"},
            {"bufferView": 3, "count": 4, "componentType": 5126, "type": "VEC4"},
            {"bufferView": 4, "count": 2, "componentType": 5126, "type": "SCALAR"},
            {"bufferView": 5, "count": 2, "componentType": 5126, "type": "VEC3"},
            {"bufferView": 6, "count": 4, "componentType": 5121, "type": "VEC4", "normalized": true},
            {"count": 4, "componentType": 5126, "type": "VEC3", "sparse": {"count": 2,
                "indices": {"bufferView": 6, "byteOffset": 0, "componentType": 5121}, "values": {"bufferView": 7}}}]"#;
    // The indices of the sparse accessor are the first bytes of the colours: 0, and 3 instead of one too far.
    binary[177] = 3;
    model(&format!(r#""bufferViews": [{views}], {json}"#), &binary)
}

/// A picture of one grey, half transparent pixel.
#[rustfmt::skip]
const PNG: &[u8] = &[
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x01,
    0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00, 0x00, 0x1f, 0x15, 0xc4, 0x89, 0x00, 0x00, 0x00, 0x0b, 0x49, 0x44, 0x41,
    0x54, 0x78, 0x9c, 0x63, 0x68, 0x00, 0x02, 0x00, 0x05, 0x05, 0x02, 0x01, 0xac, 0x53, 0x22, 0x3a, 0x00, 0x00, 0x00, 0x00,
    0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82,
];
