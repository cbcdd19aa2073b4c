//! Denoising: what is said without the library, and, where `HELIOSTAT_OIDN` names one, what becomes of a picture.

use crate::common::Folder;
use serde_json::Value;

/// The environment variable that names the library.
const LIBRARY: &str = "HELIOSTAT_OIDN";

#[test]
fn a_library_that_is_not_there_is_told_before_the_work() {
    let folder = Folder::with_scene();
    let run =
        folder.run(&["render", "scene.toml", "-o", "a.exr", "--denoise", "--oidn", "none.so"]).expect(1);
    let line = run.last_line();
    assert!(line.starts_with("error: none.so: cannot be opened as Open Image Denoise"), "{line}");
    assert!(line.contains("name the file libOpenImageDenoise"), "{line}");
    assert_eq!(folder.names(), ["scene.toml"]);
    folder.run(&["render", "scene.toml", "-o", "a.exr"]).expect(0);
    let run = folder.run(&["denoise", "a.exr", "-o", "b.exr", "--oidn", "scene.toml"]).expect(1);
    assert!(run.last_line().contains("scene.toml: cannot be opened"), "{run:?}");
    assert_eq!(folder.names(), ["a.exr", "scene.toml"]);
}

#[test]
fn what_makes_no_sense_is_a_slip() {
    let folder = Folder::with_scene();
    let run = folder.run(&["render", "scene.toml", "--oidn", "lib.so"]).expect(2);
    assert!(run.last_line().contains("--denoise"), "{run:?}");
    let run = folder.run(&["denoise", "a.exr", "-o", "b.png"]).expect(2);
    assert!(run.last_line().contains("ends in .exr"), "{run:?}");
    folder.run(&["denoise", "none.exr", "-o", "b.exr"]).expect(3);
}

#[test]
#[expect(clippy::print_stderr, reason = "a skipped test says so")]
fn the_real_library_leaves_everything_else_as_it_is() {
    if std::env::var_os(LIBRARY).is_none() {
        eprintln!("skipped: {LIBRARY} names no library");
        return;
    }
    let folder = Folder::with_scene();
    let render = ["render", "scene.toml", "--exr-depth", "float", "-j", "2", "--aov", "albedo,normal,depth"];
    folder.run(&[&render[..], &["-o", "raw.exr"]].concat()).expect(0);
    folder.run(&[&render[..], &["-o", "clean.exr", "--denoise"]].concat()).expect(0);
    folder.run(&["denoise", "raw.exr", "-o", "later.exr", "-j", "2"]).expect(0);
    folder.run(&["denoise", "later.exr", "-o", "again.exr"]).expect(0);
    let info = |name: &str| -> Value {
        serde_json::from_str(&folder.run(&["info", name, "--json"]).expect(0).stdout).expect("JSON")
    };
    let rmse = |a: &str, b: &str, channel: &str| {
        let run = folder.run(&["compare", a, b, "--channel", channel, "--json"]).expect(0);
        let json: Value = serde_json::from_str(&run.stdout).expect("JSON");
        json["channels"][0]["rmse"].as_f64().expect("a number")
    };
    for channel in ["A", "Z", "N.X", "albedo.G"] {
        assert_eq!(rmse("raw.exr", "clean.exr", channel), 0.0, "{channel}");
    }
    for channel in ["R", "G", "B"] {
        let difference = rmse("raw.exr", "clean.exr", channel);
        assert!(difference > 0.0 && difference < 0.2, "{channel}: {difference}");
        assert_eq!(rmse("clean.exr", "later.exr", channel), 0.0, "{channel}");
        assert_eq!(rmse("clean.exr", "again.exr", channel), 0.0, "a noisy layer is the source, {channel}");
    }
    let text = info("clean.exr").to_string();
    assert!(text.contains("noisy.G") && text.contains("heliostat/denoised"), "{text}");
}
