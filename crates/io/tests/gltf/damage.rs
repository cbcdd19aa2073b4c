//! Damaged models: an error or a scene that is valid, never a panic, and never more memory than the file is worth.

use crate::assets::asset;
use crate::made::{everything, scene_at};
use heliostat_io::gltf::Moment;
use heliostat_io::model::complete_gltf;
use proptest::prelude::*;

/// Whatever the bytes are, what comes of them is an error or whole.
fn survives(bytes: Vec<u8>) {
    let moment = Moment { seconds: 0.5, shutter: 0.1, ..Moment::default() };
    if let Ok((mut scene, _)) = scene_at(bytes, &moment) {
        complete_gltf(&mut scene, 1.5);
        if let Err(issues) = scene.validate() {
            panic!("{issues:?}");
        }
    }
}

#[test]
fn the_model_itself_is_good() {
    let (scene, warnings) =
        scene_at(everything(), &Moment::default()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((scene.objects.len(), scene.groups.len(), warnings.len()), (2, 1, 0));
    assert_eq!((scene.cameras.len(), scene.lights.len(), scene.textures.len()), (1, 1, 1));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_bytes_are_survived(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12)) {
        let mut bytes = everything();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        survives(bytes);
    }

    #[test]
    fn changed_numbers_are_survived(at in any::<prop::sample::Index>(), to in prop::sample::select(vec![
        "0", "-1", "7", "1e39", "4294967295", "18446744073709551615", "null", "[]", "{}", "\"a\"", "5125", "1e-46",
    ])) {
        let bytes = everything();
        let numbers: Vec<usize> = (20..bytes.len() - 1)
            .filter(|&i| bytes[i].is_ascii_digit() && !bytes[i - 1].is_ascii_alphanumeric() && bytes[i - 1] != b'_')
            .collect();
        let at = numbers[at.index(numbers.len())];
        let length = bytes[at..].iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count();
        let json_length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
        prop_assume!(at < 20 + json_length);
        let mut json = bytes[20..20 + json_length].to_vec();
        json.splice(at - 20..at - 20 + length, to.bytes());
        survives(crate::made::glb(&String::from_utf8_lossy(&json), &bytes[28 + json_length..]));
    }

    #[test]
    fn cut_files_are_survived(end in any::<prop::sample::Index>()) {
        let mut bytes = everything();
        let end = end.index(bytes.len());
        bytes.truncate(end);
        prop_assert!(scene_at(bytes, &Moment::default()).is_err());
    }
}

#[test]
fn a_real_model_cut_at_each_hundredth_is_survived() {
    let Some(path) = asset("VertexColorTest/VertexColorTest.glb") else { return };
    let bytes = std::fs::read(path).expect("a file");
    for part in 0..100 {
        let cut = bytes[..bytes.len() * part / 100].to_vec();
        assert!(scene_at(cut, &Moment::default()).is_err(), "{part} %");
    }
}

#[test]
fn a_thousand_flipped_bytes_of_a_real_model_are_survived() {
    let Some(path) = asset("VertexColorTest/VertexColorTest.glb") else { return };
    let bytes = std::fs::read(path).expect("a file");
    // Steps of a golden ratio reach all parts of the file evenly.
    for i in 0..1000_usize {
        let mut flipped = bytes.clone();
        let at = (i as f64 * 0.618_033_988_75).fract() * bytes.len() as f64;
        flipped[at as usize] ^= 1 << (i % 8);
        survives(flipped);
    }
}
