//! Every feature of OBJ and MTL with a file of a few lines.

use crate::memory::MemoryFiles;
use glam::{Vec2, Vec3};
use heliostat_io::obj::{ObjModel, ObjOptions, Split, parse_obj};
use heliostat_scene::material::{Back, FresnelMode, Phong, Relief, Surface};
use heliostat_scene::texture::{Pattern, Wrap};
use heliostat_scene::{Material, Rgb};
use std::path::Path;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn read(text: &str) -> ObjModel {
    read_with(text.as_bytes(), &ObjOptions::default(), &mut MemoryFiles::default())
}

fn read_with(bytes: &[u8], options: &ObjOptions, files: &mut MemoryFiles) -> ObjModel {
    parse_obj(Path::new("a.obj"), bytes, options, files).expect("a good file")
}

fn error(text: &str) -> String {
    let read =
        parse_obj(Path::new("a.obj"), text.as_bytes(), &ObjOptions::default(), &mut MemoryFiles::default());
    read.expect_err("a bad file").to_string()
}

/// The material of a square, and the warnings.
fn material(mtl: &str) -> (Material, ObjModel) {
    let mut files = MemoryFiles::default();
    files.library("a.mtl", format!("newmtl m\n{mtl}"));
    files.image("wood.png", 3, &[10, 200, 30, 250, 20, 90]);
    files.image("relief.png", 1, &[0, 255]);
    files.image("bumps.png", 3, &[128, 128, 255, 120, 130, 240]);
    let text = format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3 4");
    let model = read_with(text.as_bytes(), &ObjOptions::default(), &mut files);
    (model.materials[0].clone(), model)
}

fn phong(mtl: &str) -> Phong {
    let Surface::Phong(phong) = material(mtl).0.surface else { panic!("not the report\'s surface") };
    phong
}

fn corners(model: &ObjModel, object: usize, triangle: u32) -> [Vec3; 3] {
    model.objects[object].mesh.corners(triangle)
}

#[test]
fn a_square_becomes_two_triangles_with_a_normal() {
    let model = read(&format!("{SQUARE}f 1 2 3 4"));
    let mesh = &model.objects[0].mesh;
    assert_eq!(mesh.triangles.len(), 2);
    assert_eq!(mesh.normals, [Vec3::Z; 4]);
    assert!(mesh.uvs.is_empty() && mesh.colors.is_empty() && mesh.slots.is_empty());
    assert_eq!(model.warnings, []);
    assert_eq!(model.materials[0].name, "default");
    mesh.validate().unwrap();
}

#[test]
fn negative_indices_count_from_the_end() {
    let model = read(&format!("{SQUARE}f -4 -3 -2\nv 9 9 9\nf -5 -4 -3"));
    assert_eq!(corners(&model, 0, 0), [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0)]);
    assert_eq!(corners(&model, 0, 1), corners(&model, 0, 0));
}

#[test]
fn faces_may_come_before_their_vertices() {
    let model = read(&format!("f 1 2 3\n{SQUARE}"));
    assert_eq!(corners(&model, 0, 0), [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0)]);
}

#[test]
fn objects_and_groups_become_objects_with_both_names() {
    let text =
        format!("{SQUARE}f 1 2 3\no car\nf 1 2 3\ng wheel\nf 1 2 4\no bus\nf 1 2 3\no car\ng wheel\nf 2 3 4");
    let model = read(&text);
    let names: Vec<_> = model.objects.iter().map(|o| (o.name.as_str(), o.mesh.triangles.len())).collect();
    assert_eq!(names, [("", 1), ("car", 1), ("car/wheel", 2), ("bus", 1)]);
}

#[test]
fn a_whole_file_can_be_one_mesh() {
    let options = ObjOptions { split: Split::Whole, ..ObjOptions::default() };
    let text = format!("{SQUARE}o a\nusemtl x\nf 1 2 3\no b\nusemtl y\nf 1 2 4\nusemtl x\nf 2 3 4");
    let model = read_with(text.as_bytes(), &options, &mut MemoryFiles::default());
    assert_eq!(model.objects.len(), 1);
    assert_eq!(model.objects[0].mesh.slots, [0, 1, 0]);
    assert_eq!(model.objects[0].materials, [0, 1]);
}

