//! The JSON Schema: it describes every key, and accepts what the reader accepts.

use crate::flips::flips;
use crate::keys;
use heliostat_io::schema::json_schema;
use serde_json::Value;

/// Checks an instance against the parts of JSON Schema that ours uses; gives the path of the first mismatch.
fn check(schema: &Value, root: &Value, instance: &Value, at: &str) -> Result<(), String> {
    if let Some(reference) = schema["$ref"].as_str() {
        let name = reference.rsplit('/').next().unwrap();
        check(&root["$defs"][name], root, instance, at)?;
    }
    for branches in ["anyOf", "oneOf"] {
        if let Some(branches) = schema[branches].as_array() {
            let fits = branches.iter().filter(|branch| check(branch, root, instance, at).is_ok()).count();
            if fits == 0 {
                return Err(format!("{at}: no branch fits {instance}"));
            }
        }
    }
    check_type(schema, instance, at)?;
    if let Some(values) = schema["enum"].as_array()
        && !values.contains(instance)
    {
        return Err(format!("{at}: {instance} is none of {values:?}"));
    }
    if schema.get("const").is_some_and(|value| value != instance) {
        return Err(format!("{at}: {instance} is not {}", schema["const"]));
    }
    if let Some(number) = instance.as_f64() {
        let out = schema["minimum"].as_f64().is_some_and(|min| number < min)
            || schema["maximum"].as_f64().is_some_and(|max| number > max)
            || schema["exclusiveMinimum"].as_f64().is_some_and(|min| number <= min);
        if out {
            return Err(format!("{at}: {number} is out of range"));
        }
    }
    if let Some(items) = instance.as_array() {
        let count = items.len() as u64;
        if schema["minItems"].as_u64().is_some_and(|min| count < min)
            || schema["maxItems"].as_u64().is_some_and(|max| count > max)
        {
            return Err(format!("{at}: {count} items"));
        }
        if schema.get("items").is_some() {
            for (i, item) in items.iter().enumerate() {
                check(&schema["items"], root, item, &format!("{at}.{i}"))?;
            }
        }
    }
    check_object(schema, root, instance, at)
}

fn check_type(schema: &Value, instance: &Value, at: &str) -> Result<(), String> {
    let matches = |name: &str| match name {
        "object" => instance.is_object(),
        "array" => instance.is_array(),
        "string" => instance.is_string(),
        "boolean" => instance.is_boolean(),
        "integer" => instance.is_i64() || instance.is_u64(),
        "number" => instance.is_number(),
        other => panic!("type {other}"),
    };
    let fits = match &schema["type"] {
        Value::String(name) => matches(name),
        Value::Array(names) => names.iter().filter_map(Value::as_str).any(matches),
        _ => true,
    };
    if fits { Ok(()) } else { Err(format!("{at}: {instance} is no {}", schema["type"])) }
}

fn check_object(schema: &Value, root: &Value, instance: &Value, at: &str) -> Result<(), String> {
    let Some(entries) = instance.as_object() else { return Ok(()) };
    for required in schema["required"].as_array().into_iter().flatten() {
        if !entries.contains_key(required.as_str().unwrap()) {
            return Err(format!("{at}: {required} is missing"));
        }
    }
    for (key, value) in entries {
        match schema["properties"].get(key) {
            Some(property) => check(property, root, value, &format!("{at}.{key}"))?,
            None if schema["additionalProperties"] == false => return Err(format!("{at}.{key}: unknown")),
            None => {}
        }
    }
    Ok(())
}

fn accepts(schema: &Value, text: &str) -> Result<(), String> {
    let instance: Value = toml::from_str(text).map_err(|error| error.to_string())?;
    check(schema, schema, &instance, "")
}

#[test]
fn every_key_has_a_description() {
    let schema = json_schema();
    let mut without = Vec::new();
    let definitions = schema["$defs"].as_object().unwrap().iter();
    for (name, definition) in definitions.chain([(&"SceneFile".to_owned(), &schema)]) {
        assert!(definition["properties"].is_null() || definition["additionalProperties"] == false, "{name}");
        for (key, property) in definition["properties"].as_object().into_iter().flatten() {
            if property["description"].as_str().is_none_or(str::is_empty) {
                without.push(format!("{name}.{key}"));
            }
        }
    }
    assert!(without.is_empty(), "{without:?}");
    assert!(!schema.to_string().contains("null"), "TOML has no null");
}

#[test]
fn the_schema_accepts_what_the_reader_accepts() {
    let schema = json_schema();
    accepts(&schema, include_str!("../../../../scenes/minimal.toml")).unwrap();
    for (table, _, one, other) in flips() {
        for lines in [one, other] {
            let text = keys::file(table, lines);
            accepts(&schema, &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        }
    }
}

#[test]
fn the_schema_refuses_what_the_reader_refuses() {
    let schema = json_schema();
    for text in [
        "camera.fov_degree = 40",
        "camera.fov = 'wide'",
        "camera.position = [0, 1]",
        "camera.projection = 'fishy'",
        "render.samples = 0",
        "render.width = 100000",
        "object = [{ sphere = {} }]",
        "object = [{ sphere = { radius = -1 } }]",
        "material = [{}]",
        "output.png_bits = 12",
    ] {
        assert!(accepts(&schema, text).is_err(), "{text}");
    }
}
