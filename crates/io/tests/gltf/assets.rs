//! Real models: all of them load, and some are what their folders say.

use heliostat_geometry::Aabb;
use heliostat_io::gltf::{GltfModel, Moment};
use heliostat_io::model::complete_gltf;
use heliostat_scene::material::{Standard, Surface};
use heliostat_scene::{Census, Scene};
use std::path::{Path, PathBuf};

/// The folder of real models, if it is there.
fn folder() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets");
    let root = std::env::var_os("HELIOSTAT_ASSETS").map_or(beside, PathBuf::from).join("gltf");
    if root.is_dir() {
        return Some(root);
    }
    #[expect(clippy::print_stderr, reason = "a skipped test says so")]
    {
        eprintln!("skipped: no models in {}", root.display());
    }
    None
}

/// The path of a real model, if it is there.
pub(crate) fn asset(name: &str) -> Option<PathBuf> {
    folder().map(|folder| folder.join(name)).filter(|path| path.is_file())
}

fn scene(name: &str, moment: &Moment) -> Option<Scene> {
    let model = GltfModel::open(&asset(name)?).unwrap_or_else(|error| panic!("{error}"));
    Some(model.scene(moment).unwrap_or_else(|error| panic!("{error}")).0)
}

fn triangles(scene: &Scene) -> u64 {
    let census = Census::new(scene).expect("groups that can be counted");
    scene.objects.iter().map(|object| census.object(scene, object).triangles).sum()
}

fn bounds(scene: &Scene) -> Aabb {
    let of = |o: &heliostat_scene::Object| match o.geometry {
        heliostat_scene::object::Geometry::Mesh(id) => o.motion.bounds(scene.meshes[id.index()].bounds()),
        _ => Aabb::EMPTY,
    };
    scene.objects.iter().map(of).fold(Aabb::EMPTY, Aabb::union)
}

fn standard<'s>(scene: &'s Scene, material: &str) -> &'s Standard {
    let found = scene.materials.iter().find(|m| m.name == material);
    match found.map(|material| &material.surface) {
        Some(Surface::Standard(standard)) => standard,
        other => panic!("{material}: {other:?}"),
    }
}

#[test]
fn every_model_loads_and_is_valid() {
    let folders = folder().into_iter().flat_map(|folder| folder.read_dir().expect("a folder")).flatten();
    let files = folders.flat_map(|folder| folder.path().read_dir().into_iter().flatten()).flatten();
    let is_model = |path: &PathBuf| path.extension().is_some_and(|e| e == "gltf" || e == "glb");
    for path in files.map(|file| file.path()).filter(is_model) {
        let model = GltfModel::open(&path).unwrap_or_else(|error| panic!("{error}"));
        let moment = Moment { seconds: 0.3, shutter: 0.02, ..Moment::default() };
        let (mut scene, warnings) = model.scene(&moment).unwrap_or_else(|error| panic!("{error}"));
        complete_gltf(&mut scene, 1.5);
        scene.validate().unwrap_or_else(|issues| panic!("{}: {issues:?}", path.display()));
        assert!(triangles(&scene) > 0, "{}", path.display());
        let expects_warnings = path.ends_with("MeshPrimitiveModes.gltf");
        assert_eq!(expects_warnings, !warnings.is_empty(), "{}: {warnings:?}", path.display());
    }
}

#[test]
fn triangle_counts_are_those_of_the_files() {
    for (name, expected) in [
        ("Box/Box.glb", 12),
        ("BoxInterleaved/BoxInterleaved.glb", 12),
        ("MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb", 1_040_409),
        ("SimpleInstancing/SimpleInstancing.gltf", 125 * 12),
        ("Triangle/Triangle.gltf", 1),
        ("TriangleWithoutIndices/TriangleWithoutIndices.gltf", 1),
        // A list of 18 corners, a strip of 6 and a fan of 8.
        ("MeshPrimitiveModes/MeshPrimitiveModes.gltf", 6 + 4 + 6),
    ] {
        if let Some(scene) = scene(name, &Moment::default()) {
            assert_eq!(triangles(&scene), expected, "{name}");
        }
    }
}

#[test]
fn shared_accessors_are_read_once() {
    let name = "MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb";
    let Some(scene) = scene(name, &Moment::default()) else { return };
    let kept: usize = scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    assert!(kept < 20_000, "{kept}");
}

#[test]
fn skins_bend_and_morphs_move_as_time_goes_by() {
    let at = |seconds| Moment { seconds, ..Moment::default() };
    let (Some(still), Some(bent)) =
        (scene("SimpleSkin/SimpleSkin.gltf", &at(0.0)), scene("SimpleSkin/SimpleSkin.gltf", &at(1.0)))
    else {
        return;
    };
    // A sheet of one by two; after a second its upper half lies on its side.
    assert_eq!(bounds(&still).size().to_array(), [1.0, 2.0, 0.0]);
    assert!(bounds(&bent).size().x > 1.2 && bounds(&bent).size().y < 1.9, "{:?}", bounds(&bent));
    let Some(morph) = scene("SimpleMorph/SimpleMorph.gltf", &at(1.0)) else { return };
    assert!(bounds(&morph).max.y > 1.0, "{:?}", bounds(&morph));
}

#[test]
fn materials_have_the_values_of_their_extensions() {
    let usual = Moment::default();
    if let Some(scene) = scene("EmissiveStrengthTest/EmissiveStrengthTest.glb", &usual) {
        let brightest = |m: &heliostat_scene::Material| m.surface.emission().factor.max_element();
        // The colour of all is (0.1, 0.5, 0.9), the strongest gives it off sixteen times.
        assert_eq!(scene.materials.iter().map(brightest).fold(0.0, f32::max), 0.9 * 16.0);
    }
    if let Some(scene) = scene("UnlitTest/UnlitTest.glb", &usual) {
        assert!(scene.materials.iter().all(|m| matches!(m.surface, Surface::Unlit(_))));
    }
    if let Some(scene) =
        scene("GlamVelvetSofa/GlamVelvetSofa.glb", &Moment { variant: Some(0), ..usual.clone() })
    {
        let fabric = standard(&scene, "GlamVelvetSofa_fabric_champagne");
        assert!(fabric.sheen_color.factor.max_element() > 0.0 && fabric.sheen_roughness.factor > 0.0);
    }
    if let Some(scene) = scene("ToyCar/ToyCar.gltf", &usual) {
        let glass = standard(&scene, "Glass");
        assert!(glass.transmission.factor > 0.0 && glass.thin_walled);
        assert!(standard(&scene, "ToyCar").coat.factor > 0.0);
        assert_eq!(scene.cameras.len(), 8);
    }
}
