//! Laws of the scene file: whatever the bytes, the answer is a scene or an error with a place in the file.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its files has failed")]

use heliostat_io::{LoadError, OpenOptions, open};
use proptest::prelude::*;

/// A scene that uses every section, without other files.
const SCENE: &str = r#"
[render]
width = 320
samples = 4
layers = ["depth", "normal"]
[output]
view = "agx"
[time]
frame_rate = 12
shutter = 0.5
[[camera]]
name = "main"
position = [0, 1, 5]
look_at = "ball"
focus = { at = "ball", f_number = 2.8, blades = 5 }
[[camera]]
projection = "fisheye"
[environment]
gradient = { top = [0.2, 0.4, 0.8], horizon = 0.9, bottom = 0.3 }
[[texture]]
name = "tiles"
checker = { even = 0.8, odd = [0.1, 0.1, 0.2] }
scale = [4, 2.5]
[[material]]
name = "glass"
bump = { texture = "tiles", strength = 1e-3 }
[material.phong]
diffuse = { texture = "tiles", factor = 0.5 }
transparency = 0.9
[[material]]
name = "lacquer"
cutoff = 0.5
[material.standard]
roughness = { texture = "tiles", channel = "g" }
conductor = { n = [0.1, 0.4, 1.4], k = 2 }
[[object]]
name = "ball"
sphere = { radius = 1.5 }
material = "glass"
rotate = [0, 45, 0]
[[object]]
matrix = [[1, 0, 0, 0], [0, 1, 0, -1], [0, 0, 1, 0]]
plane = {}
[[light]]
area = { rectangle = { size = [1, 2] }, translate = [0, 5, 0], look_at = "ball" }
[[animation]]
target = "object.ball.translate"
keys = [[0, [0, 0, 0]], [1.5, [0, 2, 0]]]
"#;

/// Opens bytes as a scene file and evaluates a frame; an error must be whole.
fn read(bytes: &[u8]) -> Result<(), LoadError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, bytes).unwrap();
    let shot = open(&path, &OpenOptions::default()).and_then(|source| source.shot(3));
    if let Err(error) = &shot {
        let line = error.to_string();
        assert!(!line.contains('\n') && !error.report().message.is_empty(), "{line}");
        if let Some(place) = &error.report().place {
            // The marked bytes exist.
            let _ = &place.excerpt[place.span.clone()];
        }
    }
    shot.map(|shot| assert_eq!(shot.scene.validate(), Ok(())))
}

#[test]
fn the_scene_itself_is_read() {
    read(SCENE.as_bytes()).unwrap();
}

#[test]
fn deep_and_long_files_are_refused_without_overflow() {
    for text in [
        "a = ".to_owned() + &"[".repeat(100_000),
        "a = ".to_owned() + &"{ a = ".repeat(100_000),
        "a.".repeat(100_000) + "a = 1",
        "[".to_owned() + &"a.".repeat(100_000) + "a]",
        "a = \"".to_owned() + &"x".repeat(1_000_000),
        "camera = {}\n".to_owned() + &"[[light]]\n".repeat(10_000),
    ] {
        assert!(read(text.as_bytes()).is_err());
    }
}

fn values() -> impl Strategy<Value = String> {
    prop_oneof![
        Just("nan".to_owned()),
        Just("-inf".to_owned()),
        Just("\"ball\"".to_owned()),
        Just("true".to_owned()),
        Just("{}".to_owned()),
        Just("[]".to_owned()),
        Just("1979-05-27T07:32:00Z".to_owned()),
        any::<i64>().prop_map(|v| v.to_string()),
        any::<f64>().prop_map(|v| if v.is_nan() { "nan".to_owned() } else { format!("{v:?}") }),
        prop::collection::vec(-1e3..1e3, 0..5).prop_map(|v| format!("{v:?}")),
        "\"[a-z.]{0,8}\"",
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    // Cutting the file anywhere gives a scene or an error.
    #[test]
    fn a_cut_file_never_panics(end in 0..SCENE.len()) {
        let _ = read(&SCENE.as_bytes()[..end]);
    }

    // Replacing any bytes gives a scene or an error.
    #[test]
    fn flipped_bytes_never_panic(flips in prop::collection::vec((0..SCENE.len(), any::<u8>()), 1..4)) {
        let mut bytes = SCENE.as_bytes().to_vec();
        for (at, byte) in flips {
            bytes[at] = byte;
        }
        let _ = read(&bytes);
    }

    // Replacing the value of any line by any other value gives a scene or an error.
    #[test]
    fn exchanged_values_never_panic(line in 0_usize..60, value in values()) {
        let lines: Vec<String> = SCENE.lines().enumerate().map(|(i, text)| match text.split_once(" = ") {
            Some((key, _)) if i == line => format!("{key} = {value}"),
            _ => text.to_owned(),
        }).collect();
        let _ = read(lines.join("\n").as_bytes());
    }

    // Lines in any order, left out or doubled, give a scene or an error.
    #[test]
    fn shuffled_lines_never_panic(order in prop::collection::vec(0_usize..60, 0..60)) {
        let lines: Vec<_> = SCENE.lines().collect();
        let text: Vec<_> = order.into_iter().filter_map(|i| lines.get(i).copied()).collect();
        let _ = read(text.join("\n").as_bytes());
    }

    // Whatever a flag sets, it is set or refused.
    #[test]
    fn overrides_never_panic(path in "[a-z.'\"0-9]{0,24}", known in 0_usize..6, value in values()) {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("scene.toml");
        std::fs::write(&file, SCENE).unwrap();
        let paths = ["object.ball.translate.1", "camera.main.focus", "render", "material.glass.phong.ior", "animation.0.keys", "camera.0.up.0"];
        for path in [path.as_str(), paths[known]] {
            let overrides = vec![(path.to_owned(), value.clone())];
            let options = OpenOptions { overrides, ..OpenOptions::default() };
            let _ = open(&file, &options).and_then(|source| source.shot(2));
        }
    }
}
