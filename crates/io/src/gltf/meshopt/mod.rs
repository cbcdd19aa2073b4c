//! `EXT_meshopt_compression`, and `KHR_meshopt_compression` as far as it is the same: buffer views that are packed by what their numbers have in common.
//!
//! # Source
//! Khronos, "`EXT_meshopt_compression`", appendix A (bitstream) and B (filters); Kapoulkine, "meshoptimizer", whose encoder
//! made the vectors of the tests.

mod attributes;
mod filter;
mod indices;
mod stream;

use super::document::{Bytes, Document};
use super::extensions::extension;
use super::flaw::Flaw;
use serde::Deserialize;

/// Of unpacked bytes that one packed byte may stand for at most; runs of equal vertices come to some two hundred.
const MOST_GAIN: u64 = 1 << 12;

/// The first byte of numbers in version 1 of the codec.
const SECOND_VERSION: u8 = 0xa1;

/// What is in the packed bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

/// What is done to the unpacked numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Filter {
    #[default]
    None,
    Octahedral,
    Quaternion,
    Exponential,
}

/// The extension of a buffer view.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Packed {
    buffer: usize,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    byte_stride: usize,
    count: u64,
    mode: Mode,
    #[serde(default)]
    filter: Filter,
}

impl Document {
    /// The bytes of a buffer view, unpacked if need be, and its stride.
    ///
    /// # Errors
    /// When it does not exist, names bytes that are not there, or is packed and damaged.
    pub(super) fn view(&self, index: usize, place: &str) -> Result<(Bytes, Option<usize>), Flaw> {
        let json = self.root.buffer_views.get(index);
        let others = json.and_then(|view| Some(&view.extensions.as_ref()?.others));
        let at = format!("bufferViews[{index}]");
        let packed = match extension::<Packed>(others, "KHR_meshopt_compression", &at)? {
            None => extension::<Packed>(others, "EXT_meshopt_compression", &at)?,
            packed => packed,
        };
        match packed {
            None => {
                let (bytes, view) = self.raw_view(index, place)?;
                Ok((bytes, view.byte_stride.map(|stride| stride.0)))
            }
            Some(packed) => {
                let bytes = self.unpacked[index].get_or_init(|| self.unpack(&packed, &at)).clone()?;
                Ok((bytes, Some(packed.byte_stride)))
            }
        }
    }

    fn unpack(&self, packed: &Packed, place: &str) -> Result<Bytes, Flaw> {
        let damaged = |why: &str| {
            let message = format!("packed bytes {why}");
            Flaw::new(place, message).with_help("unpack it with `gltf-transform copy in.glb out.glb`")
        };
        let bytes = self.part(packed.buffer, packed.byte_offset, packed.byte_length, place)?;
        let size = packed.count.checked_mul(packed.byte_stride as u64);
        let fits = size.is_some_and(|size| size <= packed.byte_length.saturating_mul(MOST_GAIN));
        if !fits {
            return Err(damaged("cannot hold so many numbers"));
        }
        if packed.mode == Mode::Attributes && bytes.first() == Some(&SECOND_VERSION) {
            return Err(damaged("are in version 1 of the codec, which is not read"));
        }
        let (count, stride) = (packed.count as usize, packed.byte_stride);
        let unpacked = match packed.mode {
            Mode::Attributes => attributes::unpack(&bytes, count, stride),
            Mode::Triangles => indices::triangles(&bytes, count, stride),
            Mode::Indices => indices::sequence(&bytes, count, stride),
        };
        let mut unpacked = unpacked.ok_or_else(|| damaged("are damaged"))?;
        let is_done = match packed.filter {
            Filter::None => true,
            Filter::Octahedral => filter::octahedral(&mut unpacked, stride),
            Filter::Quaternion => filter::quaternion(&mut unpacked, stride),
            Filter::Exponential => filter::exponential(&mut unpacked, stride),
        };
        if is_done {
            Ok(unpacked.into())
        } else {
            Err(damaged("have a filter that does not fit their stride"))
        }
    }
}