#[test]
fn materials_become_slots_in_the_order_of_use() {
    let mut files = MemoryFiles::default();
    files.library("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl unused\nmap_Kd nowhere.png\nnewmtl blue\nKd 0 0 1");
    let text =
        format!("mtllib a.mtl\n{SQUARE}usemtl blue\nf 1 2 3\nusemtl red\nf 1 2 4\nusemtl blue\nf 2 3 4");
    let model = read_with(text.as_bytes(), &ObjOptions::default(), &mut files);
    let object = &model.objects[0];
    assert_eq!(object.mesh.slots, [0, 1, 0]);
    let names: Vec<_> = object.materials.iter().map(|&m| model.materials[m].name.as_str()).collect();
    assert_eq!(names, ["blue", "red"]);
    assert_eq!((model.materials.len(), model.warnings.len()), (2, 0));
}

#[test]
fn texture_coordinates_of_one_to_three_numbers_are_read() {
    let model = read(&format!("{SQUARE}vt 0.5\nvt 0.25 0.75\nvt 1 2 3\nf 1/1 2/2 3/3"));
    assert_eq!(model.objects[0].mesh.uvs, [Vec2::new(0.5, 0.0), Vec2::new(0.25, 0.75), Vec2::new(1.0, 2.0)]);
}

#[test]
fn corners_with_the_same_indices_share_a_vertex() {
    let text = format!(
        "{SQUARE}vt 0 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/1/1\nf 1/2/1 2/1/1 3/1/1"
    );
    assert_eq!(read(&text).objects[0].mesh.positions.len(), 5);
}

#[test]
fn vertex_colours_are_decoded_and_may_be_partial() {
    let model = read("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 0 0 0 1\nf 1 2 3");
    let half = heliostat_scene::color::srgb_to_linear(0.5);
    assert_eq!(model.objects[0].mesh.colors, [Vec3::new(1.0, half, 0.0), Vec3::ONE, Vec3::ZERO]);
}

#[test]
fn vertex_colours_up_to_255_are_bytes() {
    let model = read("v 0 0 0 255 0 0\nv 1 0 0 0 255 0\nv 0 1 0 0 0 255\nf 1 2 3");
    assert_eq!(model.objects[0].mesh.colors, [Vec3::X, Vec3::Y, Vec3::Z]);
}

#[test]
fn weights_of_vertices_are_left_out() {
    let model = read("v 0 0 0 1\nv 2 0 0 0\nv 0 2 0 0.5\nf 1 2 3");
    assert_eq!(corners(&model, 0, 0), [Vec3::ZERO, 2.0 * Vec3::X, 2.0 * Vec3::Y]);
    assert!(model.objects[0].mesh.colors.is_empty());
}

/// Two squares that share an edge and stand at `degrees` to each other.
fn folded(degrees: f32, between: &str) -> String {
    let (sin, cos) = degrees.to_radians().sin_cos();
    format!(
        "v 0 0 0\nv 0 0 -1\nv -1 0 0\nv -1 0 -1\nv {cos} {sin} 0\nv {cos} {sin} -1\nf 3 1 2 4\n{between}\nf 1 5 6 2"
    )
}

#[test]
fn edges_below_the_angle_are_smooth() {
    for (degrees, is_smooth) in [(10.0_f32, true), (59.0, true), (61.0, false), (90.0, false), (150.0, false)]
    {
        let model = read(&folded(degrees, ""));
        let mesh = &model.objects[0].mesh;
        assert_eq!(mesh.positions.len(), if is_smooth { 6 } else { 8 }, "{degrees}");
        let at_edge: Vec<_> = (0..mesh.positions.len()).filter(|&i| mesh.positions[i].x == 0.0).collect();
        // Both squares have a right angle at the edge: the mean halves the angle between them.
        let half = (0.5 * degrees).to_radians();
        let mean = Vec3::new(-half.sin(), half.cos(), 0.0);
        for i in at_edge {
            let error = mesh.normals[i].distance(mean);
            assert_eq!(error < 1e-6, is_smooth, "{degrees}: {error}");
        }
    }
}

