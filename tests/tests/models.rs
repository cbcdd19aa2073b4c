//! Real models, where the checkout has them: they load and render without a setting.

use heliostat_tests::scenes;

#[test]
#[expect(clippy::print_stderr, reason = "a skipped test says so")]
fn every_model_renders_without_settings() {
    let Some(assets) = scenes::foreign_assets() else {
        eprintln!("skipped: no folder of real models");
        return;
    };
    let models = scenes::obj_files(&assets.join("obj"));
    assert!(!models.is_empty());
    for path in models {
        let source = scenes::open(&path, &[]).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let mut shot = source.shot(1).expect("a model has one frame");
        shot.settings.width = 48;
        shot.settings.height = 27;
        shot.settings.samples = 1;
        shot.settings.layers.depth = true;
        let frame = heliostat_render::render(&shot.scene, &shot.settings).expect("renders");
        let hits = frame.channel("Z").map_or(0, |z| z.values.iter().filter(|z| **z < 1e9).count());
        assert!(hits > 48 * 27 / 40, "{}: the model covers only {hits} pixels", path.display());
    }
}
