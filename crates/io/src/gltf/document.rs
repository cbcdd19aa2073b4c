//! An open file: its JSON, and the bytes of its buffers when somebody asks for them.

use super::container::parts;
use super::draco::Draco;
use super::extensions::check_required;
use super::flaw::Flaw;
use super::json;
use super::uri::{Target, resolve};
use crate::error::{LoadError, quote};
use crate::file::read_file;
use gltf::json::{Root, buffer};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// Longest file in bytes: what the lengths in a GLB can count.
const MOST_BYTES: u64 = u32::MAX as u64;

/// Bytes of a file or a part of it, shared.
#[derive(Clone, Debug)]
pub(super) struct Bytes {
    all: Arc<Vec<u8>>,
    range: Range<usize>,
}

impl From<Vec<u8>> for Bytes {
    fn from(all: Vec<u8>) -> Self {
        Self { range: 0..all.len(), all: Arc::new(all) }
    }
}

impl std::ops::Deref for Bytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.all[self.range.clone()]
    }
}

impl Bytes {
    /// `length` bytes from `offset` on; `None` where there are not so many.
    pub(super) fn slice(&self, offset: usize, length: usize) -> Option<Self> {
        let end = offset.checked_add(length).filter(|&end| end <= self.range.len())?;
        Some(Self { all: Arc::clone(&self.all), range: self.range.start + offset..self.range.start + end })
    }
}

/// Something that is read when it is first asked for, good or bad.
type Once<T> = OnceLock<Result<T, Flaw>>;

/// An open glTF file.
#[derive(Debug)]
pub(super) struct Document {
    pub(super) path: PathBuf,
    pub(super) root: Root,
    /// The chunk of a GLB that is its first buffer.
    binary: Option<Bytes>,
    buffers: Vec<Once<Bytes>>,
    /// Compressed buffer views, unpacked.
    pub(super) unpacked: Vec<Once<Bytes>>,
    /// Packed primitives.
    pub(super) draco: Draco,
}

impl Document {
    /// Reads a file; its buffers wait until they are needed.
    ///
    /// # Errors
    /// When it is missing, damaged, or needs an extension that is not read.
    pub(super) fn open(path: &Path) -> Result<Self, LoadError> {
        let bytes = read_file(path, MOST_BYTES)?;
        Self::new(path, bytes).map_err(|flaw| flaw.into_error(path))
    }

    /// The same from the bytes of a file.
    pub(super) fn new(path: &Path, bytes: Vec<u8>) -> Result<Self, Flaw> {
        let parts = parts(&bytes)?;
        let root = json::parse(&bytes[parts.json])?;
        check_required(&root)?;
        let bytes = Bytes::from(bytes);
        let once = |count: usize| std::iter::repeat_with(OnceLock::new).take(count).collect();
        Ok(Self {
            path: path.to_owned(),
            binary: parts.binary.and_then(|range| bytes.slice(range.start, range.len())),
            buffers: once(root.buffers.len()),
            unpacked: once(root.buffer_views.len()),
            draco: Draco::of(&root)?,
            root,
        })
    }

    /// The folder that paths count from.
    pub(super) fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// The bytes of a buffer.
    pub(super) fn buffer(&self, index: usize) -> Result<Bytes, Flaw> {
        let slot = self.buffers.get(index);
        let slot = slot.ok_or_else(|| Flaw::dangling("bufferViews", "buffers", index, self.buffers.len()))?;
        slot.get_or_init(|| self.read_buffer(index, &self.root.buffers[index])).clone()
    }