#[test]
fn the_angle_is_an_option() {
    for (limit, vertices) in [(30.0_f32, 8), (50.0, 6)] {
        let options = ObjOptions { smooth_angle: limit.to_radians(), ..ObjOptions::default() };
        let model = read_with(folded(40.0, "").as_bytes(), &options, &mut MemoryFiles::default());
        assert_eq!(model.objects[0].mesh.positions.len(), vertices, "{limit}");
    }
}

#[test]
fn smoothing_groups_and_off_make_edges() {
    for (statement, vertices) in [("s 2", 8), ("s off", 8), ("s 0", 8), ("s 1", 6)] {
        let text = format!("s 1\n{}", folded(20.0, statement));
        assert_eq!(read(&text).objects[0].mesh.positions.len(), vertices, "{statement}");
    }
    let flat = read(&format!("s off\n{}", folded(20.0, "")));
    assert_eq!(flat.objects[0].mesh.positions.len(), 8);
}

#[test]
fn groups_and_repeated_vertices_make_no_edges() {
    let model = read(&folded(40.0, "g other"));
    let half = 20_f32.to_radians();
    let mean = Vec3::new(-half.sin(), half.cos(), 0.0);
    let at_edge = |object: usize| {
        let mesh = &model.objects[object].mesh;
        let i = mesh.positions.iter().position(|p| p.x == 0.0).unwrap();
        mesh.normals[i]
    };
    assert!(at_edge(0).distance(mean) < 1e-6 && at_edge(1).distance(mean) < 1e-6);
    // The same fold as separate triangles, every vertex repeated.
    let soup = read("v 0 0 0\nv 0 0 -1\nv -1 0 0\nf 1 2 3\nv 0 0 0\nv 1 0.1 0\nv 0 0 -1\nf 4 5 6");
    let normals = &soup.objects[0].mesh.normals;
    assert!(normals[0].distance(normals[3]) < 1e-6 && normals[0].distance(normals[2]) > 1e-3);
}

#[test]
fn given_normals_are_kept_and_made_unit() {
    let text = format!("{SQUARE}vn 0 3 4\nvn 1e-30 0 0\nf 1//1 2//2 3//1\nf 1 3 4");
    let mesh = read(&text).objects[0].mesh.clone();
    assert_eq!(mesh.normals[0], Vec3::new(0.0, 0.6, 0.8));
    assert_eq!(mesh.normals[1], Vec3::X);
    // The face without normals gets its own, not the first of the file.
    let last = mesh.triangles[1].map(|i| mesh.normals[i as usize]);
    assert_eq!(last, [Vec3::Z; 3]);
}

#[test]
fn zero_normals_are_made_anew() {
    let mesh = read(&format!("{SQUARE}vn 0 0 0\nf 1//1 2//1 3//1")).objects[0].mesh.clone();
    assert_eq!(mesh.normals, [Vec3::Z; 3]);
}

#[test]
fn what_is_not_drawn_is_told_once() {
    let model = read(&format!("{SQUARE}l 1 2\nl 2 3\np 1\nfoo 1\nvertex 1\nf 1 2 3"));
    let text: Vec<_> = model.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(text.len(), 4, "{text:?}");
    assert_eq!(text[0], "a.obj:5:1: `l` is left out: only polygons are drawn");
    assert_eq!(text[2], "a.obj:8:1: the statement `foo` is not known; did you mean `f`?");
}

#[test]
fn crossing_polygons_are_told_and_drawn() {
    let model = read("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4");
    assert!(model.warnings[0].to_string().starts_with("a.obj:5:1: this polygon crosses itself"));
    assert!(!model.objects[0].mesh.triangles.is_empty());
}

