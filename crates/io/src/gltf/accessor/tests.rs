//! Accessors over bytes made here.

use super::*;

/// A document with one buffer and these views and accessors.
fn document(bytes: &[u8], views: &str, accessors: &str) -> Document {
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "buffers": [{{"byteLength": {}}}],
            "bufferViews": [{views}], "accessors": [{accessors}]}}"#,
        bytes.len()
    );
    Document::new("a.glb".as_ref(), crate::gltf::tests::glb(&text, bytes)).unwrap()
}

fn le(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

#[test]
fn strides_and_offsets_pick_the_numbers() {
    let bytes = le(&[9.0, 1.0, 2.0, 9.0, 3.0, 4.0]);
    let document = document(
        &bytes,
        r#"{"buffer": 0, "byteLength": 24, "byteStride": 12}"#,
        r#"{"bufferView": 0, "byteOffset": 4, "count": 2, "componentType": 5126, "type": "VEC2"}"#,
    );
    let accessor = document.accessor(0, "").unwrap();
    assert_eq!([accessor.floats(0), accessor.floats(1)], [[1.0, 2.0], [3.0, 4.0]]);
}

#[test]
fn whole_numbers_are_numbers_or_shares() {
    let bytes = [0x80, 0x81, 0x00, 0x7f, 0xff];
    let view = r#"{"buffer": 0, "byteLength": 5}"#;
    let accessor = |kind: u32, normalized: bool| {
        let json = format!(
            r#"{{"bufferView": 0, "count": 5, "componentType": {kind}, "type": "SCALAR", "normalized": {normalized}}}"#
        );
        let accessor = document(&bytes, view, &json).accessor(0, "").unwrap();
        (0..5).map(|i| accessor.floats::<1>(i)[0]).collect::<Vec<_>>()
    };
    assert_eq!(accessor(5120, false), [-128.0, -127.0, 0.0, 127.0, -1.0]);
    assert_eq!(accessor(5120, true), [-1.0, -1.0, 0.0, 1.0, -1.0 / 127.0]);
    assert_eq!(accessor(5121, true), [128.0 / 255.0, 129.0 / 255.0, 0.0, 127.0 / 255.0, 1.0]);
}

#[test]
fn words_of_two_and_four_bytes_are_little_endian() {
    let bytes = [0x01, 0x80, 0xff, 0xff];
    let number = |kind: u32| {
        let json = format!(r#"{{"bufferView": 0, "count": 1, "componentType": {kind}, "type": "SCALAR"}}"#);
        let accessor = document(&bytes, r#"{"buffer": 0, "byteLength": 4}"#, &json).accessor(0, "").unwrap();
        (accessor.floats::<1>(0)[0], accessor.integers::<1>(0)[0])
    };
    assert_eq!(number(5122).0, -32767.0);
    assert_eq!(number(5123), (32769.0, 0x8001));
    assert_eq!(number(5125).1, 0xffff_8001);
}

#[test]
fn sparse_elements_replace_those_of_the_view_or_zeros() {
    let mut bytes = le(&[1.0, 2.0, 3.0, 7.0]);
    bytes.extend([2, 0, 0, 0]);
    let views = r#"{"buffer": 0, "byteLength": 12}, {"buffer": 0, "byteOffset": 12, "byteLength": 4},
                   {"buffer": 0, "byteOffset": 16, "byteLength": 1}"#;
    let sparse = r#""count": 3, "componentType": 5126, "type": "SCALAR", "sparse": {"count": 1,
        "indices": {"bufferView": 2, "componentType": 5121}, "values": {"bufferView": 1}}"#;
    let document = document(&bytes, views, &format!(r#"{{"bufferView": 0, {sparse}}}, {{{sparse}}}"#));
    let numbers = |index| {
        let accessor = document.accessor(index, "").unwrap();
        (0..accessor.len()).map(|i| accessor.floats::<1>(i)[0]).collect::<Vec<_>>()
    };
    assert_eq!(numbers(0), [1.0, 2.0, 7.0]);
    assert_eq!(numbers(1), [0.0, 0.0, 7.0]);
}

#[test]
fn elements_that_are_not_there_are_refused_before_they_are_allocated() {
    let bytes = le(&[1.0, 2.0]);
    let view = r#"{"buffer": 0, "byteLength": 8}, {"buffer": 0, "byteLength": 8, "byteStride": 9000000000000000000}"#;
    for json in [
        r#"{"bufferView": 0, "count": 3, "componentType": 5126, "type": "SCALAR"}"#,
        r#"{"bufferView": 0, "byteOffset": 1, "count": 2, "componentType": 5126, "type": "SCALAR"}"#,
        r#"{"bufferView": 0, "count": 18446744073709551615, "componentType": 5126, "type": "MAT4"}"#,
        r#"{"bufferView": 1, "count": 9000000000000000000, "componentType": 5126, "type": "MAT4"}"#,
        r#"{"count": 9000000000000000000, "componentType": 5126, "type": "MAT4"}"#,
        r#"{"count": 900000000, "componentType": 5126, "type": "MAT4"}"#,
        r#"{"bufferView": 5, "count": 1, "componentType": 5126, "type": "SCALAR"}"#,
        r#"{"bufferView": 0, "count": 1, "componentType": 1, "type": "SCALAR"}"#,
        r#"{"bufferView": 0, "count": 1, "componentType": 5126, "type": "SCALAR", "sparse": {"count": 1,
            "indices": {"bufferView": 0, "componentType": 5123, "byteOffset": 2}, "values": {"bufferView": 0}}}"#,
    ] {
        assert!(document(&bytes, view, json).accessor(0, "").is_err(), "{json}");
    }
    assert!(document(&bytes, view, "").accessor(0, "").is_err());
}

#[test]
fn no_elements_are_fine() {
    let json = r#"{"bufferView": 0, "byteOffset": 8, "count": 0, "componentType": 5126, "type": "VEC3"}"#;
    let accessor =
        document(&le(&[0.0, 0.0]), r#"{"buffer": 0, "byteLength": 8}"#, json).accessor(0, "").unwrap();
    assert_eq!(accessor.len(), 0);
}
