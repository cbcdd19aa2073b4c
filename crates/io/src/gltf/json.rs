//! The JSON as the structures of the crate `gltf`.
//!
//! The crate's own checks are left out: they refuse extensions that are read here. What it has for extensions is left
//! out too, because it knows a third of them; the extensions come as plain JSON and are read where they are needed.

use super::flaw::Flaw;
use gltf::json::Root;
use serde_json::Value;

/// Reads the JSON.
///
/// # Errors
/// When it is none, or does not have the form of glTF.
pub(super) fn parse(text: &[u8]) -> Result<Root, Flaw> {
    // What is wrong is told of the file as it is, not as it was mended.
    let root: Root =
        serde_json::from_slice(text).or_else(|error| mended(text).ok_or_else(|| damaged(&error)))?;
    let version = &root.asset.version;
    if version.split('.').next() != Some("2") {
        let message = format!("is glTF {version}");
        return Err(Flaw::new("asset.version", message).with_help("convert it to glTF 2.0"));
    }
    Ok(root)
}

fn damaged(error: &serde_json::Error) -> Flaw {
    Flaw::new("", format!("is no glTF: {error}")).with_help("export the file again")
}

/// The file with what the crate takes as required and glTF does not: nodes of scenes and of the targets of animations.
fn mended(text: &[u8]) -> Option<Root> {
    let mut json: Value = serde_json::from_slice(text).ok()?;
    for scene in json.get_mut("scenes").and_then(Value::as_array_mut).into_iter().flatten() {
        scene.as_object_mut()?.entry("nodes").or_insert(Value::Array(Vec::new()));
    }
    for animation in json.get_mut("animations").and_then(Value::as_array_mut).into_iter().flatten() {
        if let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) {
            channels.retain(|channel| channel.pointer("/target/node").is_some());
        }
    }
    serde_json::from_value(json).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_gltf_leaves_free_may_be_left_out() {
        let text =
            br#"{"asset": {"version": "2.0"}, "scenes": [{}], "animations": [{"samplers": [], "channels": [
            {"sampler": 0, "target": {"path": "pointer"}}]}]}"#;
        let root = parse(text).unwrap();
        assert!(root.scenes[0].nodes.is_empty() && root.animations[0].channels.is_empty());
    }

    #[test]
    fn other_versions_and_other_texts_are_refused() {
        for text in [r#"{"asset": {"version": "1.0"}}"#, "{}", "", "[1]", r#"{"asset": 3}"#] {
            assert!(parse(text.as_bytes()).is_err(), "{text}");
        }
    }
}
