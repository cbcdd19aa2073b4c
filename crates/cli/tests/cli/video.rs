//! `video`, with and without an ffmpeg.

use crate::common::{Folder, Run};

#[test]
fn without_ffmpeg_one_line_says_so() {
    let folder = Folder::with_scene();
    folder.run(&["render", "scene.toml", "--frames", "1-2", "-o", "a.png"]).expect(0);
    let arguments = ["video", "a.####.png", "-o", "a.mp4"];
    let output = folder.command(&arguments).env("PATH", folder.path()).output().expect("the binary starts");
    let run = Run::new(&output).expect(1);
    assert_eq!(run.stderr.lines().count(), 1, "{run:#?}");
    assert!(run.stderr.starts_with("error: ffmpeg was not found on the PATH; "), "{run:#?}");
    assert_eq!(folder.names(), ["a.0001.png", "a.0002.png", "scene.toml"], "nothing stays behind");
}

#[test]
fn wrong_frames_are_named() {
    let folder = Folder::with_scene();
    let run = folder.run(&["video", "none.####.png", "-o", "a.mp4"]).expect(3);
    assert!(run.last_line().contains("none.####.png") && run.last_line().contains("; "), "{run:#?}");
    folder.run(&["video", "scene.toml", "-o", "a.mp4"]).expect(3);
    folder.run(&["video", "a.png", "-o", "a.gif"]).expect(2);
}

#[test]
fn frames_become_a_video() {
    let folder = Folder::with_scene();
    // An odd size, which the format does not have.
    folder.run(&["render", "scene.toml", "--frames", "1-3", "-o", "a.exr", "--size", "41x31"]).expect(0);
    let run = folder.run(&["video", "a.####.exr", "-o", "a.mp4", "--fps", "12", "--view", "agx"]);
    if run.code == Some(1) && run.stderr.contains("not found") {
        #[expect(clippy::print_stderr, reason = "a skipped test says so")]
        {
            eprintln!("skipped: no ffmpeg on the PATH");
        }
        return;
    }
    run.expect(0);
    let video = folder.read("a.mp4");
    assert_eq!(&video[4..8], b"ftyp");
    let place = |box_name: &[u8]| video.windows(4).position(|w| w == box_name).expect("an MP4 has this box");
    assert!(place(b"moov") < place(b"mdat"), "the index is at the front");
}
