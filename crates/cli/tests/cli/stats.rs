//! `--stats` and `--progress`: what programs read.

use crate::common::Folder;
use serde_json::Value;

#[test]
fn stats_has_its_keys_and_its_sums_are_right() {
    let folder = Folder::with_scene();
    folder
        .run(&["render", "scene.toml", "--frames", "1-2", "--stats", "stats.json", "--threads", "2"])
        .expect(0);
    let stats: Value = serde_json::from_slice(&folder.read("stats.json")).expect("JSON");
    assert_eq!(stats["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(stats["scene"], "scene.toml");
    assert_eq!(stats["threads"], 2);
    assert_eq!(stats["interrupted"], false);
    for phase in ["load", "prepare", "trace", "resolve", "save", "total"] {
        assert!(stats["seconds"][phase].as_f64().is_some_and(|s| s >= 0.0), "{phase}: {stats:#}");
    }
    let rays = &stats["rays"];
    let ray = |kind: &str| rays[kind].as_u64().unwrap_or_else(|| panic!("{kind}: {stats:#}"));
    assert_eq!(ray("camera"), 2 * 40 * 30 * 2, "frames x width x height x samples");
    let kinds = ["camera", "reflection", "scatter", "refraction", "shadow", "ambient_occlusion"];
    assert_eq!(kinds.iter().map(|kind| ray(kind)).sum::<u64>(), ray("total"));
    assert!(ray("refraction") > 0 && ray("shadow") > 0);
    assert!(stats["rays_per_second"].as_f64().is_some_and(|r| r > 0.0));
    assert!(stats["index"].is_array());
    #[cfg(target_os = "linux")]
    assert!(stats["peak_memory_bytes"].as_u64().is_some_and(|b| b > 100_000));
    let frames = stats["frames"].as_array().expect("frames");
    assert_eq!(frames.len(), 2);
    assert_eq!(frames[1]["frame"], 2);
    assert_eq!(frames[1]["outputs"][0], "scene.0002.png");
    let of_frames: u64 = frames.iter().filter_map(|f| f["rays"]["total"].as_u64()).sum();
    assert_eq!(of_frames, ray("total"));
}

#[test]
fn progress_lines_end_at_100() {
    let folder = Folder::with_scene();
    let run = |how: &str| folder.run(&["render", "scene.toml", "--progress", how]).expect(0);
    assert_eq!(run("auto").last_line(), "PROGRESS: 100%");
    assert_eq!(run("bar").last_line(), "PROGRESS: 100%");
    assert_eq!(run("alf").last_line(), "ALF_PROGRESS 100%");
    assert_eq!(run("none").stderr, "");
    let json = run("json");
    let events: Vec<Value> =
        json.stderr.lines().map(|l| serde_json::from_str(l).unwrap_or_else(|e| panic!("{l}: {e}"))).collect();
    let last = events.iter().rfind(|e| e["event"] == "progress").expect("progress");
    assert_eq!(last["percent"], 100);
    assert!(events.iter().any(|e| e["event"] == "saved" && e["path"] == "scene.png"));
}
