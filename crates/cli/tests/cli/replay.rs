//! `heliostat index --replay`: files of rays that are right, and files that are wrong.

use crate::common::Folder;

/// A line for the mesh of [`folder`].
const LINE: &str = r#"{"mesh":0,"name":"mesh 0","triangles":2,"seed":0,"number":4711,"origin":[0.25,0.5,1.0],"dir":[0.0,0.0,-1.0],"range":[0.0,null],"index":"fast","expected":{"triangle":0,"t":1.0,"barycentric":[0.5,0.25,0.25]},"got":null,"got_any":false}"#;

/// A square of two triangles, and the file `rays.jsonl`.
fn folder(rays: &str) -> Folder {
    let folder = Folder::new();
    folder.write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    folder.write("rays.jsonl", rays);
    folder
}

#[test]
fn rays_that_agree_are_reported_one_by_one() {
    let passes = LINE.replace("0.25,0.5,1.0", "2.0,0.5,1.0").replace("[0.0,null]", "[0.0,3.5]");
    let folder = folder(&format!("{LINE}\n\n{passes}\n"));
    let run = folder.run(&["index", "square.obj", "--replay", "rays.jsonl"]).expect(0);
    let lines: Vec<&str> = run.stdout.lines().filter(|line| line.starts_with("replay: ")).collect();
    assert_eq!(lines.len(), 3, "{run:#?}");
    assert!(lines[0].starts_with("replay: rays.jsonl:1: mesh 0"), "{run:#?}");
    assert!(lines[0].ends_with("ray 4711, saved for fast: hit, all agree with brute force"), "{run:#?}");
    assert!(lines[1].starts_with("replay: rays.jsonl:3: mesh 0"), "{run:#?}");
    assert!(lines[1].ends_with("ray 4711, saved for fast: no hit, all agree with brute force"), "{run:#?}");
    assert_eq!(lines[2], "replay: 2 rays, all agree with brute force");
}

#[test]
fn json_is_all_that_standard_output_holds() {
    let folder = folder(LINE);
    let arguments = ["index", "square.obj", "--json", "--replay", "rays.jsonl", "--export", "tree.obj"];
    let run = folder.run(&arguments).expect(0);
    let report: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
    let ray = &report["replay"][0];
    assert_eq!((&ray["line"], &ray["number"], &ray["mesh"]), (&1.into(), &4711.into(), &0.into()));
    assert_eq!(
        (&ray["agrees"], &ray["hit"], &ray["saved_for"]),
        (&true.into(), &true.into(), &"fast".into())
    );
}

#[test]
fn nothing_is_saved_where_all_agree() {
    let folder = folder(LINE);
    let before = folder.names();
    folder.run(&["index", "square.obj", "--verify", "500", "--disagreements", "none.jsonl"]).expect(0);
    assert_eq!(folder.names(), before);
    let nowhere = ["index", "square.obj", "--verify", "500", "--disagreements", "none/none.jsonl"];
    folder.run(&nowhere).expect(4);
}

#[test]
fn wrong_files_are_told_with_their_line_and_the_mend() {
    let cut = &LINE[..LINE.len() / 2];
    let with = |from: &str, to: &str| {
        assert!(LINE.contains(from), "{from}");
        LINE.replace(from, to)
    };
    let cases: [(&str, String, &str); 17] = [
        ("cut off", cut.into(), "EOF"),
        ("no JSON", "v 0 0 0".into(), "expected value"),
        ("an unknown key", with("\"seed\"", "\"sed\""), "unknown field `sed`"),
        ("a missing key", with("\"number\":4711,", ""), "missing field `number`"),
        ("a number that is negative", with("4711", "-1"), "invalid value"),
        ("a number beyond 64 bits", with("4711", "99999999999999999999"), "invalid type"),
        ("NaN", with("0.25,0.5", "NaN,0.5"), "expected value"),
        ("NaN as a text", with("0.25,0.5", "\"NaN\",0.5"), "invalid type"),
        ("beyond 64 bits", with("0.25,0.5", "1e999,0.5"), "number out of range"),
        ("beyond 32 bits", with("0.25,0.5", "1e60,0.5"), "finite in 32 bits"),
        ("two coordinates", with("0.25,0.5,1.0", "0.25,0.5"), "invalid length 2"),
        ("no direction", with("[0.0,0.0,-1.0]", "[0.0,0.0,0.0]"), "`dir` not zero"),
        ("an empty range", with("[0.0,null]", "[2.0,1.0]"), "the range is empty"),
        ("an endless range", with("[0.0,null]", "[0.0,1e60]"), "too large for 32 bits"),
        ("a mesh that is not there", with("\"mesh\":0", "\"mesh\":1"), "the scene has 1, from 0"),
        ("another mesh", with("\"triangles\":2", "\"triangles\":3"), "had 3 triangles and has 2 now"),
        ("two rays in one line", format!("{LINE}{LINE}"), "trailing characters"),
    ];
    for (what, line, needle) in cases {
        let run =
            folder(&format!("{LINE}\n{line}\n")).run(&["index", "square.obj", "--replay", "rays.jsonl"]);
        let run = run.expect(3);
        assert!(run.last_line().starts_with("error: rays.jsonl:2:"), "{what}: {run:#?}");
        assert!(run.last_line().contains(needle) && run.last_line().contains("; "), "{what}: {run:#?}");
    }
}

#[test]
fn files_without_rays_are_told() {
    for (content, needle) in [(&b""[..], "no rays"), (b"\n \n", "no rays"), (b"\xe4", "no text in UTF-8")] {
        let folder = folder("");
        folder.write("rays.jsonl", content);
        let run = folder.run(&["index", "square.obj", "--replay", "rays.jsonl"]).expect(3);
        assert!(
            run.last_line().starts_with("error: rays.jsonl: ") && run.last_line().contains(needle),
            "{run:#?}"
        );
        assert!(run.last_line().ends_with("; name a file that `--verify` saved"), "{run:#?}");
    }
    let folder = folder("");
    folder.run(&["index", "square.obj", "--replay", "none.jsonl"]).expect(3);
    folder.run(&["index", "square.obj", "--replay", "rays.jsonl", "--verify", "10"]).expect(2);
    folder.run(&["index", "square.obj", "--disagreements", "a.jsonl"]).expect(2);
}