#[test]
fn damaged_statements_are_refused_with_their_place() {
    let cases = [
        ("v 1 2", "a.obj:5:5: `v` has only 2 numbers"),
        ("v 1 2 x", "a.obj:5:7: `x` is not a number"),
        ("v 1 2 1e99", "a.obj:5:7: `1e99` is not a finite number"),
        ("f 1 2", "a.obj:5:1: a face needs at least 3 corners, this one has 2"),
        ("f 1 2 9", "a.obj:5:1: this face uses vertex 9, which does not exist; the file has 4"),
        ("f 1 2 0", "a.obj:5:7: there is no vertex 0; indices count from 1"),
        ("f 1 2 -9", "a.obj:5:7: there is no vertex -9; 4 are defined before this line"),
        (
            "f 1/1 2/1 3/1",
            "a.obj:5:1: this face uses texture coordinate 1, which does not exist; the file has 0",
        ),
        ("f 1 2 b", "a.obj:5:7: `b` is not a corner of a face"),
        ("vn 1 2", "a.obj:5:6: `vn` has only 2 numbers"),
        ("s x", "a.obj:5:3: `x` is not a smoothing group"),
    ];
    for (line, expected) in cases {
        let message = error(&format!("{SQUARE}{line}\nf 1 2 3"));
        assert!(message.starts_with(expected), "{line}: {message}");
    }
}

#[test]
fn files_without_faces_are_refused() {
    assert!(error("").starts_with("a.obj: holds no OBJ statement"));
    assert!(error("\u{0}PNG\nrubbish").starts_with("a.obj: holds no OBJ statement"));
    assert!(error(SQUARE).starts_with("a.obj: holds no faces"));
}

#[test]
fn colours_and_numbers_of_materials_are_read() {
    let p = phong("Ka 0.2 0.3 0.4 # a comment\nKd 0.5\nKs .1 .2 .3\nKe 1 2 3\nNs 50\nNi 1.33");
    assert_eq!(p.ambient.factor, Rgb::new(0.2, 0.3, 0.4));
    assert_eq!(p.diffuse.factor, Rgb::splat(0.5));
    assert_eq!(p.specular.factor, Rgb::new(0.1, 0.2, 0.3));
    assert_eq!(p.emission.factor, Rgb::new(1.0, 2.0, 3.0));
    assert_eq!((p.shininess.factor, p.ior), (50.0, 1.33));
    assert_eq!((p.mirror.factor, p.transparency.factor), (Rgb::ZERO, Rgb::ZERO));
}

#[test]
fn ambient_of_zero_one_or_none_is_the_diffuse_colour() {
    for ka in ["", "Ka 0 0 0", "Ka 1 1 1"] {
        assert_eq!(phong(&format!("{ka}\nKd .2 .4 .6")).ambient.factor, Rgb::new(0.2, 0.4, 0.6), "{ka}");
    }
}

#[test]
fn opacity_comes_from_d_or_tr() {
    for (mtl, expected) in [
        ("d 0.25", 0.25),
        ("Tr 0.25", 0.75),
        ("d 1\nTr 1", 1.0),
        ("Tr 1", 1.0),
        ("d -halo 0.5", 0.5),
        ("d 7", 1.0),
    ] {
        assert_eq!(material(mtl).0.opacity.factor, expected, "{mtl}");
    }
}

#[test]
fn illumination_models_choose_mirror_and_glass() {
    let ks = "Kd 0.5\nKs 0.25 0.5 0.75\n";
    let color = Rgb::new(0.25, 0.5, 0.75);
    for (mtl, specular, mirror, transparency) in [
        ("illum 1", Rgb::ZERO, Rgb::ZERO, Rgb::ZERO),
        ("illum 2", color, Rgb::ZERO, Rgb::ZERO),
        ("illum 3", color, color, Rgb::ZERO),
        ("illum 5", color, color, Rgb::ZERO),
        ("illum 4", color, Rgb::ZERO, Rgb::ZERO),
        ("illum 4\nd 0.5", color, color, Rgb::ZERO),
        ("illum 6", color, color, Rgb::ONE - color),
        ("illum 7", color, Rgb::ZERO, Rgb::ONE),
        ("illum 7\nTf 0 0.4 0.2", color, Rgb::ZERO, Rgb::new(0.0, 1.0, 0.5)),
        ("illum 9\nNs 0", Rgb::ZERO, Rgb::ZERO, Rgb::ONE),
    ] {
        let p = phong(&format!("{ks}{mtl}"));
        assert_eq!(p.specular.factor, specular, "{mtl}");
        assert_eq!(p.mirror.factor, mirror, "{mtl}");
        assert_eq!(p.transparency.factor, transparency, "{mtl}");
        let is_dielectric = mtl.starts_with("illum 7") || mtl.starts_with("illum 9");
        assert_eq!(p.fresnel == FresnelMode::Dielectric, is_dielectric, "{mtl}");
    }
}

