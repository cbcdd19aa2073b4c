//! The header of an OpenEXR file as bytes: named attributes, each with a type and a value, per part.
//!
//! Reading and writing it here rather than through the `exr` crate has three uses: sizes can be checked before that
//! crate allocates anything, attributes of any name and type survive, and they are written in the order of their names
//! (the crate keeps them in a hash map, whose order differs from run to run).
//!
//! # Source
//! "OpenEXR File Layout", sections "Version Field", "Header", "Attribute Layout" and "Predefined Attribute Types".

use std::collections::BTreeSet;

/// The first four bytes of every file.
pub(crate) const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
/// Bit of the version field: names may have up to 255 bytes instead of 31.
pub(super) const LONG_NAMES: u32 = 0x400;
/// Bit of the version field: some part has deep or other non-image data.
pub(super) const NON_IMAGE: u32 = 0x800;
/// Bit of the version field: several parts, a list of headers.
pub(super) const MULTI_PART: u32 = 0x1000;
/// Most bytes of a name.
pub(super) const LONGEST_NAME: usize = 255;
/// Most bytes of a name without [`LONG_NAMES`].
const LONGEST_SHORT_NAME: usize = 31;

/// One attribute, borrowed from the bytes of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Attribute<'a> {
    pub(super) name: &'a [u8],
    pub(super) kind: &'a [u8],
    pub(super) value: &'a [u8],
}

/// The attributes of one part.
#[derive(Clone, Debug, Default)]
pub(super) struct Part<'a>(pub(super) Vec<Attribute<'a>>);

/// Everything before the offset tables.
#[derive(Clone, Debug)]
pub(super) struct FileHeader<'a> {
    /// Version number and flags.
    pub(super) version: u32,
    /// At least one.
    pub(super) parts: Vec<Part<'a>>,
    /// Bytes of the whole header.
    pub(super) length: usize,
}

/// Walks through bytes; every step checks that they are there.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let rest = &self.bytes[self.at..];
        let taken = rest.get(..count).ok_or("ends in the middle of its header")?;
        self.at += count;
        Ok(taken)
    }

    pub(super) fn array<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.at == self.bytes.len()
    }

    /// Text up to a zero byte; empty at the end of a list.
    pub(super) fn name(&mut self) -> Result<&'a [u8], String> {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().take(LONGEST_NAME + 1).position(|&b| b == 0);
        let end = end.ok_or("has a name without end in its header")?;
        self.at += end + 1;
        Ok(&rest[..end])
    }
}

/// Reads the header at the start of `bytes`.
pub(super) fn parse(bytes: &[u8]) -> Result<FileHeader<'_>, String> {
    let mut cursor = Cursor::new(bytes);
    if cursor.take(MAGIC.len())? != MAGIC {
        return Err("is no OpenEXR file".to_owned());
    }
    let version = u32::from_le_bytes(cursor.array()?);
    if version & 0xff != 2 {
        return Err(format!("has version {} of OpenEXR; version 2 is read", version & 0xff));
    }
    let mut parts = Vec::new();
    loop {
        let part = parse_part(&mut cursor)?;
        let multi_part = version & MULTI_PART != 0;
        // A list of parts ends with an empty one.
        if part.0.is_empty() && multi_part && !parts.is_empty() {
            break;
        }
        parts.push(part);
        if !multi_part {
            break;
        }
    }
    Ok(FileHeader { version, parts, length: cursor.at })
}

fn parse_part<'a>(cursor: &mut Cursor<'a>) -> Result<Part<'a>, String> {
    let mut part = Part::default();
    let mut names = BTreeSet::new();
    loop {
        let name = cursor.name()?;
        if name.is_empty() {
            return Ok(part);
        }
        // Two readers could believe two different ones.
        if !names.insert(name) {
            return Err(format!("has two attributes {}", String::from_utf8_lossy(name)));
        }
        let kind = cursor.name()?;
        let size = i32::from_le_bytes(cursor.array()?);
        let size = usize::try_from(size).map_err(|_| "has an attribute of negative size")?;
        part.0.push(Attribute { name, kind, value: cursor.take(size)? });
    }
}

impl<'a> Part<'a> {
    /// The value of an attribute of that name and type.
    pub(super) fn value(&self, name: &str, kind: &str) -> Option<&'a [u8]> {
        let wanted = |a: &&Attribute<'a>| a.name == name.as_bytes() && a.kind == kind.as_bytes();
        self.0.iter().find(wanted).map(|a| a.value)
    }
}

/// The bytes of a header of one part, its attributes in the order of their names.
pub(super) fn serialize(version: u32, mut attributes: Vec<Attribute<'_>>) -> Vec<u8> {
    attributes.sort_unstable();
    let is_long = |a: &Attribute<'_>| a.name.len().max(a.kind.len()) > LONGEST_SHORT_NAME;
    let long_names = if attributes.iter().any(is_long) { LONG_NAMES } else { 0 };
    let mut out = MAGIC.to_vec();
    out.extend((version | long_names).to_le_bytes());
    for attribute in &attributes {
        for name in [attribute.name, attribute.kind] {
            out.extend(name);
            out.push(0);
        }
        out.extend((attribute.value.len() as u32).to_le_bytes());
        out.extend(attribute.value);
    }
    out.push(0);
    out
}
