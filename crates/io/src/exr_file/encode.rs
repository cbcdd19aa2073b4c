//! A frame as the bytes of an OpenEXR file, the same bytes every time.
//!
//! The `exr` crate lays out the file around the blocks of [`super::blocks`]; the header is then written anew with the
//! entries of the frame, sorted by name, and the offsets of the blocks are moved by the difference in length.

use super::attributes::{DEFAULTS, STRUCTURE, write};
use super::header::{self, Attribute, LONGEST_NAME, serialize};
use super::{ExrOptions, SaveReport, blocks, chromaticities};
use exr::block::writer::ChunksWriter;
use heliostat_scene::frame::{Frame, Meta};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Cursor;

/// The bytes, and what had to be changed to store the values.
pub(super) fn encode(frame: &Frame, options: &ExrOptions) -> Result<(Vec<u8>, SaveReport), String> {
    check(frame)?;
    let explain = |e: exr::error::Error| format!("cannot be encoded: {e}");
    let (header, chunks, report) = blocks::compress(frame, options).map_err(explain)?;
    let mut file = Vec::new();
    exr::block::write(Cursor::new(&mut file), [header].into_iter().collect(), true, |_, writer| {
        let mut chunks = chunks.into_iter().enumerate();
        chunks.try_for_each(|(i, chunk)| writer.write_chunk(i, chunk))
    })
    .map_err(explain)?;
    Ok((with_entries(&file, &frame.meta)?, report))
}

/// Checks what the file format demands of a frame.
fn check(frame: &Frame) -> Result<(), String> {
    let window = frame.window;
    let is_inside = window.x1 <= frame.width && window.y1 <= frame.height;
    if !is_inside || window.x0 >= window.x1 || window.y0 >= window.y1 {
        return Err(format!("{window:?} is no part of a picture of {} x {}", frame.width, frame.height));
    }
    if frame.width.max(frame.height) > i32::MAX as u32 / 2 {
        return Err(format!("{} x {} pixels are too many for OpenEXR", frame.width, frame.height));
    }
    if frame.channels.is_empty() {
        return Err("there are no channels to write".to_owned());
    }
    let mut names = BTreeSet::new();
    for channel in &frame.channels {
        check_name(&channel.name)?;
        if !names.insert(&channel.name) {
            return Err(format!("there are two channels {}", channel.name));
        }
        if channel.values.len() != frame.pixel_count() {
            return Err(format!("channel {} does not fill the window", channel.name));
        }
    }
    frame.meta.iter().try_for_each(|(name, meta)| {
        check_name(name)?;
        check_name(write(meta).0)?;
        if STRUCTURE.contains(&name.as_str()) { Err(format!("the entry {name} is reserved")) } else { Ok(()) }
    })
}

fn check_name(name: &str) -> Result<(), String> {
    if name.is_empty() || name.len() > LONGEST_NAME || name.contains(char::is_control) {
        return Err(format!("{name:?} is no name for a channel or an entry"));
    }
    Ok(())
}

/// The same file with the entries of a frame in its header.
fn with_entries(file: &[u8], meta: &BTreeMap<String, Meta>) -> Result<Vec<u8>, String> {
    let old = header::parse(file)?;
    let [part] = &old.parts[..] else { return Err("cannot be encoded: more than one part".to_owned()) };
    let entries = entries(meta);
    let written: Vec<_> = entries.iter().map(|(name, meta)| (name.as_bytes(), write(meta))).collect();
    let chromaticities = chromaticities::rec709_bytes();
    let is_default = |a: &&Attribute<'_>| DEFAULTS.iter().any(|(name, _)| a.name == name.as_bytes());
    let mut attributes: Vec<_> = part.0.iter().filter(|a| !is_default(a)).copied().collect();
    attributes.push(Attribute { name: b"chromaticities", kind: b"chromaticities", value: &chromaticities });
    for (name, (kind, value)) in &written {
        attributes.push(Attribute { name, kind: kind.as_bytes(), value });
    }
    Ok(replace_header(file, old.length, serialize(old.version, attributes)))
}

/// The entries of a frame and those that no file may lack.
fn entries(meta: &BTreeMap<String, Meta>) -> BTreeMap<&str, Cow<'_, Meta>> {
    let software = Meta::Text(concat!("heliostat ", env!("CARGO_PKG_VERSION")).to_owned());
    let defaults = DEFAULTS.into_iter().chain([("software", software)]);
    let mut entries: BTreeMap<_, _> = defaults.map(|(name, value)| (name, Cow::Owned(value))).collect();
    entries.extend(meta.iter().map(|(name, value)| (name.as_str(), Cow::Borrowed(value))));
    entries
}

/// Puts another header before the blocks and moves the table of their offsets, which follows the header.
fn replace_header(file: &[u8], old_length: usize, header: Vec<u8>) -> Vec<u8> {
    let body = &file[old_length..];
    let first = body.first_chunk().map_or(0, |b| u64::from_le_bytes(*b)) as usize;
    // The table ends where the first block starts.
    let (table, blocks) = body.split_at(first.saturating_sub(old_length).min(body.len()));
    let mut out = header;
    let moved = (out.len() as u64).wrapping_sub(old_length as u64);
    out.reserve(body.len());
    for offset in table.as_chunks().0 {
        out.extend(u64::from_le_bytes(*offset).wrapping_add(moved).to_le_bytes());
    }
    out.extend(blocks);
    out
}