    fn read_buffer(&self, index: usize, buffer: &buffer::Buffer) -> Result<Bytes, Flaw> {
        let place = format!("buffers[{index}]");
        let bytes = match (&buffer.uri, &self.binary) {
            (Some(uri), _) => match resolve(uri, self.folder(), &format!("{place}.uri"))? {
                Target::Data(bytes) => bytes.into(),
                Target::File(path) => read_beside(&path, &place, MOST_BYTES)?.into(),
            },
            (None, Some(binary)) if index == 0 => binary.clone(),
            (None, _) => {
                return Err(Flaw::new(place, "has neither a URI nor a chunk of a GLB")
                    .with_help("export the file again"));
            }
        };
        let length = buffer.byte_length.0;
        let whole = usize::try_from(length).ok().and_then(|length| bytes.slice(0, length));
        whole.ok_or_else(|| {
            Flaw::new(place, format!("is to have {length} bytes, but has {}", bytes.len()))
                .with_help("copy or export its file again")
        })
    }

    /// The bytes of a buffer view as they are in the buffer, and what the view says of itself.
    pub(super) fn raw_view(&self, index: usize, place: &str) -> Result<(Bytes, &buffer::View), Flaw> {
        let views = &self.root.buffer_views;
        let view =
            views.get(index).ok_or_else(|| Flaw::dangling(place, "bufferViews", index, views.len()))?;
        let offset = view.byte_offset.map_or(0, |offset| offset.0);
        let bytes =
            self.part(view.buffer.value(), offset, view.byte_length.0, &format!("bufferViews[{index}]"))?;
        Ok((bytes, view))
    }

    /// Some bytes of a buffer.
    pub(super) fn part(&self, buffer: usize, offset: u64, length: u64, place: &str) -> Result<Bytes, Flaw> {
        let bytes = self.buffer(buffer)?;
        let range = usize::try_from(offset).ok().zip(usize::try_from(length).ok());
        range.and_then(|(offset, length)| bytes.slice(offset, length)).ok_or_else(|| {
            let message = format!(
                "takes {length} bytes from {offset} on, but buffers[{buffer}] has only {}",
                bytes.len()
            );
            Flaw::new(place, message).with_help("export the file again")
        })
    }

    /// Bytes that lie in the buffers that have been read so far: what may be made of them is bounded by that.
    pub(super) fn held_bytes(&self) -> usize {
        let held = self.buffers.iter().filter_map(|buffer| buffer.get()?.as_ref().ok());
        held.map(|bytes| bytes.len()).sum()
    }
}

/// A file that a place in the JSON names.
pub(super) fn read_beside(path: &Path, place: &str, limit: u64) -> Result<Vec<u8>, Flaw> {
    read_file(path, limit).map_err(|error| {
        let report = error.report();
        let flaw = Flaw::new(place, format!("{}: {}", quote(&path.to_string_lossy()), report.message));
        match &report.help {
            Some(help) => flaw.with_help(help.clone()),
            None => flaw,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(json: &str) -> Document {
        Document::new("a.gltf".as_ref(), json.as_bytes().to_vec()).unwrap()
    }

    fn told(flaw: Flaw) -> String {
        flaw.into_error("a.gltf".as_ref()).to_string()
    }

    #[test]
    fn buffers_and_views_are_checked_against_what_is_there() {
        let document = document(
            r#"{"asset": {"version": "2.0"},
                "buffers": [{"byteLength": 3, "uri": "data:,abcd"}, {"byteLength": 9, "uri": "data:,abcd"}, {"byteLength": 1}],
                "bufferViews": [{"buffer": 0, "byteOffset": 1, "byteLength": 2},
                                {"buffer": 0, "byteOffset": 1, "byteLength": 3},
                                {"buffer": 7, "byteLength": 0},
                                {"buffer": 0, "byteOffset": 18446744073709551615, "byteLength": 2}]}"#,
        );
        assert_eq!(&*document.raw_view(0, "").unwrap().0, b"bc");
        assert!((1..5).all(|view| document.raw_view(view, "").is_err()));
        assert_eq!(
            told(document.buffer(1).unwrap_err()),
            "a.gltf: buffers[1]: is to have 9 bytes, but has 4; copy or export its file again"
        );
        assert!(document.buffer(2).is_err());
        assert_eq!(document.held_bytes(), 3);
    }
}
