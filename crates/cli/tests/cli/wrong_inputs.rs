//! Wrong inputs: flags, scene files, OBJ, MTL and textures. Each gives exit code 2 or 3 and, last on one line, the file,
//! the place and the mend; none panics.

use crate::common::{Folder, SCENE};

/// Where the last line must say that the fault is.
enum Place {
    /// On the command line.
    Flag,
    /// In a file as a whole.
    File(&'static str),
    /// In a line of a file.
    Line(&'static str),
}
use Place::{File, Flag, Line};

/// A wrong command line over good files.
fn flags() -> Vec<(&'static str, &'static [&'static str], &'static str)> {
    vec![
        ("no such command", &["rendr", "scene.toml"], "render"),
        ("no scene", &["render"], "SCENE"),
        ("no such flag", &["render", "scene.toml", "--integratr", "whitted"], "--integrator"),
        ("no such integrator", &["render", "scene.toml", "--integrator", "whited"], "whitted"),
        ("no samples", &["render", "scene.toml", "--samples", "0"], "--samples"),
        ("samples as a word", &["render", "scene.toml", "--samples", "many"], "--samples"),
        ("size with one number", &["render", "scene.toml", "--size", "640"], "1920x1080"),
        ("size of nothing", &["render", "scene.toml", "--size", "0x100"], "1920x1080"),
        ("size beyond all memory", &["render", "scene.toml", "--size", "4000000000x4000000000"], "1920x1080"),
        ("empty region", &["render", "scene.toml", "--region", "9,9,9,9"], "region"),
        ("region outside", &["render", "scene.toml", "--region", "900,900,910,910"], "0,0,40,30"),
        ("frames backwards", &["render", "scene.toml", "--frames", "9-1"], "smaller frame first"),
        ("endless frames", &["render", "scene.toml", "--frames", "0-2000000000"], "at most"),
        ("no such layer", &["render", "scene.toml", "--aov", "dept"], "depth"),
        ("no such ending", &["render", "scene.toml", "-o", "a.jpg"], ".exr or .png"),
        ("no ending", &["render", "scene.toml", "-o", "a"], ".exr or .png"),
        ("an output twice", &["render", "scene.toml", "-o", "a.png", "-o", "a.png"], "leave one out"),
        ("--set without a value", &["render", "scene.toml", "--set", "render.samples"], "PATH=VALUE"),
        ("exposure that is no number", &["render", "scene.toml", "--exposure", "NaN"], "finite"),
        ("no such preset", &["index", "scene.toml", "--preset", "balancd"], "balanced"),
        ("no such shell", &["completions", "tcsh"], "bash"),
        ("bits that PNG has not", &["view", "a.exr", "--bits", "12"], "8 or 16"),
    ]
}

/// Flags that are right as such and wrong for the scene.
fn overrides() -> Vec<(&'static str, &'static [&'static str], &'static str)> {
    vec![
        ("no such camera", &["render", "scene.toml", "--camera", "topp"], "top"),
        ("--set of an unknown key", &["render", "scene.toml", "--set", "render.sampels=4"], "samples"),
        (
            "--set of an unknown object",
            &["render", "scene.toml", "--set", "object.bal.visible=false"],
            "ball",
        ),
        (
            "--set of a wrong type",
            &["render", "scene.toml", "--set", "render.samples=\"many\""],
            "whole number",
        ),
    ]
}

/// One line of the scene replaced.
fn scenes() -> Vec<(&'static str, &'static str, &'static str, &'static str)> {
    vec![
        ("unknown key", "fov = 40", "fov_degree = 40", "fov"),
        ("unknown section", "[render]", "[rendr]", "render"),
        ("no TOML", "width = 40", "width = = 40", ""),
        ("a text for a number", "height = 30", "height = \"tall\"", ""),
        ("a negative size", "width = 40", "width = -40", ""),
        ("NaN", "specular = 0.4", "specular = nan", ""),
        ("two coordinates", "look_at = [0, 0.5, 0]", "look_at = [0, 0.5]", ""),
        ("an unknown material", "material = \"glass\"", "material = \"glas\"", "glass"),
        ("an unknown shape", "sphere = { radius = 0.5 }", "sphree = { radius = 0.5 }", "sphere"),
        ("two shapes in one object", "plane = {}", "plane = {}\ndisk = { radius = 1 }", ""),
        ("a radius below 0", "sphere = { radius = 0.5 }", "sphere = { radius = -0.5 }", ""),
        ("a name twice", "name = \"ball\"", "name = \"floor\"", "floor"),
        ("an impossible angle", "fov = 40", "fov = 180", ""),
        ("no scale at all", "translate = [0, 0.5, 0]", "scale = 0", ""),
        ("an unknown integrator", "samples = 2", "integrator = \"wited\"", "whitted"),
        (
            "an unknown animation target",
            "target = \"object.ball.translate\"",
            "target = \"object.bal.translate\"",
            "ball",
        ),
        ("keys that run backwards", "keys = [[0, [0, 0.5, 0]], [1,", "keys = [[1, [0, 0.5, 0]], [0,", ""),
    ]
}

/// Files beside a small scene that shows `model.obj` and the texture `a.png`.
fn assets() -> Vec<(&'static str, &'static str, &'static [u8], Place)> {
    vec![
        (
            "a vertex that is not there",
            "model.obj",
            b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
            Line("model.obj:4:"),
        ),
        ("a vertex 0", "model.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", Line("model.obj:4:")),
        ("a coordinate that is no number", "model.obj", b"v 0 0 zero\n", Line("model.obj:1:")),
        ("a coordinate that is infinite", "model.obj", b"v 0 0 1e999\n", Line("model.obj:1:")),
        ("two coordinates in a vertex", "model.obj", b"v 0 0\n", Line("model.obj:1:")),
        ("no faces", "model.obj", b"v 0 0 0\n", File("model.obj")),
        ("an empty file", "model.obj", b"", File("model.obj")),
        ("an image as a model", "model.obj", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", File("model.obj")),
        ("a word in a material", "model.mtl", b"newmtl m\nKd red 0 0\n", Line("model.mtl:2:")),
        ("a statement before the first material", "model.mtl", b"Kd 1 0 0\n", Line("model.mtl:1:")),
        (
            "a texture of a material that is not there",
            "model.mtl",
            b"newmtl m\nmap_Kd none.png\n",
            Line("model.mtl:2:"),
        ),
        ("a text as a texture", "a.png", b"hello", File("a.png")),
        ("an empty texture", "a.png", b"", File("a.png")),
        ("half a PNG", "a.png", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01", File("a.png")),
        ("a GIF", "a.png", b"GIF89a\x01\0\x01\0\0\0\0;", File("a.png")),
    ]
}

const ASSET_SCENE: &str = r#"[camera]
position = [0, 0, 3]
look_at = [0, 0, 0]

[[texture]]
name = "t"
image = "a.png"

[[material]]
name = "m"
[material.phong]
diffuse = { texture = "t" }

[[object]]
name = "ball"
sphere = { radius = 1 }
material = "m"

[[model]]
name = "model"
file = "model.obj"

[[light]]
name = "key"
point = { position = [2, 4, 3] }
"#;

const MODEL: &[u8] = b"mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";

#[test]
fn wrong_flags() {
    let folder = Folder::with_scene();
    let judged = flags()
        .into_iter()
        .map(|(what, arguments, needle)| judge(&folder, what, arguments, 2, &Flag, needle));
    all_right(judged);
}

#[test]
fn flags_that_do_not_fit_the_scene() {
    let folder = Folder::with_scene();
    let judged = overrides()
        .into_iter()
        .map(|(what, arguments, needle)| judge(&folder, what, arguments, 3, &Flag, needle));
    all_right(judged);
}

#[test]
fn wrong_scene_files() {
    let folder = Folder::new();
    let judged = scenes().into_iter().flat_map(|(what, line, wrong, needle)| {
        assert!(SCENE.contains(line), "{what}: the scene has no `{line}`");
        folder.write("scene.toml", SCENE.replacen(line, wrong, 1));
        ["render", "check"]
            .map(|command| judge(&folder, what, &[command, "scene.toml"], 3, &Line("scene.toml:"), needle))
    });
    all_right(judged);
}

#[test]
fn wrong_models_materials_and_textures() {
    let judged = assets().into_iter().flat_map(|(what, file, content, place)| {
        let folder = Folder::new();
        folder.write("scene.toml", ASSET_SCENE);
        folder.write("model.obj", MODEL);
        folder.write("model.mtl", "newmtl m\nKd 1 0 0\n");
        folder.write("a.png", one_pixel());
        folder.run(&["check", "scene.toml", "--strict"]).expect(0);
        folder.write(file, content);
        ["render", "check"]
            .map(|command| judge(&folder, what, &[command, "scene.toml", "--strict"], 3, &place, ""))
    });
    all_right(judged);
}

#[test]
fn wrong_files_as_scenes_and_images() {
    let folder = Folder::with_scene();
    folder.write("latin.toml", b"[camera]\n# \xe4\n");
    folder.write("empty.toml", "");
    folder.write("text.exr", "hello");
    folder.write("scene.blend", "BLENDER");
    std::fs::create_dir(folder.file("folder.toml")).expect("a folder");
    let cases: [(&str, &[&str], Place); 9] = [
        ("a scene that is not there", &["render", "none.toml"], File("none.toml")),
        ("a scene that is a folder", &["render", "folder.toml"], File("folder.toml")),
        ("a scene in Latin-1", &["render", "latin.toml"], File("latin.toml")),
        ("an empty scene", &["render", "empty.toml"], File("empty.toml")),
        ("a scene of another program", &["render", "scene.blend"], File("scene.blend")),
        ("an image that is a text", &["info", "text.exr"], File("text.exr")),
        ("an image that is not there", &["view", "none.exr"], File("none.exr")),
        ("a comparison with nothing", &["compare", "text.exr", "none.exr"], File("text.exr")),
        ("a model that is not there", &["index", "none.obj"], File("none.obj")),
    ];
    all_right(
        cases.into_iter().map(|(what, arguments, place)| judge(&folder, what, arguments, 3, &place, "")),
    );
}

#[test]
fn there_are_enough_of_them() {
    assert!(flags().len() + overrides().len() + scenes().len() + assets().len() >= 40);
}

/// Fails with all that is not right, not only the first of it.
#[track_caller]
fn all_right(judged: impl Iterator<Item = Result<(), String>>) {
    let wrong: Vec<String> = judged.filter_map(Result::err).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Runs, and demands the exit code, nothing written, and a last line with the place and a mend.
fn judge(
    folder: &Folder,
    what: &str,
    arguments: &[&str],
    code: i32,
    place: &Place,
    needle: &str,
) -> Result<(), String> {
    let before = folder.names();
    let run = folder.run(arguments);
    let demand = |holds: bool, demand: &str| {
        if holds {
            Ok(())
        } else {
            Err(format!("{what}: {demand}\n  {arguments:?} gave {:?}\n{}", run.code, run.stderr))
        }
    };
    demand(run.code == Some(code), &format!("exit code {code}"))?;
    demand(!run.stderr.contains("panicked"), "no panic")?;
    let message = run.last_line().strip_prefix("error: ").unwrap_or_default();
    demand(!message.is_empty(), "the error last, on one line")?;
    demand(message.contains(needle), &format!("`{needle}` in the last line"))?;
    let placed = match place {
        Flag => true,
        File(name) => message.contains(name),
        Line(start) => message
            .split_once(start)
            .is_some_and(|(_, after)| after.starts_with(|c: char| c.is_ascii_digit())),
    };
    demand(placed, "the place")?;
    let mends = ["; ", "write ", "did you mean", "possible values", "expected "];
    demand(mends.iter().any(|mend| message.contains(mend)), "a mend")?;
    demand(folder.names() == before, "nothing written")
}

/// A white PNG.
fn one_pixel() -> Vec<u8> {
    use heliostat_scene::frame::{Channel, Depth, Frame};
    use heliostat_scene::settings::PixelRect;
    let channel = |name: &str| Channel { name: name.to_owned(), depth: Depth::Half, values: vec![1.0] };
    let frame = Frame {
        width: 1,
        height: 1,
        window: PixelRect { x0: 0, y0: 0, x1: 1, y1: 1 },
        channels: ["R", "G", "B"].map(channel).to_vec(),
        meta: std::collections::BTreeMap::new(),
    };
    heliostat_io::png_file::encode_png(&frame, &Default::default()).expect("a PNG")
}
