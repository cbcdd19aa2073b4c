//! Models made here.

/// A GLB of a JSON text and the bytes of its first buffer.
pub(super) fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let chunk =
        |kind: &[u8; 4], bytes: Vec<u8>| [&(bytes.len() as u32).to_le_bytes()[..], kind, &bytes].concat();
    let chunks = [chunk(b"JSON", padded(json.as_bytes(), b' ')), chunk(b"BIN\0", padded(binary, 0))].concat();
    let length = chunks.len() as u32 + 12;
    [b"glTF", &2_u32.to_le_bytes()[..], &length.to_le_bytes(), &chunks].concat()
}
