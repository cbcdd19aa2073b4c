//! Files that a scene names: relative to it, shared, missed by name.

use crate::support::{Folder, set};
use heliostat_io::{OpenOptions, open};
use heliostat_scene::TextureId;
use heliostat_scene::image::Encoding;
use heliostat_scene::material::{Relief, Surface};
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::texture::Pattern;
use std::sync::Arc;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn grey(folder: &Folder, name: &str) {
    let path = folder.write(name, "");
    image::GrayImage::from_pixel(2, 2, image::Luma([128])).save(path).unwrap();
}

#[test]
fn paths_are_relative_to_the_scene_file() {
    let folder = Folder::new();
    folder.write("shapes/triangle.obj", TRIANGLE);
    let scene =
        "camera = {}\nmesh = [{ name = 'm', file = '../shapes/triangle.obj' }]\nobject = [{ mesh = 'm' }]";
    let source = open(&folder.write("scenes/a.toml", scene), &OpenOptions::default()).unwrap();
    let shot = source.shot(1).unwrap();
    assert_eq!(shot.scene.meshes[0].triangles.len(), 1);
    assert!(matches!(shot.scene.objects[0].geometry, Geometry::Mesh(id) if id.index() == 0));
}

#[test]
fn all_frames_share_meshes_and_images() {
    let folder = Folder::new();
    folder.write("t.obj", TRIANGLE);
    grey(&folder, "a.png");
    let source = folder
        .open(
            "camera = {}
             texture = [{ name = 't', image = 'a.png' }, { name = 'u', image = 'a.png', wrap = 'clamp' }]
             mesh = [{ name = 'm', file = 't.obj' }]
             model = [{ file = 't.obj' }]
             animation = [{ target = 'model.t.translate.1', keys = [[0, 0], [1, 1]] }]
             [environment]\nimage = 'a.png'",
            &OpenOptions::default(),
        )
        .unwrap();
    let (first, last) = (source.shot(1).unwrap().scene, source.shot(25).unwrap().scene);
    assert_ne!(first.objects[0].motion, last.objects[0].motion);
    assert_eq!(first.meshes.len(), 2);
    for (a, b) in first.meshes.iter().zip(&last.meshes) {
        assert!(Arc::ptr_eq(a, b));
    }
    let image = |pattern: &Pattern| match pattern {
        Pattern::Image { image, .. } => Arc::clone(image),
        other => panic!("{other:?}"),
    };
    let shared = image(&first.textures[0].pattern);
    assert!(Arc::ptr_eq(&shared, &image(&first.textures[1].pattern)), "one file, one image");
    assert!(Arc::ptr_eq(&shared, &image(&last.textures[0].pattern)));
    assert!(matches!(&last.background, Background::Image { image, .. } if Arc::ptr_eq(image, &shared)));
}

#[test]
fn a_missing_mesh_is_an_error_at_its_name() {
    let folder = Folder::new();
    folder.write("bunny.obj", TRIANGLE);
    let error = |scene: &str| {
        let source = folder.open(scene, &OpenOptions::default()).unwrap();
        source.shot(1).unwrap_err().to_string().replace(&*folder.write("x", "").to_string_lossy(), "x")
    };
    let text = error("camera = {}\n[[mesh]]\nname = 'm'\nfile = 'buny.obj'\n");
    assert!(
        text.ends_with("scene.toml:4:8: `buny.obj`: file not found; did you mean `bunny.obj`?"),
        "{text}"
    );
    let text = error("camera = {}\n[[model]]\nmade_by = 'cargo xtask assets'\nfile = 'zzz.obj'\n");
    assert!(
        text.ends_with("scene.toml:4:8: `zzz.obj`: file not found; make it with `cargo xtask assets`"),
        "{text}"
    );
}

#[test]
fn a_damaged_mesh_is_told_at_its_own_place() {
    let folder = Folder::new();
    folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
    folder.write("empty.obj", "v 0 0 0\n");
    let error = |file: &str| {
        let scene = format!("camera = {{}}\nmesh = [{{ name = 'm', file = '{file}' }}]");
        folder.open(&scene, &OpenOptions::default()).unwrap().shot(1).unwrap_err()
    };
    let damaged = error("bad.obj");
    assert!(damaged.report().path.ends_with("bad.obj"), "{damaged}");
    assert_eq!(damaged.report().place.as_ref().unwrap().line, 2);
    let empty = error("empty.obj");
    assert!(empty.report().path.ends_with("scene.toml"), "{empty}");
    assert_eq!(empty.report().message, "`empty.obj`: holds no faces: there is nothing to draw");
}

