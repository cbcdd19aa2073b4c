//! Every scene of the repository loads, validates and renders to finite light, with every camera it names.

use heliostat_tests::scenes;

#[test]
fn every_scene_renders() {
    let scenes = scenes::all().expect("the folder is there");
    assert!(scenes.len() > 20, "only {} scenes found", scenes.len());
    for path in scenes {
        let text = std::fs::read_to_string(&path).expect("readable");
        if text.contains("assets/large/") && !scenes::root().join("assets/large/bird.obj").exists() {
            let error = scenes::render(&path, [16, 9], 1, 0).expect_err("its mesh is missing");
            assert!(error.contains("cargo xtask assets"), "{}: {error}", path.display());
            continue;
        }
        let frame =
            scenes::render(&path, [32, 18], 1, 0).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let values = || frame.channels.iter().filter(|c| "RGB".contains(&c.name)).flat_map(|c| &c.values);
        assert!(values().all(|v| v.is_finite() && *v >= 0.0), "{}", path.display());
        assert!(values().any(|v| *v > 0.0), "{} is black", path.display());
    }
}
