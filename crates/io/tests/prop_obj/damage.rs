//! Damaged OBJ and MTL files: an error or a valid model, never a panic.

use crate::memory::MemoryFiles;
use heliostat_io::obj::{ObjOptions, parse_obj};
use proptest::prelude::*;
use std::path::Path;

const OBJ: &str = "\u{feff}# made by hand\nmtllib a.mtl\no car\ng body left\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0 0.5\n\
    v 0 1 0 1 1 0 1\nv .3 .4 -1e-3\nvt 0 0\nvt 1 0.5 0\nvn 0 0 1\nvn 0 3 4\ns 1\nusemtl wood\nf 1/1/1 2/2/2 3//1 4\n\
    f -1 -2 \\\n -3 # last\ns off\nusemtl glass #2\nf 1 2 5 3 4\nl 1 2\nf 5 4 3 2 1\n";
const MTL: &str = "newmtl wood\nKa 1 1 1\nKd .5 .4 .3\nKs 0.5\nNs 30\nmap_Kd -s 2 2 -o 0 .5 -clamp on wood.png\n\
    bump -bm 0.3 -imfchan g wood.png\nmap_d wood.png\nnewmtl glass #2\nillum 7\nNi 1.5\nTf .2 .4 .6\nd 0.5\nKe 1 2 3\n";

/// Changes to the bytes of a file.
#[derive(Clone, Debug)]
enum Damage {
    Cut(usize),
    Set(usize, u8),
    Insert(usize, Vec<u8>),
    Remove(usize, usize),
    Repeat(usize, usize),
}

fn damage() -> impl Strategy<Value = Damage> {
    let at = 0_usize..2000;
    let pieces = proptest::sample::select(vec![
        "0",
        "-",
        "/",
        "//",
        "\\\n",
        "#",
        "9999999999",
        "-1",
        "nan",
        "1e39",
        "\n",
        "\r",
        " ",
        "f ",
        "v ",
        "\u{0}",
        "é",
        "1/",
        "-s",
        "usemtl ",
        "newmtl ",
    ]);
    prop_oneof![
        at.clone().prop_map(Damage::Cut),
        (at.clone(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        (at.clone(), pieces).prop_map(|(at, piece)| Damage::Insert(at, piece.as_bytes().to_vec())),
        (at.clone(), 1_usize..30).prop_map(|(at, n)| Damage::Remove(at, n)),
        (at, 1_usize..60).prop_map(|(at, n)| Damage::Repeat(at, n)),
    ]
}

fn damaged(text: &str, damages: &[Damage]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for damage in damages {
        let len = bytes.len().max(1);
        match damage {
            Damage::Cut(at) => bytes.truncate(at % len),
            Damage::Set(at, value) => {
                if let Some(byte) = bytes.get_mut(at % len) {
                    *byte = *value;
                }
            }
            Damage::Insert(at, piece) => {
                let at = (at % len).min(bytes.len());
                bytes.splice(at..at, piece.iter().copied());
            }
            Damage::Remove(at, n) => {
                let at = (at % len).min(bytes.len());
                bytes.drain(at..(at + n).min(bytes.len()));
            }
            Damage::Repeat(at, n) => {
                let at = (at % len).min(bytes.len());
                let piece = bytes[at..(at + n).min(bytes.len())].to_vec();
                bytes.splice(at..at, piece);
            }
        }
    }
    bytes
}

/// Reads it; a model that comes out must be whole.
fn check(obj: &[u8], mtl: &[u8]) {
    let mut files = MemoryFiles::default();
    files.libraries.insert("a.mtl".into(), mtl.to_vec());
    files.image("wood.png", 3, &[1, 2, 3, 4, 5, 6]);
    match parse_obj(Path::new("a.obj"), obj, &ObjOptions::default(), &mut files) {
        Ok(model) => {
            for object in &model.objects {
                object.mesh.validate().expect("a whole mesh");
                assert!(object.materials.iter().all(|&m| m < model.materials.len()));
                let slots = object.mesh.slots.iter();
                assert!(slots.max().is_none_or(|&slot| usize::from(slot) < object.materials.len()));
            }
        }
        Err(error) => {
            let text = error.to_string();
            assert!(!text.contains(char::is_control) && text.len() < 2000, "{text}");
        }
    }
}

#[test]
fn the_whole_files_are_read() {
    let mut files = MemoryFiles::default();
    files.library("a.mtl", MTL);
    files.image("wood.png", 3, &[1, 2, 3, 4, 5, 6]);
    let model = parse_obj(Path::new("a.obj"), OBJ.as_bytes(), &ObjOptions::default(), &mut files).unwrap();
    assert_eq!(model.objects[0].mesh.triangles.len(), 2 + 1 + 3 + 3);
}

#[test]
fn every_truncation_is_survived() {
    (0..OBJ.len()).for_each(|end| check(&OBJ.as_bytes()[..end], MTL.as_bytes()));
    (0..MTL.len()).for_each(|end| check(OBJ.as_bytes(), &MTL.as_bytes()[..end]));
}

#[test]
fn every_flipped_bit_is_survived() {
    for bit in 0..8 * OBJ.len() {
        let mut bytes = OBJ.as_bytes().to_vec();
        bytes[bit / 8] ^= 1 << (bit % 8);
        check(&bytes, MTL.as_bytes());
    }
    for bit in 0..8 * MTL.len() {
        let mut bytes = MTL.as_bytes().to_vec();
        bytes[bit / 8] ^= 1 << (bit % 8);
        check(OBJ.as_bytes(), &bytes);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_models_are_survived(damages in proptest::collection::vec(damage(), 1..12)) {
        check(&damaged(OBJ, &damages), MTL.as_bytes());
    }

    #[test]
    fn damaged_libraries_are_survived(damages in proptest::collection::vec(damage(), 1..12)) {
        check(OBJ.as_bytes(), &damaged(MTL, &damages));
    }

    #[test]
    fn random_polygons_are_survived(
        points in proptest::collection::vec(prop_oneof![(-3_i32..4).prop_map(|n| n as f32), any::<f32>()], 9..90),
        repeats in proptest::collection::vec(any::<proptest::sample::Index>(), 3..40),
    ) {
        let mut text = String::new();
        for p in points.chunks_exact(3) {
            let p: Vec<_> = p.iter().map(|x| if x.is_finite() { *x } else { 0.0 }).collect();
            text += &format!("v {:e} {:e} {:e}\n", p[0], p[1], p[2]);
        }
        text += "f";
        repeats.iter().for_each(|i| text += &format!(" {}", i.index(points.len() / 3) + 1));
        check(text.as_bytes(), b"");
    }
}
