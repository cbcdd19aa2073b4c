//! Every key does something: for each key of the schema a pair of files that differ in it alone, and whose scenes differ.

use crate::flips::flips;
use crate::support::Folder;
use heliostat_io::OpenOptions;
use std::collections::BTreeSet;

/// A file with textures for what follows.
macro_rules! textured {
    ($rest:literal) => {
        concat!(
            "camera = {}\n\
             medium = [{ name = 'fog', scattering = 1 }]\n\
             texture = [{ name = 't', checker = { even = 0, odd = 1 } }, { name = 'u', image = 'a.png' }]\n",
            $rest
        )
    };
}

/// A file with materials, a mesh and an object for what follows.
macro_rules! supplied {
    ($rest:literal) => {
        concat!(
            "camera = {}\n\
             material = [{ name = 'red' }, { name = 'blue' }]\n\
             mesh = [{ name = 'tri', file = 'a.obj' }, { name = 'other', file = 'b.obj' }]\n",
            $rest
        )
    };
}

/// A whole file with `@` where the lines of a table stand.
fn template(table: &str) -> &'static str {
    match table {
        "SceneFile" => "@",
        "RenderTable" => "camera = [{ name = 'a' }, { name = 'b' }]\n[render]\n@",
        "OutputTable" => "camera = {}\n[output]\n@",
        "TimeTable" => {
            "camera = {}
             object = [{ name = 'o', plane = {} }]
             animation = [{ target = 'object.o.translate.1', keys = [[0, 0], [4, 1]] }]
             [time]\n@"
        }
        "CameraTable" => "object = [{ name = 'o', plane = {} }]\n[camera]\n@",
        "FocusTable" => "object = [{ sphere = { radius = 2 }, translate = [0, 0, -9] }]\n[camera.focus]\n@",
        "DepthLimitsTable" => "camera = {}\n[render.depth_limits]\n@",
        "EnvironmentTable" => "camera = {}\nmedium = [{ name = 'fog', scattering = 1 }]\n[environment]\n@",
        "SkyTable" => "camera = {}\n[environment.sky]\n@",
        "GradientTable" => "camera = {}\n[environment.gradient]\n@",
        "TextureTable" => "camera = {}\n[[texture]]\n@",
        "CheckerTable" => "camera = {}\n[[texture]]\nname = 't'\n[texture.checker]\n@",
        "MediumTable" => "camera = {}\n[[medium]]\n@",
        "GridTable" => "camera = {}\n[[medium]]\nname = 'm'\nscattering = 1\n[medium.grid]\n@",
        "MaterialTable" => textured!("[[material]]\n@"),
        "PhongTable" => textured!("[[material]]\nname = 'm'\n[material.phong]\n@"),
        "StandardTable" => textured!("[[material]]\nname = 'm'\n[material.standard]\n@"),
        "ConductorTable" => "camera = {}\n[[material]]\nname = 'm'\nstandard.conductor = { @ }",
        "BumpTable" => textured!("[[material]]\nname = 'm'\n[material.bump]\n@"),
        "NormalMapTable" => textured!("[[material]]\nname = 'm'\n[material.normal_map]\n@"),
        "Textured" => textured!("[[material]]\nname = 'm'\nphong.shininess = { @ }"),
        "MeshTable" => "camera = {}\n[[mesh]]\n@",
        "ModelTable" => supplied!("[[model]]\n@"),
        "ObjectTable" => supplied!("group = [{ name = 'g', object = [{ plane = {} }] }]\n[[object]]\n@"),
        "GroupTable" => "camera = {}\n[[group]]\n@",
        "CopiesTable" => "camera = {}\n[[object]]\nplane = {}\n[object.copies]\n@",
        "JitterTable" => {
            "camera = {}
             [[object]]
             plane = {}
             copies.count = [2, 1, 1]
             copies.step = [1, 0, 0]
             [object.copies.jitter]\n@"
        }
        "LightTable" => supplied!("[[light]]\n@"),
        "AreaTable" => supplied!("[[light]]\n[light.area]\n@"),
        "SphereTable" => "camera = {}\n[[object]]\nsphere = { @ }",
        "CuboidTable" => "camera = {}\n[[object]]\ncuboid = { @ }",
        "RectangleTable" => "camera = {}\n[[object]]\nrectangle = { @ }",
        "DiskTable" => "camera = {}\n[[object]]\ndisk = { @ }",
        "CylinderTable" => "camera = {}\n[[object]]\ncylinder = { @ }",
        "ConeTable" => "camera = {}\n[[object]]\ncone = { @ }",
        "TorusTable" => "camera = {}\n[[object]]\ntorus = { @ }",
        "TriangleTable" => "camera = {}\n[[object]]\ntriangle = { @ }",
        "PointTable" => "camera = {}\n[[light]]\npoint = { @ }",
        "DirectionalTable" => "camera = {}\n[[light]]\ndirectional = { @ }",
        "SpotTable" => "camera = {}\n[[light]]\nspot = { @ }",
        "AnimationTable" => {
            "camera = {}
             object = [{ name = 'o', plane = {} }, { name = 'p', plane = {} }]
             [[animation]]\n@"
        }
        other => panic!("no template for {other}"),
    }
}

