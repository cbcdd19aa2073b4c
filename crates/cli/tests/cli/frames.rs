//! Frame ranges: names, leaving out what is there, and what a frame shows.

use crate::common::Folder;

#[test]
fn a_range_without_a_pattern_gets_four_digits() {
    let folder = Folder::with_scene();
    let run = folder.run(&["render", "scene.toml", "--frames", "2-4x2", "-o", "a.exr"]).expect(0);
    assert_eq!(folder.names(), ["a.0002.exr", "a.0004.exr", "scene.toml"]);
    assert!(run.stdout.contains("Saved: 'a.0002.exr'\n") && run.stdout.contains("Saved: 'a.0004.exr'\n"));
    assert_ne!(folder.read("a.0002.exr"), folder.read("a.0004.exr"), "the ball has moved");
}

#[test]
fn patterns_and_several_outputs() {
    let folder = Folder::with_scene();
    let outputs = ["-o", "a.##.png", "-o", "b_%03d.exr"];
    folder.run(&[&["render", "scene.toml", "--frames", "3"], &outputs[..]].concat()).expect(0);
    assert_eq!(folder.names(), ["a.03.png", "b_003.exr", "scene.toml"]);
}

#[test]
fn all_frames_of_the_scene_and_the_first_one() {
    let folder = Folder::with_scene();
    folder.run(&["render", "scene.toml", "--frames", "all"]).expect(0);
    let frames = ["scene.0001.png", "scene.0002.png", "scene.0003.png", "scene.0004.png"];
    assert_eq!(folder.names()[..4], frames);
    folder.run(&["render", "scene.toml", "-o", "still.png"]).expect(0);
    assert_eq!(folder.read("still.png"), folder.read("scene.0001.png"));
}

#[test]
fn frames_in_one_run_are_the_frames_alone() {
    let folder = Folder::with_scene();
    folder.run(&["render", "scene.toml", "--frames", "1-3", "-o", "run.exr"]).expect(0);
    folder.run(&["render", "scene.toml", "--frames", "3", "-o", "alone.exr"]).expect(0);
    assert_eq!(folder.read("run.0003.exr"), folder.read("alone.0003.exr"));
}

#[test]
fn existing_frames_are_left_out_when_asked_to() {
    let folder = Folder::with_scene();
    folder.write("a.0002.png", "not touched");
    let arguments = ["render", "scene.toml", "--frames", "1-2", "-o", "a.png"];
    let run = folder.run(&[&arguments[..], &["--skip-existing"]].concat()).expect(0);
    assert!(run.stdout.lines().any(|l| l == "skipping existing frame 2: 'a.0002.png'"), "{run:#?}");
    assert_eq!(folder.read("a.0002.png"), b"not touched");
    folder.run(&arguments).expect(0);
    assert!(folder.read("a.0002.png").starts_with(b"\x89PNG"));
}
