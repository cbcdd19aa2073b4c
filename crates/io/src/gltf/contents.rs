//! What a file holds, for those who want to know before they render it.

use super::GltfModel;
use super::extensions::ignored;
use super::images::source;
use super::mesh::{Drawn, drawn};
use super::textures;
use serde::Serialize;

/// What is in a glTF file, shown or not.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Contents {
    /// The program that wrote it; empty if it does not say.
    pub generator: String,
    /// Names of the scenes; the default one is shown.
    pub scenes: Vec<String>,
    /// Nodes of all scenes.
    pub nodes: usize,
    /// Meshes, shared by nodes.
    pub meshes: usize,
    /// Parts of meshes with one material each.
    pub primitives: usize,
    /// Parts that are points or lines, which are left out.
    pub points_and_lines: usize,
    /// Names of the materials.
    pub materials: Vec<String>,
    /// The textures with the sizes of their images.
    pub textures: Vec<ImageSize>,
    /// Names of the cameras.
    pub cameras: Vec<String>,
    /// Names of the lights.
    pub lights: Vec<String>,
    /// Animations, with the number of things that each moves.
    pub animations: Vec<Named>,
    /// Skins, with the number of their bones.
    pub skins: Vec<Named>,
    /// Names of the variants of materials.
    pub variants: Vec<String>,
    /// Whether its meshes bend or morph while the shutter is open: they are shown as they are in its middle.
    pub unblurred_meshes: bool,
    /// Extensions that the file uses.
    pub extensions: Vec<String>,
    /// Those of them that are ignored.
    pub ignored: Vec<String>,
}

/// A texture and the size of its image.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ImageSize {
    /// Name of the texture or of its image.
    pub name: String,
    /// Width and height in pixels; `None` where nothing that is shown looks at it, or where it is missing.
    pub size: Option<[u32; 2]>,
}

/// A thing with a number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Named {
    /// Name.
    pub name: String,
    /// How many.
    pub count: usize,
}

/// Looks through a file.
pub(super) fn of(model: &GltfModel) -> Contents {
    let root = &model.document.root;
    let primitives = || root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let texture = |i: usize| ImageSize {
        name: textures::name(&model.document, i),
        size: source(&model.document, i).ok().and_then(|image| model.images.size(image)),
    };
    let animation = |(i, animation): (usize, &gltf::json::Animation)| Named {
        name: named(&animation.name, "animation", i),
        count: animation.channels.len(),
    };
    let skin = |(i, skin): (usize, &gltf::json::Skin)| Named {
        name: named(&skin.name, "skin", i),
        count: skin.joints.len(),
    };
    Contents {
        generator: root.asset.generator.clone().unwrap_or_default(),
        scenes: root.scenes.iter().enumerate().map(|(i, scene)| named(&scene.name, "scene", i)).collect(),
        nodes: root.nodes.len(),
        meshes: root.meshes.len(),
        primitives: primitives().count(),
        points_and_lines: primitives().filter(|primitive| drawn(primitive) != Drawn::Triangles).count(),
        materials: root.materials.iter().enumerate().map(|(i, m)| named(&m.name, "material", i)).collect(),
        textures: (0..root.textures.len()).map(texture).collect(),
        cameras: root
            .cameras
            .iter()
            .enumerate()
            .map(|(i, camera)| named(&camera.name, "camera", i))
            .collect(),
        lights: model.lights.names(),
        animations: root.animations.iter().enumerate().map(animation).collect(),
        skins: root.skins.iter().enumerate().map(skin).collect(),
        variants: model.variants.clone(),
        unblurred_meshes: model.last_key().is_some() && bends(root),
        extensions: root.extensions_used.clone(),
        ignored: ignored(root),
    }
}

/// Whether any mesh bends or morphs.
fn bends(root: &gltf::json::Root) -> bool {
    let targets =
        |primitive: &gltf::json::mesh::Primitive| primitive.targets.iter().flatten().next().is_some();
    let morphs = root.meshes.iter().flat_map(|mesh| &mesh.primitives).any(targets);
    morphs || !root.skins.is_empty()
}

fn named(name: &Option<String>, kind: &str, index: usize) -> String {
    name.clone().filter(|name| !name.is_empty()).unwrap_or_else(|| format!("{kind} {index}"))
}
