//! `tobj` as the witness: on well-formed files both readers give the same corners of the same triangles.

use crate::memory::MemoryFiles;
use crate::models::asset_models;
use glam::Vec3;
use heliostat_io::obj::{ObjOptions, Split, parse_obj};
use proptest::prelude::*;
use std::path::Path;

/// One corner: position, texture coordinates and normal, in bits.
type Corner = ([u32; 3], [u32; 2], [u32; 3]);

fn bits<const N: usize>(values: &[f32], index: usize) -> [u32; N] {
    // Adding zero makes -0 and 0 the same bits.
    std::array::from_fn(|axis| values.get(N * index + axis).map_or(0, |v| (v + 0.0).to_bits()))
}

/// The corners of all triangles as `tobj` reads them, in the order of the file.
fn corners_of_tobj(bytes: &[u8]) -> Vec<Corner> {
    let options = tobj::LoadOptions { triangulate: true, single_index: true, ..Default::default() };
    let none = |_: &Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut &*bytes, &options, none).expect("a good file");
    let mut corners = Vec::new();
    for model in models {
        let mesh = model.mesh;
        corners.extend(mesh.indices.iter().map(|&i| {
            let i = i as usize;
            (bits(&mesh.positions, i), bits(&mesh.texcoords, i), bits(&mesh.normals, i))
        }));
    }
    corners
}

/// The same as this project reads them; normals that the file does not have are left out.
fn corners_of_ours(bytes: &[u8], has_normals: bool) -> Vec<Corner> {
    let options = ObjOptions { split: Split::Whole, ..ObjOptions::default() };
    let model =
        parse_obj(Path::new("a.obj"), bytes, &options, &mut MemoryFiles::default()).expect("a good file");
    let mesh = &model.objects[0].mesh;
    mesh.validate().expect("a whole mesh");
    let corner = |&i: &u32| {
        let i = i as usize;
        let normal = if has_normals { mesh.normals[i] } else { Vec3::ZERO };
        let uv = mesh.uvs.get(i).map_or([0; 2], |uv| bits(&uv.to_array(), 0));
        (bits(&mesh.positions[i].to_array(), 0), uv, bits(&normal.to_array(), 0))
    };
    mesh.triangles.iter().flatten().map(corner).collect()
}

/// A convex face: a start and the number of corners on a ring of 8 vertices.
fn model() -> impl Strategy<Value = String> {
    let face = (3_usize..=8, 0_usize..8, any::<bool>());
    (proptest::collection::vec(face, 1..20), -4_i32..4, 0_usize..3, any::<bool>()).prop_map(
        |(faces, exponent, form, groups)| {
            let mut text = String::new();
            let scale = 10_f32.powi(exponent);
            for i in 0..8 {
                let (sin, cos) = (std::f32::consts::TAU * i as f32 / 8.0).sin_cos();
                text += &format!("v {} {} {}\n", scale * (cos + 3.0), scale * sin, -scale * cos);
                text += &format!("vt {cos} {sin}\nvn 0 0 {}\n", if i % 2 == 0 { 1 } else { -1 });
            }
            for (number, (count, start, is_negative)) in faces.into_iter().enumerate() {
                if groups {
                    text += &format!("g part{}\n", number % 3);
                }
                text += "f";
                for k in 0..count {
                    let index = ((start + k) % 8) as i32 + 1;
                    let index = if is_negative { index - 9 } else { index };
                    text += &match form {
                        0 => format!(" {index}"),
                        1 => format!(" {index}/{index}"),
                        _ => format!(" {index}/{index}/{index}"),
                    };
                }
                text += "\n";
            }
            text
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn generated_models_agree(text in model()) {
        let first_face = text.lines().find(|line| line.starts_with("f ")).unwrap_or_default();
        let first_corner = first_face.split_whitespace().nth(1).unwrap_or_default();
        let has_normals = first_corner.matches('/').count() == 2;
        prop_assert_eq!(corners_of_ours(text.as_bytes(), has_normals), corners_of_tobj(text.as_bytes()));
    }
}

/// Positions and texture coordinates, on files of triangles: of polygons the cut may differ.
#[test]
fn real_models_agree() {
    for path in asset_models() {
        let bytes = std::fs::read(&path).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        let words = |line: &str| line.split_whitespace().count();
        let is_plain = text.is_ascii() && !text.contains("\\\n");
        let has_only_triangles = text.lines().filter(|l| l.starts_with("f ")).all(|l| words(l) == 4);
        if !is_plain || !has_only_triangles {
            continue;
        }
        let positions = |corners: Vec<Corner>| corners.into_iter().map(|c| (c.0, c.1)).collect::<Vec<_>>();
        let (ours, theirs) = (corners_of_ours(&bytes, false), corners_of_tobj(&bytes));
        assert!(positions(ours) == positions(theirs), "{}", path.display());
    }
}
