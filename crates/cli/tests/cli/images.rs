//! `info`, `compare` and `view` over images that the binary itself wrote.

use crate::common::Folder;
use serde_json::Value;

fn rendered() -> Folder {
    let folder = Folder::with_scene();
    folder.run(&["render", "scene.toml", "-o", "a.exr", "-o", "a.png", "--aov", "all"]).expect(0);
    folder
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn info_of_an_image() {
    let folder = rendered();
    let info = json(&folder.run(&["info", "a.exr", "--json"]).expect(0).stdout);
    assert_eq!(info["size"], serde_json::json!([40, 30]));
    assert_eq!(info["data_window"], serde_json::json!([0, 0, 40, 30]));
    let channels = info["channels"].as_array().expect("channels");
    let named = |name: &str| channels.iter().find(|c| c["name"] == name).unwrap_or_else(|| panic!("{name}"));
    for name in ["R", "G", "B", "A", "Z", "N.X", "albedo.R", "P.X", "UV.U", "object_id.Y", "material_id.Y"] {
        assert_eq!(named(name)["nan"], 0, "{name}");
    }
    assert_eq!(named("R")["type"], "half");
    assert_eq!(named("Z")["type"], "float");
    assert_eq!(named("object_id.Y")["max"], 2.0, "two objects");
    let text = folder.run(&["info", "a.exr"]).expect(0).stdout;
    assert!(text.contains("40 x 30 pixels") && text.contains("albedo.R"), "{text}");
    let png = json(&folder.run(&["info", "a.png", "--json"]).expect(0).stdout);
    assert_eq!(png["encoding"], "sRGB");
}

#[test]
fn info_of_a_scene() {
    let folder = Folder::with_scene();
    let info = json(&folder.run(&["info", "scene.toml", "--json"]).expect(0).stdout);
    assert_eq!(info["frames"], serde_json::json!([1, 4]));
    assert_eq!(info["cameras"].as_array().map(Vec::len), Some(2));
    assert_eq!(info["objects"][1]["kind"], "sphere");
    assert_eq!(info["lights"][0]["kind"], "point");
    assert!(folder.run(&["info", "scene.toml"]).expect(0).stdout.contains("ball"));
}

#[test]
fn compare_measures_a_planted_difference() {
    let folder = rendered();
    let same = json(&folder.run(&["compare", "a.exr", "a.exr", "--json"]).expect(0).stdout);
    assert_eq!((&same["rmse"], &same["flip"], &same["max"]), (&0.0.into(), &0.0.into(), &0.0.into()));
    // Half floats double exactly: with twice the light every value differs by itself.
    folder.run(&["render", "scene.toml", "-o", "b.exr", "--set", "light.key.intensity=40"]).expect(0);
    let run = folder.run(&["compare", "a.exr", "b.exr", "--json", "--diff", "diff.png"]).expect(0);
    let twice = json(&run.stdout);
    assert!(twice["rmse"].as_f64().is_some_and(|v| v > 0.0), "{twice:#}");
    assert!(folder.read("diff.png").starts_with(b"\x89PNG"));
    folder.run(&["compare", "a.exr", "b.exr", "--channel", "A", "--max", "0"]).expect(0);
    folder.run(&["compare", "a.exr", "b.exr", "--channel", "R", "--max", "0"]).expect(1);
}

#[test]
fn compare_refuses_other_sizes() {
    let folder = rendered();
    folder.run(&["render", "scene.toml", "-o", "b.exr", "--size", "41x30"]).expect(0);
    let run = folder.run(&["compare", "a.exr", "b.exr"]).expect(3);
    assert!(run.last_line().contains("41 x 30") && run.last_line().contains("40 x 30"), "{run:#?}");
}

#[test]
fn view_is_what_render_writes() {
    let folder = rendered();
    folder
        .run(&["render", "scene.toml", "-o", "f.exr", "-o", "agx.png", "--view", "agx", "--exposure", "-1"])
        .expect(0);
    folder.run(&["view", "f.exr", "-o", "b.png", "--view", "agx", "--exposure", "-1"]).expect(0);
    // Half floats stand between: a step of 8 bits at most.
    folder.run(&["compare", "agx.png", "b.png", "--max", "0.01", "--metric", "max"]).expect(0);
    folder.run(&["view", "a.exr", "-o", "n.png", "--layer", "N", "--bits", "16"]).expect(0);
    let run = folder.run(&["view", "a.exr", "-o", "n.png", "--layer", "M"]).expect(3);
    assert!(run.last_line().contains("albedo.R"), "{run:#?}");
}

#[test]
fn index_counts_exports_and_verifies() {
    let folder = Folder::new();
    // A strip of 2 x 50 triangles.
    let vertices = (0..=50).map(|i| format!("v {i} 0 0\nv {i} 1 {}\n", i % 3)).collect::<String>();
    let faces = (0..50)
        .map(|i| 2 * i + 1)
        .map(|a| format!("f {a} {} {} {}\n", a + 2, a + 3, a + 1))
        .collect::<String>();
    folder.write("strip.obj", vertices + &faces);
    let run = folder.run(&["index", "strip.obj", "--json", "--verify", "2000"]).expect(0);
    let report = json(&run.stdout);
    let trees = report["trees"].as_array().expect("trees");
    assert_eq!(trees.len(), 4, "a mesh and the objects, with both presets");
    assert_eq!(trees[0]["primitives"], 100);
    assert_eq!(report["verify"][0]["rays"], 2000);
    assert_eq!(report["verify"][0]["disagreements"], 0);
    let export = ["index", "strip.obj", "--preset", "midpoint", "--export", "tree.obj", "--what", "depth=2"];
    folder.run(&export).expect(0);
    let text = String::from_utf8(folder.read("tree.obj")).expect("text");
    assert_eq!(text.lines().filter(|l| l.starts_with("v ")).count() % 8, 0);
    folder.run(&["index", "strip.obj", "--heatmap", "cost.png"]).expect(0);
    assert!(folder.read("cost.png").starts_with(b"\x89PNG"));
}
