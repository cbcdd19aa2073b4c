//! The reference of the scene file, written from the JSON Schema that the renderer prints: so it cannot fall behind.

use crate::heliostat::Heliostat;
use crate::process::capture;
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::fmt::Write;

/// Tables in the order in which one writes a scene; any others follow.
const ORDER: [&str; 13] = [
    "render",
    "output",
    "time",
    "camera",
    "environment",
    "texture",
    "material",
    "mesh",
    "model",
    "object",
    "group",
    "light",
    "animation",
];

/// The reference as Markdown.
pub(super) fn markdown(heliostat: &Heliostat) -> Result<String, String> {
    let text = capture(heliostat.command(&["schema"]))?;
    let schema: Value = serde_json::from_str(&text).map_err(|e| format!("heliostat schema: {e}"))?;
    let tables = schema["properties"].as_object().ok_or("heliostat schema: no properties")?;
    let others = tables.keys().map(String::as_str).filter(|name| !ORDER.contains(name));
    let mut writer = Writer { schema: &schema, page: String::new(), told: BTreeSet::new() };
    for name in ORDER.into_iter().filter(|name| tables.contains_key(*name)).chain(others) {
        writer.table(name, &tables[name]);
    }
    Ok(writer.page)
}

/// The page so far, and the tables it has told of.
struct Writer<'s> {
    schema: &'s Value,
    page: String,
    told: BTreeSet<String>,
}

impl<'s> Writer<'s> {
    /// A heading and the keys of one top-level table.
    fn table(&mut self, name: &str, value: &'s Value) {
        let many = if value["type"] == "array" { format!("[[{name}]]") } else { format!("[{name}]") };
        let _ = write!(
            self.page,
            "\n### `{many}`\n\n{}\n\n| key | value | meaning |\n|---|---|---|\n",
            meaning(value)
        );
        if let Some((name, keys)) = self.keys(value) {
            // The objects of groups are told as objects.
            self.told.insert(name);
            self.rows("", keys);
        }
    }

    /// A line for each key, those of inner tables behind a dot.
    fn rows(&mut self, prefix: &str, keys: &'s Map<String, Value>) {
        for (key, value) in keys {
            let inner = self.keys(value);
            let kind = self.kind(value).replace('|', "\\|");
            let _ =
                writeln!(self.page, "| `{prefix}{key}` | {kind} | {} |", meaning(value).replace('|', "\\|"));
            // An inner table is told where it first stands.
            if let Some((name, keys)) = inner
                && self.told.insert(name)
            {
                self.rows(&format!("{prefix}{key}."), keys);
            }
        }
    }

    /// The keys of the table that a value is, or a list of, and the name of that table.
    fn keys(&self, value: &'s Value) -> Option<(String, &'s Map<String, Value>)> {
        let choices = value["anyOf"].as_array().map_or(&[][..], Vec::as_slice);
        let mut places = [value, &value["items"]].into_iter().chain(choices);
        let reference = places.find_map(|place| place["$ref"].as_str())?;
        let name = reference.rsplit('/').next()?;
        let keys = self.schema["$defs"][name]["properties"].as_object()?;
        Some((name.to_owned(), keys))
    }

    /// What may stand behind the equals sign.
    fn kind(&self, value: &'s Value) -> String {
        if let Some(choices) = value["anyOf"].as_array().or(value["oneOf"].as_array()) {
            let mut kinds: Vec<String> = choices.iter().map(|choice| self.kind(choice)).collect();
            kinds.retain(|kind| !kind.is_empty() && kind != "null");
            kinds.dedup();
            return kinds.join(" or ");
        }
        if let Some(reference) = value["$ref"].as_str() {
            return self.kind(&self.schema["$defs"][reference.rsplit('/').next().unwrap_or(reference)]);
        }
        if let Some(words) = value["enum"].as_array() {
            return words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
        }
        if value["const"].is_string() {
            return format!("`{}`", value["const"]);
        }
        match value["type"].as_str() {
            Some("object") => "table".into(),
            Some("array") => match (value["minItems"].as_u64(), value["items"]["type"].as_str()) {
                (Some(n), Some("number" | "integer")) => format!("{n} numbers"),
                _ => "list".into(),
            },
            Some("string") => "text".into(),
            Some("boolean") => "`true`, `false`".into(),
            Some("integer") => "whole number".into(),
            Some(kind) => kind.into(),
            None => String::new(),
        }
    }
}

/// What the schema says of a value, on one line.
fn meaning(value: &Value) -> String {
    value["description"].as_str().unwrap_or_default().replace('\n', " ")
}