#[test]
fn a_missing_image_is_a_warning_and_magenta() {
    let folder = Folder::new();
    folder.write("broken.png", b"\x89PNG\r\n\x1a\nnothing");
    let scene = "camera = {}\nenvironment.image = 'sky.hdr'\n[[texture]]\nname = 't'\nimage = 'wood.png'\n\
                 [[texture]]\nname = 'u'\nimage = 'broken.png'\nmade_by = 'make'\n";
    let shot = folder.open(scene, &OpenOptions::default()).unwrap().shot(1).unwrap();
    assert_eq!(shot.scene.textures[0].pattern, Pattern::Missing);
    assert_eq!(shot.scene.textures[1].pattern, Pattern::Missing);
    assert_eq!(shot.scene.background, Background::Constant(glam::Vec3::new(1.0, 0.0, 1.0)));
    let places: Vec<_> =
        shot.warnings.iter().map(|w| w.report().place.as_ref().map(|p| p.line).unwrap()).collect();
    assert_eq!(places, [5, 8, 2]);
    assert!(shot.warnings[0].report().message.starts_with("`wood.png`: "), "{}", shot.warnings[0]);
}

#[test]
fn maps_of_numbers_are_read_as_they_are_and_colours_as_srgb() {
    let folder = Folder::new();
    grey(&folder, "a.png");
    let path = folder.write("leaf.png", "");
    image::RgbaImage::from_pixel(2, 2, image::Rgba([9, 99, 9, 50])).save(path).unwrap();
    let scene = "camera = {}
        texture = [{ name = 't', image = 'a.png' }, { name = 's', image = 'a.png', encoding = 'srgb' },
                   { name = 'leaf', image = 'leaf.png' }]
        [[material]]\nname = 'm'\nphong.diffuse = { texture = 't' }\nphong.shininess = { texture = 't' }
        normal_map = { texture = 's' }\nopacity = { texture = 't' }
        [[material]]\nname = 'n'\nphong.diffuse = { texture = 'leaf' }\nopacity = { texture = 'leaf' }\n";
    let shot = folder.open(scene, &OpenOptions::default()).unwrap().shot(1).unwrap();
    let encoding = |id: Option<TextureId>| match &shot.scene.textures[id.unwrap().index()].pattern {
        Pattern::Image { image, .. } => image.encoding,
        other => panic!("{other:?}"),
    };
    let [material, leaf] = &shot.scene.materials[..] else { panic!() };
    let Surface::Phong(phong) = &material.surface else { panic!("not the report\'s surface") };
    assert_eq!(encoding(phong.diffuse.texture), Encoding::Srgb);
    assert_eq!(encoding(phong.shininess.texture), Encoding::Linear);
    assert_eq!(encoding(material.opacity.texture), Encoding::Linear, "a mask without alpha");
    let Some(Relief::Normal { texture, .. }) = material.relief else { panic!() };
    assert_eq!(encoding(Some(texture)), Encoding::Srgb, "the file says so");
    let Surface::Phong(phong) = &leaf.surface else { panic!("not the report\'s surface") };
    assert_eq!(leaf.opacity.texture, phong.diffuse.texture, "alpha has no encoding");
}

#[test]
fn models_are_objects_with_their_own_names_and_materials() {
    let folder = Folder::new();
    folder.write("m.mtl", "newmtl clay\nKd 1 0 0\n");
    folder.write(
        "house.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl clay\ng door\nf 1 2 3\ng roof\nf 1 3 2\n",
    );
    let scene = "camera = {}\nmaterial = [{ name = 'own' }]\nobject = [{ name = 'ball', sphere = { radius = 1 } }]
        model = [{ file = 'house.obj' }, { name = 'second', file = 'house.obj', material = 'own', visible = false }]";
    let shot = folder.open(scene, &OpenOptions::default()).unwrap().shot(1).unwrap();
    let names: Vec<_> = shot.scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["ball", "house/door", "house/roof", "second/door", "second/roof"]);
    let material = |i: usize| shot.scene.materials[shot.scene.objects[i].material(0).index()].name.as_str();
    assert_eq!((material(0), material(1), material(3)), ("default", "house/clay", "own"));
    assert!(shot.scene.objects[1].visible && !shot.scene.objects[3].visible);
    assert_eq!(shot.scene.validate(), Ok(()));
}

#[test]
fn a_material_without_a_slot_is_told() {
    let folder = Folder::new();
    folder.write("t.obj", TRIANGLE);
    let scene = "camera = {}\nmaterial = [{ name = 'a' }, { name = 'b' }]\nmesh = [{ name = 'm', file = 't.obj' }]\n\
                 object = [{ mesh = 'm', materials = ['a', 'b'] }]";
    let shot = folder.open(scene, &OpenOptions::default()).unwrap().shot(1).unwrap();
    assert_eq!(shot.warnings.len(), 1);
    let report = shot.warnings[0].report();
    assert_eq!(report.message, "this material is not used: the object has room for 1");
    let place = report.place.as_ref().unwrap();
    assert_eq!((place.line, &place.excerpt[place.span.clone()]), (4, "'b'"));
}

