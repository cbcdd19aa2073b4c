//! A frame as the bytes of an OpenEXR file, the same bytes every time.
//!
//! The `exr` crate compresses the pixels and lays out the file; the header is then written anew with the entries of
//! the frame, sorted by name, and the offsets of the blocks are moved by the difference in length.

use super::attributes::{DEFAULTS, STRUCTURE, write};
use super::header::{self, Attribute, LONGEST_NAME, serialize};
use super::{Compression, ExrOptions, SaveReport, chromaticities};
use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::math::Vec2;
use exr::meta::attribute::{IntegerBounds, LineOrder, Text};
use exr::meta::header::{ImageAttributes, LayerAttributes};
use half::f16;
use heliostat_scene::frame::{Channel, Depth, Frame, Meta};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Cursor;

/// The bytes, and what had to be changed to store the values.
pub(super) fn encode(frame: &Frame, options: &ExrOptions) -> Result<(Vec<u8>, SaveReport), String> {
    check(frame)?;
    let mut report = SaveReport::default();
    let channels = frame.channels.iter().map(|c| stored_channel(c, &mut report)).collect();
    let body = encode_pixels(frame, AnyChannels::sort(channels), options)?;
    Ok((with_entries(&body, &frame.meta)?, report))
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
    frame.meta.keys().try_for_each(|name| {
        check_name(name)?;
        if STRUCTURE.contains(&name.as_str()) { Err(format!("the entry {name} is reserved")) } else { Ok(()) }
    })
}

fn check_name(name: &str) -> Result<(), String> {
    if name.is_empty() || name.len() > LONGEST_NAME || name.contains(char::is_control) {
        return Err(format!("{name:?} is no name for a channel or an entry"));
    }
    Ok(())
}

/// The values of a channel in the type of the file: no NaN, no infinity.
fn stored_channel(channel: &Channel, report: &mut SaveReport) -> AnyChannel<FlatSamples> {
    let largest = match channel.depth {
        Depth::Half => f16::MAX.to_f32(),
        Depth::Float => f32::MAX,
    };
    let mut finite = |v: f32| {
        if v.is_nan() {
            report.replaced += 1;
            0.0
        } else if v.abs() > largest {
            *(if v.is_infinite() { &mut report.replaced } else { &mut report.clamped }) += 1;
            largest.copysign(v)
        } else {
            v
        }
    };
    let values = channel.values.iter();
    let samples = match channel.depth {
        Depth::Half => FlatSamples::F16(values.map(|v| f16::from_f32(finite(*v))).collect()),
        Depth::Float => FlatSamples::F32(values.map(|v| finite(*v)).collect()),
    };
    AnyChannel::new(Text::from_slice_unchecked(channel.name.as_bytes()), samples)
}

/// A complete file with the attributes that describe the pixels, and no others.
fn encode_pixels(
    frame: &Frame,
    channels: AnyChannels<FlatSamples>,
    options: &ExrOptions,
) -> Result<Vec<u8>, String> {
    let window = frame.window;
    let size = Vec2(window.width() as usize, window.height() as usize);
    let attributes = LayerAttributes {
        layer_position: Vec2(window.x0.cast_signed(), window.y0.cast_signed()),
        ..LayerAttributes::default()
    };
    let compression = match options.compression {
        Compression::None => exr::compression::Compression::Uncompressed,
        Compression::Zips => exr::compression::Compression::ZIP1,
        Compression::Zip => exr::compression::Compression::ZIP16,
        Compression::Piz => exr::compression::Compression::PIZ,
    };
    // In any other order the blocks would lie as the threads finished.
    let encoding = Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let display = IntegerBounds::new(Vec2(0, 0), Vec2(frame.width as usize, frame.height as usize));
    let image = Image {
        attributes: ImageAttributes::new(display),
        layer_data: Layer::new(size, attributes, encoding, channels),
    };
    let mut bytes = Vec::new();
    let image = image.write();
    let image = if options.parallel { image } else { image.non_parallel() };
    image.to_buffered(Cursor::new(&mut bytes)).map_err(|e| format!("cannot be encoded: {e}"))?;
    Ok(bytes)
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
    let entry = |(name, (kind, value))| Attribute { name, kind: str::as_bytes(kind), value };
    attributes.extend(written.iter().map(|(name, (kind, value))| entry((*name, (*kind, value.as_slice())))));
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