pub(crate) fn file(table: &str, lines: &str) -> String {
    template(table).replace('@', lines)
}

/// What a file comes to, as text: its frames, and the shot in the middle.
fn outcome(text: &str) -> String {
    let folder = Folder::new();
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng one\nf 1 2 3\ng two\nf 1 3 4\n");
    folder.write("c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n");
    folder.write("b.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
    for (name, value) in [("a.vol", 1.0), ("b.vol", 2.0)] {
        folder.write(name, volume(value));
    }
    folder.write("a.ies", "TILT=NONE\n1 1 1 2 2 1 1 0 0 0 1 1 1\n0 90\n0 90\n9 4 6 2\n");
    for (name, value) in [("a.png", 50_u8), ("b.png", 200)] {
        let path = folder.write(name, "");
        image::RgbImage::from_pixel(2, 1, image::Rgb([value; 3])).save(&path).unwrap();
    }
    let source = folder.open(text, &OpenOptions::default()).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let shot = source.shot(30).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert_eq!(shot.warnings, [], "{text}");
    let told = (source.frames(), source.frame_rate(), source.camera_names());
    format!("{told:?} {:?} {:?} {:?} {:?}", shot.scene, shot.settings, shot.view, shot.output)
}

/// A volume file of one cell.
fn volume(density: f32) -> Vec<u8> {
    let mut bytes = b"VOL\x03".to_vec();
    [1, 1, 1, 1, 1].iter().for_each(|n: &i32| bytes.extend(n.to_le_bytes()));
    [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, density].iter().for_each(|v: &f32| bytes.extend(v.to_le_bytes()));
    bytes
}

#[test]
fn every_key_changes_the_outcome() {
    for (table, key, one, other) in flips() {
        let (first, second) = (file(table, one), file(table, other));
        assert_ne!(outcome(&first), outcome(&second), "{table}.{key} does nothing:\n{first}\n---\n{second}");
    }
}

#[test]
fn every_key_of_the_schema_is_tried() {
    let schema = heliostat_io::schema::json_schema();
    let mut known = BTreeSet::new();
    let mut add = |table: &str, definition: &serde_json::Value| {
        if let Some(properties) = definition["properties"].as_object() {
            let table = table.split('_').next().unwrap_or(table).trim_end_matches(char::is_numeric);
            known.extend(properties.keys().map(|key| (table.to_owned(), key.clone())));
        }
    };
    add("SceneFile", &schema);
    for (name, definition) in schema["$defs"].as_object().unwrap() {
        add(name, definition);
    }
    let tried: BTreeSet<_> =
        flips().map(|(table, key, ..)| ((*table).to_owned(), (*key).to_owned())).collect();
    // The command that makes a missing file changes no scene; `files.rs` tries it.
    let missing: Vec<_> =
        known.iter().filter(|(_, key)| key != "made_by").filter(|pair| !tried.contains(pair)).collect();
    assert!(missing.is_empty(), "{missing:?}");
    let unknown: Vec<_> = tried.difference(&known).collect();
    assert!(unknown.is_empty(), "{unknown:?}");
}
