//! Real models: counts that their READMEs give, areas that follow from their polygons.

use crate::models::asset_models;
use glam::DVec3;
use heliostat_io::image_file::Limits;
use heliostat_io::model::scene_of;
use heliostat_io::obj::{ObjModel, ObjOptions, load_obj};
use heliostat_io::texture_cache::TextureCache;
use heliostat_scene::texture::Pattern;
use std::path::PathBuf;

/// Loads one of the models; `None` when it is not there.
fn load(ending: &str) -> Option<ObjModel> {
    let path: PathBuf = asset_models().into_iter().find(|path| path.ends_with(ending))?;
    Some(
        load_obj(&path, &ObjOptions::default(), &mut TextureCache::new(Limits::default()))
            .expect("a good file"),
    )
}

fn triangles(model: &ObjModel) -> usize {
    model.objects.iter().map(|object| object.mesh.triangles.len()).sum()
}

#[test]
fn every_model_loads_and_is_valid() {
    for path in asset_models() {
        let model = load_obj(&path, &ObjOptions::default(), &mut TextureCache::new(Limits::default()));
        let model = model.unwrap_or_else(|error| panic!("{error}"));
        for object in &model.objects {
            object.mesh.validate().unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert!(object.materials.iter().all(|&m| m < model.materials.len()));
        }
        let scene = scene_of(&model, "model", 1.5);
        scene.validate().unwrap_or_else(|issues| panic!("{}: {issues:?}", path.display()));
    }
}

#[test]
fn triangle_counts_are_those_of_the_sources() {
    for (name, expected) in [
        ("horse/horse.obj", 96_966),
        ("dragon/dragon.obj", 100_000),
        ("bunny/stanford-bunny.obj", 69_451),
        ("teapot/teapot.obj", 6_320),
        ("spot/spot_triangulated.obj", 5_856),
        ("spot/spot_quadrangulated.obj", 5_856),
        ("suzanne/suzanne.obj", 968),
        ("materialx/teapot.obj", 25_200),
        ("rpt/rustacean.obj", 25_296),
        ("rpt/wine_glass.obj", 16_128),
        ("assimp/concave_polygon.obj", 64),
        ("cornell-box/CornellBox-Original.obj", 36),
    ] {
        if let Some(model) = load(name) {
            assert_eq!(triangles(&model), expected, "{name}");
        }
    }
}

#[test]
fn the_concave_polygon_is_covered_once() {
    let Some(model) = load("assimp/concave_polygon.obj") else {
        return;
    };
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
    let path = asset_models().into_iter().find(|path| path.ends_with("assimp/concave_polygon.obj")).unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    let numbers =
        |line: &str| line.split_whitespace().skip(1).map(|w| w.parse().unwrap()).collect::<Vec<f64>>();
    let points: Vec<_> =
        text.lines().filter(|l| l.starts_with("v ")).map(|l| DVec3::from_slice(&numbers(l))).collect();
    let face = text.lines().find(|l| l.starts_with("f ")).unwrap();
    let index = |w: &str| w.split('/').next().unwrap().parse::<usize>().unwrap() - 1;
    let ring: Vec<_> = face.split_whitespace().skip(1).map(|w| points[index(w)]).collect();
    // The shoelace formula about an arbitrary point.
    let double_area = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b)).sum::<DVec3>();
    let expected = 0.5 * double_area.length();
    let mesh = &model.objects[0].mesh;
    let covered: f64 = (0..mesh.triangles.len() as u32).map(|i| mesh.area(i)).sum();
    assert!((covered - expected).abs() < 1e-6 * expected, "{covered} {expected}");
}

#[test]
fn the_spider_finds_its_textures_behind_windows_paths() {
    let Some(model) = load("assimp/spider.obj") else {
        return;
    };
    assert_eq!(model.objects.len(), 19);
    // One of the five materials of the library is not used.
    assert_eq!(model.textures.len(), 4);
    assert!(model.textures.iter().all(|t| matches!(t.pattern, Pattern::Image { .. })));
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

#[test]
fn the_cornell_box_has_its_parts() {
    let Some(model) = load("cornell-box/CornellBox-Original.obj") else {
        return;
    };
    // The file writes `g` behind the boxes: the short one is in the group of the wall before it.
    let names: Vec<_> = model.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["floor", "ceiling", "backWall", "rightWall", "leftWall", "shortBox", "light"]);
    assert_eq!(model.objects[4].mesh.triangles.len(), 2 + 6 * 2);
    assert_eq!(model.materials.len(), 8);
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

#[test]
fn names_with_blanks_and_foreign_letters_are_found() {
    let Some(model) = load("assimp/box_mat_with_spaces.obj") else {
        return;
    };
    assert_eq!(model.materials[0].name, "Material name with many, many spaces");
}