#[test]
fn a_mesh_does_not_ask_for_its_material_library() {
    let folder = Folder::new();
    folder.write("t.obj", format!("mtllib missing.mtl\nusemtl red\n{TRIANGLE}"));
    let warnings = |scene: &str| {
        let source = folder.open(&format!("camera = {{}}\n{scene}"), &OpenOptions::default()).unwrap();
        source.shot(1).unwrap().warnings.len()
    };
    assert_eq!(warnings("mesh = [{ name = 'm', file = 't.obj' }]"), 0);
    assert_eq!(warnings("material = [{ name = 'a' }]\nmodel = [{ file = 't.obj', material = 'a' }]"), 0);
    assert_eq!(warnings("model = [{ file = 't.obj' }, { name = 'again', file = 't.obj' }]"), 1);
}

#[test]
fn a_lone_model_is_a_scene() {
    let folder = Folder::new();
    let path = folder.write("t.obj", TRIANGLE);
    let options = set(&[("render.width", "30"), ("render.integrator", "normals"), ("output.exposure", "2")]);
    let source = open(&path, &options).unwrap();
    assert_eq!(source.camera_names(), ["fitted"]);
    assert_eq!(source.frames(), None);
    let shot = source.shot(1).unwrap();
    assert_eq!(shot.scene.validate(), Ok(()));
    assert_eq!((shot.settings.width, shot.settings.height), (30, 540));
    assert_eq!(shot.view.exposure, 2.0);
    let error = open(&path, &set(&[("object.t.scale", "3")])).unwrap_err();
    assert!(error.to_string().starts_with("--set:1:1: "), "{error}");
    let named = OpenOptions { camera: Some("fited".to_owned()), ..OpenOptions::default() };
    let error = open(&path, &named).unwrap().shot(1).unwrap_err();
    assert_eq!(error.to_string(), "--camera:1:1: unknown camera `fited`; did you mean `fitted`?");
}

#[test]
fn files_that_are_no_scenes_are_named() {
    let folder = Folder::new();
    let path = folder.write("latin.toml", b"# caf\xe9\n");
    assert!(
        open(&path, &OpenOptions::default())
            .unwrap_err()
            .to_string()
            .ends_with("line 1 is not UTF-8; save the file as UTF-8")
    );
    let missing = path.with_file_name("none.toml");
    assert!(open(&missing, &OpenOptions::default()).unwrap_err().to_string().contains("file not found"));
}

/// A triangle in a glTF file of its own, three metres up by its node.
const GLTF_TRIANGLE: &str = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "translation": [0, 3, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}], "materials": [{"name": "red"}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri":
        "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;

#[test]
fn gltf_models_are_placed_as_one_group() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.gltf"), GLTF_TRIANGLE).unwrap();
    let text = "camera = { look_at = 'a' }\n[[material]]\nname = 'red'\n[[model]]\nfile = 'a.gltf'\n\
        translate = [5, 0, 0]\n[[model]]\nname = 'clay'\nfile = 'a.gltf'\nmaterial = 'red'\nvisible = false\n";
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    let scene = open(&path, &Default::default()).unwrap().shot(1).unwrap().scene;
    assert_eq!(scene.validate(), Ok(()));
    assert_eq!((scene.objects.len(), scene.groups.len()), (2, 2));
    assert_eq!(scene.objects[0].name, "a");
    assert!(scene.objects[0].visible && !scene.objects[1].visible);
    let materials = |group: usize| scene.groups[group].objects[0].materials[0].index();
    assert_eq!(scene.materials[materials(0)].name, "a/red");
    assert_eq!(scene.materials[materials(1)].name, "red");
    assert!(matches!(scene.natural_integrator(), heliostat_scene::settings::IntegratorKind::Path));
    // Where the model stands and where its node stands, together; the camera looks at the middle of the box.
    let place = scene.objects[0].motion.first().matrix() * scene.groups[0].objects[0].motion.first().matrix();
    assert_eq!(place.translation, glam::DVec3::new(5.0, 3.0, 0.0));
    let view = -scene.cameras[0].motion.first().matrix3.z_axis;
    assert!(view.distance(glam::DVec3::new(5.5, 3.5, 0.0).normalize()) < 1e-6, "{view}");
    let refused = format!("{text}smooth_angle = 30\n");
    std::fs::write(&path, refused).unwrap();
    let error = open(&path, &Default::default()).and_then(|s| s.shot(1)).unwrap_err();
    assert!(error.to_string().contains("`smooth_angle` has no effect on a glTF model"), "{error}");
}
