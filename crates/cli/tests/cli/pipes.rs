//! Readers that have gone: no panic, and a picture all the same.

use crate::common::Folder;
use std::process::Stdio;

#[test]
fn a_closed_output_ends_quietly() {
    let folder = Folder::with_scene();
    let long: [&[&str]; 5] =
        [&["schema"], &["completions", "zsh"], &["man"], &["render", "--help"], &["info", "scene.toml"]];
    for arguments in long {
        let mut child = folder
            .command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary starts");
        // Nobody will ever read.
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{arguments:?}");
    }
}

#[test]
fn a_render_without_readers_saves_its_picture() {
    let folder = Folder::with_scene();
    let mut child = folder
        .command(&["render", "scene.toml"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary starts");
    drop((child.stdout.take(), child.stderr.take()));
    assert_eq!(child.wait().expect("it ends").code(), Some(0));
    assert!(folder.read("scene.png").starts_with(b"\x89PNG"));
}

#[test]
fn an_error_without_a_reader_keeps_its_exit_code() {
    let folder = Folder::new();
    for (arguments, code) in [(&["render", "none.toml"][..], 3), (&["rendr"], 2), (&[], 2)] {
        let mut child = folder
            .command(arguments)
            .stderr(Stdio::piped())
            .stdout(Stdio::null())
            .spawn()
            .expect("it starts");
        drop(child.stderr.take());
        assert_eq!(child.wait().expect("it ends").code(), Some(code), "{arguments:?}");
    }
}
