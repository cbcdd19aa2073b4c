//! Whole scenes from models of a few lines.

use super::*;
use crate::obj::{DiskFiles, parse_obj};
use heliostat_scene::light::LightKind;
use heliostat_scene::scene::Background;

/// A box without its front, `size` metres wide, with a lamp of radiance `ke` under the ceiling.
fn room(size: f32, ke: f32) -> ObjModel {
    let folder = tempfile::tempdir().expect("a folder");
    let mtl = format!("newmtl lamp\nKe {ke} {ke} {ke}\nnewmtl wall\nKd .7 .7 .7\n");
    std::fs::write(folder.path().join("room.mtl"), mtl).expect("a file");
    let mut text = "mtllib room.mtl\n".to_owned();
    for (x, y, z) in [
        (0., 0., 0.),
        (1., 0., 0.),
        (1., 0., 1.),
        (0., 0., 1.),
        (0., 1., 0.),
        (1., 1., 0.),
        (1., 1., 1.),
        (0., 1., 1.),
    ] {
        text += &format!("v {} {} {}\n", size * x, size * y, size * z);
    }
    for (x, z) in [(0.4, 0.4), (0.6, 0.4), (0.6, 0.6), (0.4, 0.6)] {
        text += &format!("v {} {} {}\n", size * x, 0.99 * size, size * z);
    }
    text += "usemtl wall\ng walls\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 1 5 8 4\nf 2 3 7 6\ng lamp\nusemtl lamp\nf 9 10 11 12\n";
    let mut textures = TextureCache::with_reader(|path| Err(LoadError::new(path, "no image")));
    let mut files = DiskFiles::new(&mut textures, 1 << 20);
    parse_obj(&folder.path().join("room.obj"), text.as_bytes(), &ObjOptions::default(), &mut files)
        .expect("a room")
}

#[test]
fn a_lit_room_is_seen_from_its_open_side_by_its_own_light() {
    for size in [1e-2, 2.0, 1e4] {
        let scene = scene_of(&room(size, 12.0), "room", 1.5);
        let pose = scene.cameras[0].motion.first();
        assert_eq!(pose.matrix3.z_axis, DVec3::Z);
        assert!(pose.translation.z > f64::from(size));
        assert!(scene.lights.iter().all(|light| matches!(light.kind, LightKind::Ambient)), "{size}");
        assert_eq!(scene.background, Background::default());
        // The flux of the lamp over the six sides of its box, nearly a cube.
        let expected = (0.3 / (12.0 * std::f32::consts::PI * 0.04 / 6.0)).log2();
        assert!((exposure_of(&scene) - expected).abs() < 1e-3, "{size}");
    }
}

#[test]
fn a_dark_room_gets_a_light_under_its_ceiling() {
    let scene = scene_of(&room(3.0, 0.0), "room", 1.5);
    let area = scene.lights.iter().find_map(|light| match &light.kind {
        LightKind::Area { transform, .. } => Some(transform),
        _ => None,
    });
    let transform = area.expect("an area light");
    assert!(transform.normal(Vec3::Y).y < -0.999);
    assert!(transform.point(Vec3::ZERO).distance(Vec3::new(1.5, 2.91, 1.5)) < 1e-5);
    assert_eq!(exposure_of(&scene), 0.0);
}

#[test]
fn objects_without_a_name_get_that_of_the_file_once() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\ng spot\nf 1 3 2";
    let mut textures = TextureCache::with_reader(|path| Err(LoadError::new(path, "no image")));
    let mut files = DiskFiles::new(&mut textures, 1 << 20);
    let model = parse_obj(Path::new("spot.obj"), text, &ObjOptions::default(), &mut files).expect("a model");
    let scene = scene_of(&model, "spot", 1.0);
    let names: Vec<_> = scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["spot.2", "spot"]);
    scene.validate().expect("a valid scene");
}
