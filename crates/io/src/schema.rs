//! The JSON Schema of the scene file, made from the types that read it.

use crate::scene_file::SceneFile;
use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::{RecursiveTransform, Transform};
use serde_json::Value;

/// The schema by which editors complete and check scene files.
pub fn json_schema() -> Value {
    let mut schema = SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<SceneFile>();
    RecursiveTransform(without_null).transform(&mut schema);
    if let Some(root) = schema.as_object_mut() {
        root.insert("title".to_owned(), "Heliostat scene".into());
    }
    schema.to_value()
}

/// TOML has no null: an optional key is a key that may be left out.
fn without_null(schema: &mut Schema) {
    let Some(object) = schema.as_object_mut() else { return };
    // Defaults that are no plain value say no more than "may be left out".
    if object.get("default").is_some_and(|value| value.is_null() || value.is_object() || value.is_array()) {
        object.remove("default");
    }
    if let Some(Value::Array(types)) = object.get_mut("type") {
        types.retain(|name| name != "null");
        if let [only] = types.as_slice() {
            let only = only.clone();
            object.insert("type".to_owned(), only);
        }
    }
    if let Some(Value::Array(values)) = object.get_mut("enum") {
        values.retain(|value| !value.is_null());
    }
    let is_null = |branch: &Value| branch.get("type").is_some_and(|name| name == "null");
    let Some(Value::Array(branches)) = object.get_mut("anyOf") else { return };
    branches.retain(|branch| !is_null(branch));
    if branches.len() == 1 {
        let only = branches.remove(0);
        object.remove("anyOf");
        if let Value::Object(only) = only {
            // The description of the key is nearer to the reader than that of its type.
            only.into_iter().for_each(|(key, value)| {
                object.entry(key).or_insert(value);
            });
        }
    }
}
