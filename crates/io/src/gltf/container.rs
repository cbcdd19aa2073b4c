//! The two containers: GLB with its chunks, and plain JSON.

use super::flaw::Flaw;
use std::ops::Range;

/// The JSON chunk.
const JSON: u32 = u32::from_le_bytes(*b"JSON");
/// The chunk of the first buffer.
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");
/// Bytes before the first chunk.
const HEADER: usize = 12;

/// Where the parts of a file lie.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Parts {
    pub(super) json: Range<usize>,
    pub(super) binary: Option<Range<usize>>,
}

/// Finds the parts of a file.
///
/// # Errors
/// When a GLB is cut short or of another version.
pub(super) fn parts(bytes: &[u8]) -> Result<Parts, Flaw> {
    if !bytes.starts_with(b"glTF") {
        // Some editors put a byte order mark before the JSON.
        let start = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        return Ok(Parts { json: start..bytes.len(), binary: None });
    }
    let cut = || Flaw::new("", "is cut short").with_help("copy or download it again");
    let word = |at: usize| {
        let bytes = bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    };
    let version = word(4).ok_or_else(cut)?;
    if version != 2 {
        return Err(Flaw::new("", format!("is GLB of version {version}")).with_help("convert it to glTF 2.0"));
    }
    if word(8).ok_or_else(cut)? as usize > bytes.len() {
        return Err(cut());
    }
    let mut parts = Parts { json: 0..0, binary: None };
    let mut at = HEADER;
    while let (Some(length), Some(kind)) = (word(at), word(at + 4)) {
        let start = at + 8;
        let end = start.checked_add(length as usize).filter(|&end| end <= bytes.len()).ok_or_else(cut)?;
        match kind {
            JSON if parts.json.is_empty() => parts.json = start..end,
            BIN if parts.binary.is_none() => parts.binary = Some(start..end),
            // Other chunks belong to extensions.
            _ => {}
        }
        at = end;
    }
    if parts.json.is_empty() { Err(cut()) } else { Ok(parts) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gltf::tests::glb;

    #[test]
    fn chunks_are_found() {
        let bytes = glb("{}", &[1, 2, 3, 4]);
        let parts = parts(&bytes).unwrap();
        assert_eq!(&bytes[parts.json], b"{}  ");
        assert_eq!(&bytes[parts.binary.unwrap()], [1, 2, 3, 4]);
    }

    #[test]
    fn plain_json_is_all_json() {
        assert_eq!(parts(b"\xef\xbb\xbf{}").unwrap(), Parts { json: 3..5, binary: None });
    }

    #[test]
    fn a_glb_that_is_cut_anywhere_is_refused() {
        let bytes = glb("{}", &[1, 2, 3, 4]);
        assert!((4..bytes.len()).all(|end| parts(&bytes[..end]).is_err()));
    }

    #[test]
    fn version_one_is_refused_with_a_mend() {
        let mut bytes = glb("{}", &[]);
        bytes[4] = 1;
        let error = parts(&bytes).unwrap_err().into_error("a.glb".as_ref());
        assert_eq!(error.to_string(), "a.glb: is GLB of version 1; convert it to glTF 2.0");
    }
}
