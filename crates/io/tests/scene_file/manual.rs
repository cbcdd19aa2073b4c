//! The manual in the rustdoc: its examples are scene files, and the defaults that it names are the defaults.

use crate::support::shot;
use heliostat_io::View;
use heliostat_io::scene_file::SceneFile;
use heliostat_scene::RenderSettings;
use heliostat_scene::material::Surface;
use std::path::Path;

/// The TOML blocks in the head of a source file.
fn blocks(name: &str) -> Vec<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(name);
    let text = std::fs::read_to_string(path).unwrap();
    let head: Vec<_> = text.lines().map_while(|line| line.strip_prefix("//!")).collect();
    let head = head.join("\n").replace("\n ", "\n");
    head.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

/// What stands before a block that shows only some keys of a table.
fn before(name: &str) -> &'static str {
    match name {
        "shape.rs" | "placement.rs" => "[[object]]\n",
        "texturable.rs" => "[[material]]\nname = \"m\"\n[material.phong]\n",
        _ => "",
    }
}

#[test]
fn every_example_is_a_scene_file() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/scene_file");
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let mut count = 0;
    for name in names {
        for block in blocks(&format!("scene_file/{name}")) {
            let text = format!("{}{block}", before(&name));
            toml::from_str::<SceneFile>(&text).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
            count += 1;
        }
    }
    let [animation] = &blocks("animation/mod.rs")[..] else { panic!("one example") };
    toml::from_str::<SceneFile>(animation).unwrap();
    assert!(count >= 16, "{count} examples");
}

#[test]
fn the_defaults_of_the_manual_are_the_defaults() {
    let [render] = &blocks("scene_file/render.rs")[..] else { panic!("one example") };
    let [output] = &blocks("scene_file/output.rs")[..] else { panic!("one example") };
    let written = shot(&format!("{render}\n{output}\n[camera]\n")).unwrap();
    let silent = shot("[camera]\n").unwrap();
    assert_eq!(written.settings, RenderSettings::default());
    assert_eq!(silent.settings, RenderSettings::default());
    assert_eq!((written.view, silent.view), (View::default(), View::default()));
    assert_eq!(written.output, silent.output);
    let [material] = &blocks("scene_file/material.rs")[..] else { panic!("one example") };
    let written = shot(&format!(
        "[camera]\n[[texture]]\nname = \"noise\"\nchecker = {{ even = 0, odd = 1 }}\n{material}"
    ));
    let silent = shot("[camera]\n[[material]]\nname = \"glass\"\n").unwrap();
    assert_eq!(written.unwrap().scene.materials[0].surface, silent.scene.materials[0].surface);
    let [standard] = &blocks("scene_file/standard.rs")[..] else { panic!("one example") };
    let written = shot(&format!("[camera]\n{standard}")).unwrap();
    let standard = Surface::Standard(Box::default());
    assert_eq!(written.scene.materials[0].surface, standard);
    let [camera] = &blocks("scene_file/camera.rs")[..] else { panic!("one example") };
    let written = shot(
        &camera.replace("[0, 1, 5]", "[0, 0, 0]").replace("look_at = [0, 1, 0]", "look_at = [0, 0, -1]"),
    );
    let silent = shot("[camera]\nname = \"main\"\nfocus = { distance = 5, f_number = 2.8 }\n").unwrap();
    assert_eq!(written.unwrap().scene.cameras, silent.scene.cameras);
}
