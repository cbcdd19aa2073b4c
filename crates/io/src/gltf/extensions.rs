//! Extensions: which ones are read, and how to do without the others.

use super::flaw::Flaw;
use gltf::json::Root;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// Extensions that are read.
const READ: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
    "KHR_texture_transform",
];

/// What stands for a file that needs an extension that is not read.
fn mend(extension: &str) -> &'static str {
    match extension {
        "KHR_texture_basisu" => "convert its textures with `gltf-transform ktxdecompress in.glb out.glb`",
        "EXT_texture_avif" => "convert its textures with `gltf-transform png in.glb out.glb`",
        "MSFT_texture_dds" => "export it with PNG, JPEG or WebP textures",
        _ => "export it without this extension",
    }
}

/// Refuses a file that cannot be shown without an extension that is not read.
pub(super) fn check_required(root: &Root) -> Result<(), Flaw> {
    match root.extensions_required.iter().find(|name| !READ.contains(&name.as_str())) {
        None => Ok(()),
        Some(name) => {
            let message = format!("needs the extension {name}, which is not read");
            Err(Flaw::new("extensionsRequired", message).with_help(mend(name)))
        }
    }
}

/// The extensions of a file that are not read.
pub(super) fn ignored(root: &Root) -> Vec<String> {
    root.extensions_used.iter().filter(|name| !READ.contains(&name.as_str())).cloned().collect()
}

/// An extension of a thing; `others` are those of the thing.
///
/// # Errors
/// When it does not have its form.
pub(super) fn extension<T: DeserializeOwned>(
    others: Option<&Map<String, Value>>,
    name: &str,
    place: &str,
) -> Result<Option<T>, Flaw> {
    let Some(value) = others.and_then(|others| others.get(name)) else { return Ok(None) };
    T::deserialize(value).map(Some).map_err(|error| {
        Flaw::new(format!("{place}.extensions.{name}"), error.to_string()).with_help("export the file again")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_required_extension_that_is_not_read_is_named_with_its_mend() {
        let root = |name: &str| Root { extensions_required: vec![name.to_owned()], ..Root::default() };
        assert!(READ.iter().all(|name| check_required(&root(name)).is_ok()));
        let error = check_required(&root("KHR_texture_basisu")).unwrap_err();
        assert_eq!(
            error.into_error("a.glb".as_ref()).to_string(),
            "a.glb: extensionsRequired: needs the extension KHR_texture_basisu, which is not read; \
             convert its textures with `gltf-transform ktxdecompress in.glb out.glb`"
        );
        assert!(check_required(&root("ACME_thing")).is_err());
    }
}
