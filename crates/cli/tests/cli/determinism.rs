//! The promise: the same scene, settings and version give the same bytes, for any number of threads.

use crate::common::Folder;

#[test]
fn bytes_do_not_depend_on_threads() {
    let folder = Folder::with_scene();
    for (name, threads) in [("a", "1"), ("b", "2"), ("c", "5"), ("d", "1")] {
        let (exr, png) = (format!("{name}.exr"), format!("{name}.png"));
        let outputs = ["-o", exr.as_str(), "-o", png.as_str(), "--aov", "all", "--threads", threads];
        folder.run(&[&["render", "scene.toml"], &outputs[..]].concat()).expect(0);
    }
    for other in ["b", "c", "d"] {
        assert!(folder.read("a.exr") == folder.read(&format!("{other}.exr")), "EXR of {other} differs");
        assert!(folder.read("a.png") == folder.read(&format!("{other}.png")), "PNG of {other} differs");
    }
}

#[test]
fn another_seed_is_another_picture() {
    let folder = Folder::with_scene();
    folder.run(&["render", "scene.toml", "-o", "a.exr"]).expect(0);
    folder.run(&["render", "scene.toml", "-o", "b.exr", "--seed", "7"]).expect(0);
    assert!(folder.read("a.exr") != folder.read("b.exr"));
}

#[test]
fn a_region_has_the_pixels_of_the_whole() {
    let folder = Folder::with_scene();
    let render = |arguments: &[&str]| folder.run(&[&["render", "scene.toml"], arguments].concat()).expect(0);
    render(&["-o", "whole.exr", "--exr-depth", "float"]);
    render(&["-o", "part.exr", "--exr-depth", "float", "--region", "7,3,29,21"]);
    let limits = heliostat_io::image_file::Limits::default();
    let read = |name: &str| heliostat_io::exr_file::read_exr(&folder.file(name), &limits).expect("an EXR");
    let (whole, part) = (read("whole.exr"), read("part.exr"));
    assert_eq!((part.width, part.height), (40, 30));
    assert_eq!((part.window.x0, part.window.y0, part.window.x1, part.window.y1), (7, 3, 29, 21));
    for channel in &part.channels {
        let all = whole.channel(&channel.name).expect("the same channels");
        for y in 3..21 {
            let row = &channel.values[(y - 3) * 22..][..22];
            assert_eq!(row, &all.values[y * 40 + 7..][..22], "channel {} row {y}", channel.name);
        }
    }
}
