//! Signals: the first saves what there is, with the exit code that shells expect.

use crate::common::Folder;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

/// Starts a render that would take for ever, and returns when it has begun to trace.
fn start(folder: &Folder, outputs: &[&str]) -> (Child, BufReader<std::process::ChildStderr>) {
    let endless = ["render", "scene.toml", "--samples", "1048576", "--progress", "json"];
    let mut command = folder.command(&[&endless[..], outputs].concat());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the binary starts");
    let mut lines = BufReader::new(child.stderr.take().expect("piped"));
    let mut line = String::new();
    while !line.contains("\"progress\"") {
        line.clear();
        assert_ne!(lines.read_line(&mut line).expect("text"), 0, "ended before its first progress");
    }
    (child, lines)
}

fn send(signal: &str, child: &Child) {
    let status = Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(status.expect("kill is there").success());
}

fn end(mut child: Child, lines: BufReader<std::process::ChildStderr>) -> Option<i32> {
    // Read to the end, so that the process never waits for us.
    let rest: Vec<String> = lines.lines().map_while(Result::ok).collect();
    assert!(!rest.iter().any(|line| line.contains("panicked")), "{rest:?}");
    child.wait().expect("it ends").code()
}

#[test]
fn ctrl_c_saves_the_picture_and_exits_130() {
    let folder = Folder::with_scene();
    let (child, lines) = start(&folder, &["-o", "a.exr", "-o", "a.png", "--stats", "stats.json"]);
    send("-INT", &child);
    assert_eq!(end(child, lines), Some(130));
    assert_eq!(folder.names(), ["a.exr", "a.png", "scene.toml", "stats.json"]);
    folder.run(&["info", "a.exr"]).expect(0);
    let stats: serde_json::Value = serde_json::from_slice(&folder.read("stats.json")).expect("JSON");
    assert_eq!(stats["interrupted"], true);
    assert_eq!(stats["frames"][0]["finished"], false);
}

#[test]
fn sigterm_exits_143_and_marks_an_unfinished_frame() {
    let folder = Folder::with_scene();
    let (child, lines) = start(&folder, &["-o", "a.exr", "--frames", "2-3"]);
    send("-TERM", &child);
    assert_eq!(end(child, lines), Some(143));
    assert_eq!(folder.names(), ["a.0002.partial.exr", "scene.toml"]);
}