#[test]
fn textures_are_read_with_their_options() {
    let (material, model) = material(
        "Kd 0.5 0.5 0.5\nmap_Kd -s 2 3 1 -o 0.25 0 0 -clamp on wood.png\nmap_Ks -s 2 3 1 -o 0.25 0 0 -clamp on wood.png",
    );
    let Surface::Phong(p) = material.surface else { panic!("not the report\'s surface") };
    assert_eq!(p.diffuse.factor, Rgb::splat(0.5));
    // The same file in the same place is the same texture.
    assert_eq!((p.diffuse.texture, model.textures.len()), (p.specular.texture, 1));
    assert_eq!(p.ambient.texture, p.diffuse.texture);
    let texture = &model.textures[0];
    assert_eq!((texture.uv.scale, texture.uv.offset), (Vec2::new(2.0, 3.0), Vec2::new(0.25, 0.0)));
    assert!(
        matches!(&texture.pattern, Pattern::Image { wrap_u: Wrap::Clamp, image, .. } if image.width == 2)
    );
    assert_eq!(model.warnings, []);
}

#[test]
fn a_black_colour_under_a_texture_is_white() {
    let p = phong("Kd 0 0 0\nmap_Kd wood.png\nKe 0 0 0\nmap_Ke wood.png");
    assert_eq!((p.diffuse.factor, p.emission.factor), (Rgb::ONE, Rgb::ONE));
}

#[test]
fn windows_paths_name_the_same_files() {
    let (_, model) = material("map_Kd .\\wood.png");
    assert!(matches!(model.textures[0].pattern, Pattern::Image { .. }));
}

#[test]
fn missing_textures_are_magenta_and_told_by_name() {
    let (material, model) = material("map_Kd nowhere.png\nmap_d nowhere.png\nmap_Bump nowhere.png");
    assert_eq!(model.textures.len(), 1);
    assert_eq!(model.textures[0].pattern, Pattern::Missing);
    assert_eq!(model.warnings.len(), 1);
    assert!(model.warnings[0].to_string().starts_with("a.mtl:2:1: texture `nowhere.png`: file not found"));
    assert_eq!((material.opacity.texture, material.relief), (None, None));
}

#[test]
fn reliefs_are_bumps_or_normal_maps() {
    // The square's diagonal is the square root of 2.
    let strength = match material("map_Bump -bm 0.5 relief.png").0.relief {
        Some(Relief::Bump { strength, .. }) => strength,
        other => panic!("{other:?}"),
    };
    assert!((strength - 0.5 * 0.01 * 2_f32.sqrt()).abs() < 1e-6);
    for mtl in ["norm bumps.png", "bump bumps.png"] {
        assert!(matches!(material(mtl).0.relief, Some(Relief::Normal { strength: 1.0, .. })), "{mtl}");
    }
}

#[test]
fn masks_become_alpha() {
    let (material, model) = material("map_d relief.png");
    let id = material.opacity.texture.unwrap();
    let Pattern::Image { image, .. } = &model.textures[id.index()].pattern else {
        panic!("no image");
    };
    assert_eq!((image.pixel(0, 0).w, image.pixel(1, 0).w), (0.0, 1.0));
}

#[test]
fn damaged_libraries_are_refused_with_their_place() {
    for (line, expected) in [
        ("Kd 1 0", "a.mtl:2:6: `Kd` has 2 numbers"),
        ("Kd red", "a.mtl:2:4: `red` is not a number"),
        ("Kd -1 0 0", "a.mtl:2:1: `Kd` is negative"),
        ("Ni 0", "a.mtl:2:4: an index of refraction of 0 does not exist"),
        ("Ns", "a.mtl:2:1: `Ns` has no number"),
        ("map_Kd -q wood.png", "a.mtl:2:8: the texture option `-q` is not known"),
        ("newmtl", "a.mtl:2:1: `newmtl` gives no name"),
    ] {
        let mut files = MemoryFiles::default();
        files.library("a.mtl", format!("newmtl m\n{line}"));
        let text = format!("mtllib a.mtl\n{SQUARE}f 1 2 3");
        let read = parse_obj(Path::new("a.obj"), text.as_bytes(), &ObjOptions::default(), &mut files);
        let message = read.unwrap_err().to_string();
        assert!(message.starts_with(expected), "{line}: {message}");
    }
}

