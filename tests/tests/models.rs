//! Real models, where the checkout has them: they load, render, and their trees agree with brute force.

use heliostat_index::{BruteForce, BspTree, BuildParams, RayIndex};
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
        let frame = heliostat_render::render(&shot.scene, &shot.settings).expect("renders");
        let depth = |name: &str| frame.channel(name).map(|c| c.values.clone()).unwrap_or_default();
        let background = depth("R")[0];
        let seen = depth("R").iter().filter(|v| (**v - background).abs() > 0.01).count();
        assert!(seen > 48 * 27 / 20, "{}: the model covers only {seen} pixels", path.display());
    }
}

#[test]
fn the_tree_of_boxes_finds_what_brute_force_finds() {
    use glam::{Vec3, vec3};
    use heliostat_geometry::{Aabb, Ray};
    let boxes: Vec<Aabb> = (0..50)
        .map(|i| {
            let at = vec3((i * 7 % 13) as f32, (i * 5 % 11) as f32, (i * 3 % 17) as f32);
            Aabb { min: at, max: at + Vec3::splat(1.5) }
        })
        .collect();
    let tree = BspTree::build(&boxes[..], &BuildParams::default()).expect("finite boxes");
    let truth = BruteForce::new(&boxes[..]);
    let enter = |i: u32, ray: &Ray| boxes[i as usize].clip(ray).map(|range| (range.min, ()));
    for i in 0..200 {
        let origin = vec3(-5.0, (i % 20) as f32, (i / 20) as f32 * 2.0);
        let ray = Ray::new(origin, vec3(1.0, 0.013 * i as f32 - 1.0, 0.02));
        let found = tree.closest_hit(&ray, enter).map(|f| (f.primitive, f.t));
        assert_eq!(found, truth.closest_hit(&ray, enter).map(|f| (f.primitive, f.t)));
    }
}
