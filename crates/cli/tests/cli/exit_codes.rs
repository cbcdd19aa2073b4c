//! The exit codes and the last line on standard error: the promise to scripts and farms.

use crate::common::Folder;

#[test]
fn success_is_0_and_tells_where_the_picture_is() {
    let folder = Folder::with_scene();
    let run = folder.run(&["render", "scene.toml"]).expect(0);
    assert!(run.stdout.contains("Saved: 'scene.png'\n"), "{run:#?}");
    assert!(run.stdout.lines().any(|l| l.starts_with("Time: 00:")), "{run:#?}");
    assert!(folder.read("scene.png").starts_with(b"\x89PNG"));
}

#[test]
fn a_comparison_past_its_limit_is_1() {
    let folder = Folder::with_scene();
    folder.run(&["render", "scene.toml", "-o", "a.exr"]).expect(0);
    folder.run(&["render", "scene.toml", "-o", "b.exr", "--set", "light.key.intensity=40"]).expect(0);
    folder.run(&["compare", "a.exr", "a.exr", "--max", "0"]).expect(0);
    folder.run(&["compare", "a.exr", "b.exr"]).expect(0);
    let run = folder.run(&["compare", "a.exr", "b.exr", "--max", "0.001"]).expect(1);
    assert!(run.last_line().starts_with("error: b.exr: RMSE "), "{run:#?}");
    for metric in ["flip", "max"] {
        folder.run(&["compare", "a.exr", "b.exr", "--max", "0.001", "--metric", metric]).expect(1);
    }
}

#[test]
fn a_wrong_command_line_is_2() {
    let folder = Folder::with_scene();
    let run = folder.run(&["render", "scene.toml", "--sampels", "4"]).expect(2);
    assert_eq!(run.last_line(), "error: unexpected argument '--sampels' found; did you mean `--samples`?");
    folder.run(&[]).expect(2);
}

#[test]
fn a_wrong_scene_is_3_with_line_mark_and_near_name() {
    let folder = Folder::new();
    folder.write("scene.toml", crate::common::SCENE.replacen("fov = 40", "fov_degree = 40", 1));
    let line = 1 + crate::common::SCENE.lines().position(|l| l == "fov = 40").expect("the line is there");
    for command in ["render", "check"] {
        let run = folder.run(&[command, "scene.toml"]).expect(3);
        let last = run.last_line();
        assert!(last.starts_with(&format!("error: scene.toml:{line}:1: ")), "{run:#?}");
        assert!(last.contains("fov_degree") && last.contains("did you mean `fov`?"), "{run:#?}");
        // The line itself, and a mark under the key.
        assert!(run.stderr.contains(&format!("{line} | fov_degree = 40")), "{run:#?}");
        assert!(run.stderr.contains("^^^^^^^^^^"), "{run:#?}");
    }
    assert_eq!(folder.names(), ["scene.toml"]);
}

#[test]
fn an_output_that_cannot_be_written_is_4_before_the_render() {
    let folder = Folder::with_scene();
    let run = folder.run(&["render", "scene.toml", "-o", "none/a.png"]).expect(4);
    assert!(run.last_line().contains("none"), "{run:#?}");
    assert!(!run.stderr.contains("PROGRESS"), "{run:#?}");
    std::fs::create_dir(folder.file("taken.png")).expect("a folder");
    folder.run(&["render", "scene.toml", "-o", "taken.png"]).expect(4);
    folder.run(&["render", "scene.toml", "--stats", "none/stats.json"]).expect(4);
}

#[test]
fn strict_makes_a_missing_texture_an_error() {
    let folder = Folder::new();
    let texture = "\n[[texture]]\nname = \"wood\"\nimage = \"wood.png\"\n";
    let scene = crate::common::SCENE.replace("diffuse = [0.8, 0.2, 0.1]", "diffuse = { texture = \"wood\" }");
    folder.write("scene.toml", scene + texture);
    let run = folder.run(&["render", "scene.toml"]).expect(0);
    assert!(run.stderr.contains("warning: ") && run.stderr.contains("wood.png"), "{run:#?}");
    for command in ["render", "check"] {
        let run = folder.run(&[command, "scene.toml", "--strict"]).expect(3);
        assert!(run.last_line().starts_with("error: ") && run.last_line().contains("wood.png"), "{run:#?}");
    }
    let run = folder.run(&["check", "scene.toml", "--json"]).expect(0);
    let json: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(json["ok"], true);
    assert_eq!(json["findings"][0]["severity"], "warning");
}

#[test]
fn colours_and_unicode_stay_in_terminals() {
    let folder = Folder::new();
    folder.write("scene.toml", "[camera]\nfovv = 1\n");
    let run = folder.run(&["check", "scene.toml"]).expect(3);
    assert!(
        run.stderr.is_ascii() && !run.stderr.contains('\u{1b}') && !run.stderr.contains('\r'),
        "{run:#?}"
    );
}

#[test]
fn check_tells_what_nothing_uses_and_what_stays_black() {
    let folder = Folder::new();
    let unused = "\n[[material]]\nname = \"spare\"\n[material.phong]\ndiffuse = 1.0\n";
    folder.write("scene.toml", crate::common::SCENE.to_owned() + unused);
    let line = crate::common::SCENE.lines().count() + 3;
    let run = folder.run(&["check", "scene.toml"]).expect(0);
    let warning = format!("warning: scene.toml:{line}:8: the material `spare` is not used; ");
    assert!(run.stderr.contains(&warning), "{run:#?}");
    folder.run(&["check", "scene.toml", "--strict"]).expect(3);
    let dark = "[camera]\nposition = [0, 0, 3]\nlook_at = [0, 0, 0]\n[[object]]\nname = \"ball\"\nsphere = { radius = 1 }\n";
    folder.write("dark.toml", dark);
    let run = folder.run(&["check", "dark.toml"]).expect(0);
    assert!(run.stderr.contains("nothing gives light"), "{run:#?}");
}