#[test]
fn missing_libraries_and_materials_are_told() {
    let mut files = MemoryFiles::default();
    files.library("a.mtl", "newmtl wood\nKd 1 0 0");
    let text = format!("mtllib a.mtl\nmtllib b.mtl\n{SQUARE}usemtl wodo\nf 1 2 3");
    let model = read_with(text.as_bytes(), &ObjOptions::default(), &mut files);
    let warnings: Vec<_> = model.warnings.iter().map(ToString::to_string).collect();
    assert!(warnings[0].starts_with("a.obj:2:1: material library `b.mtl`: file not found"), "{warnings:?}");
    assert_eq!(
        warnings[1],
        "a.obj:7:1: the material `wodo` is not defined: grey stands in; did you mean `wood`?"
    );
    assert_eq!(model.materials[0].name, "wodo");
}

#[test]
fn several_libraries_are_read() {
    let mut files = MemoryFiles::default();
    files.library("a.mtl", "newmtl red\nKd 1 0 0");
    files.library("b c.mtl", "newmtl blue\nKd 0 0 1");
    let text = format!("mtllib a.mtl b c.mtl\n{SQUARE}usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4");
    let model = read_with(text.as_bytes(), &ObjOptions::default(), &mut files);
    assert_eq!((model.materials.len(), model.warnings.len()), (2, 0));
}

#[test]
fn byte_order_marks_latin_1_and_continued_lines_are_read() {
    let mut files = MemoryFiles::default();
    files.libraries.insert("a.mtl".into(), b"\xef\xbb\xbfnewmtl Terraind\xe9k \nKd 0 1 0\n".to_vec());
    let text = b"\xef\xbb\xbfmtllib a.mtl\r\nv 0 0 0\r\nv 1 0 \\\r\n 0 # far\r\nv 0 1 0\r\nusemtl Terraind\xe9k\r\nf 1 2 \\\r\n3#end\r\n";
    let model = read_with(text, &ObjOptions::default(), &mut files);
    assert_eq!(model.materials[0].name, "Terraind\u{e9}k");
    assert_eq!(corners(&model, 0, 0), [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(model.warnings, []);
}

#[test]
fn lamps_shine_from_their_fronts_unless_they_are_inside_out() {
    const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    const FACES: [[u32; 4]; 6] =
        [[4, 3, 2, 1], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]];
    let back = |ke: &str, faces: &[[u32; 4]], is_turned: bool| {
        let mut files = MemoryFiles::default();
        files.library("a.mtl", format!("newmtl floor\nnewmtl lamp\nKe {ke}"));
        let face = |[a, b, c, d]: &[u32; 4]| match is_turned {
            false => format!("f {a} {b} {c} {d}\n"),
            true => format!("f {d} {c} {b} {a}\n"),
        };
        let lamp: String = faces.iter().map(face).collect();
        let text = format!("mtllib a.mtl\n{CUBE}usemtl lamp\n{lamp}");
        let floor = format!("{text}o other\nusemtl floor\nf 1 2 3 4\nusemtl lamp\nf 1 2 3\n");
        let backs = [text, floor].map(|text| {
            let model = read_with(text.as_bytes(), &ObjOptions::default(), &mut files);
            model.materials.iter().find(|material| material.name == "lamp").expect("a lamp").back
        });
        assert_eq!(backs[0], backs[1]);
        backs[0]
    };
    assert_eq!(back("1 1 1", &FACES[..1], false), Back::Dark);
    assert_eq!(back("1 1 1", &FACES[..1], true), Back::Dark);
    assert_eq!(back("1 1 1", &FACES, false), Back::Dark);
    assert_eq!(back("1 1 1", &FACES, true), Back::Alike);
    assert_eq!(back("0 0 0", &FACES, false), Back::Alike);
}
