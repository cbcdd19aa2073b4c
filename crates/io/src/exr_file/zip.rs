//! The ZIP compression of OpenEXR: bytes rearranged, differences taken, deflated.
//!
//! The `exr` crate does the same at deflate level 4, which takes five to thirteen times as long on noisy pictures and
//! saves two to nine per cent.
//!
//! # Source
//! OpenEXR, `internal_zip.c` ("reorder" and "predictor").

use miniz_oxide::deflate::compress_to_vec_zlib;

/// Deflate level: the fast one.
const LEVEL: u8 = 1;

/// The compressed bytes, or `raw` itself where that is not longer: readers know by the length.
pub(super) fn compress(raw: Vec<u8>) -> Vec<u8> {
    let compressed = compress_to_vec_zlib(&predict(&raw), LEVEL);
    if compressed.len() < raw.len() { compressed } else { raw }
}

/// Even bytes, then odd bytes; each less its predecessor, plus 128.
fn predict(raw: &[u8]) -> Vec<u8> {
    let halves = raw.iter().step_by(2).chain(raw.iter().skip(1).step_by(2));
    let mut last = None;
    let difference = |&byte: &u8| match last.replace(byte) {
        None => byte,
        Some(last) => byte.wrapping_sub(last).wrapping_add(128),
    };
    halves.map(difference).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prediction_is_as_in_the_format() {
        // Even bytes 10, 12, 9; odd bytes 200, 201.
        assert_eq!(predict(&[10, 200, 12, 201, 9]), [10, 130, 125, 63, 129]);
        assert!(predict(&[]).is_empty());
    }

    #[test]
    fn noise_is_stored_as_it_is() {
        let noise: Vec<u8> = (0..4096_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
        let stored = compress(noise.clone());
        assert!(stored.len() <= noise.len());
        assert_eq!(compress(vec![1, 2, 3]), [1, 2, 3]);
    }
}
