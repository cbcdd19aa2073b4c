//! What a part of an OpenEXR file declares about its pixels, checked before anything is allocated.
//!
//! Refused with a reason: deep data, subsampled channels, DWA and HTJ2K compression (the decoder behind us aborts on
//! damaged DWA data), and everything larger than the limits.

use super::header::{Cursor, FileHeader, NON_IMAGE, Part};
use crate::image_file::{Limits, Refusal};

/// A rectangle of pixels, both corners inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Window {
    pub(super) min: [i32; 2],
    pub(super) max: [i32; 2],
}

impl Window {
    fn of(part: &Part<'_>, name: &str) -> Result<Self, Refusal> {
        let value = part.value(name, "box2i").ok_or_else(|| format!("has no {name}"))?;
        let mut cursor = Cursor::new(value);
        let mut number = || cursor.array().map(i32::from_le_bytes);
        let window = Self { min: [number()?, number()?], max: [number()?, number()?] };
        let [width, height] = window.size();
        if width == 0 || height == 0 { Err(format!("has an empty {name}").into()) } else { Ok(window) }
    }

    /// Columns and rows; 0 where the corners are the wrong way round.
    pub(super) fn size(&self) -> [u64; 2] {
        let length = |i: usize| i64::from(self.max[i]) - i64::from(self.min[i]) + 1;
        [length(0), length(1)].map(|n| u64::try_from(n).unwrap_or(0))
    }

    /// The part of both, which may be empty.
    pub(super) fn intersect(&self, other: &Self) -> Self {
        Self {
            min: [0, 1].map(|i| self.min[i].max(other.min[i])),
            max: [0, 1].map(|i| self.max[i].min(other.max[i])),
        }
    }

    /// The smallest rectangle around both.
    pub(super) fn union(&self, other: &Self) -> Self {
        Self {
            min: [0, 1].map(|i| self.min[i].min(other.min[i])),
            max: [0, 1].map(|i| self.max[i].max(other.max[i])),
        }
    }
}

/// Type of the samples of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SampleKind {
    Uint,
    Half,
    Float,
}

impl SampleKind {
    fn of(code: u32) -> Result<Self, String> {
        match code {
            0 => Ok(Self::Uint),
            1 => Ok(Self::Half),
            2 => Ok(Self::Float),
            code => Err(format!("has a channel of unknown type {code}")),
        }
    }

    fn bytes(self) -> u64 {
        if self == Self::Half { 2 } else { 4 }
    }
}

/// A channel as declared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ChannelInfo {
    pub(super) name: String,
    pub(super) kind: SampleKind,
}

/// What a part declares.
#[derive(Clone, Debug)]
pub(super) struct PartLayout {
    /// Name of the part; empty where it has none.
    pub(super) name: String,
    /// The eye it was made for; empty where it says nothing.
    pub(super) view: String,
    pub(super) display: Window,
    pub(super) data: Window,
    pub(super) channels: Vec<ChannelInfo>,
}

/// The layouts of all parts.
///
/// # Errors
/// Where a part cannot be read or is larger than the limits.
pub(super) fn check(header: &FileHeader<'_>, limits: &Limits) -> Result<Vec<PartLayout>, Refusal> {
    if header.version & NON_IMAGE != 0 {
        return Err(Refusal::Variant("holds deep data, which is not read".to_owned()));
    }
    let parts = header.parts.iter().map(|p| check_part(p, limits)).collect::<Result<Vec<_>, _>>()?;
    let stored = |p: &PartLayout| -> u64 {
        let [width, height] = p.data.size();
        width * height * p.channels.iter().map(|c| c.kind.bytes()).sum::<u64>()
    };
    // No overflow: each part is below the limit.
    if parts.iter().map(|p| u128::from(stored(p))).sum::<u128>() > u128::from(limits.bytes) {
        return Err(Refusal::Large(format!("has more pixels than the limit of {} bytes", limits.bytes)));
    }
    Ok(parts)
}

fn check_part(part: &Part<'_>, limits: &Limits) -> Result<PartLayout, Refusal> {
    let text = |name| part.value(name, "string").map(|v| String::from_utf8_lossy(v).into_owned());
    match text("type").as_deref() {
        None | Some("scanlineimage" | "tiledimage") => {}
        Some(kind) => return Err(Refusal::Variant(format!("holds {kind} data, which is not read"))),
    }
    check_compression(part)?;
    check_tiles(part, limits)?;
    let channels = channels(part)?;
    let [display, data] = [Window::of(part, "displayWindow")?, Window::of(part, "dataWindow")?];
    let pixel_bytes = channels.iter().map(|c| c.kind.bytes()).sum::<u64>();
    for window in [display, data] {
        let [width, height] = window.size();
        limits.check(width, height, pixel_bytes)?;
    }
    let [name, view] = ["name", "view"].map(|n| text(n).unwrap_or_default());
    Ok(PartLayout { name, view, display, data, channels })
}

fn check_compression(part: &Part<'_>) -> Result<(), Refusal> {
    let value = part.value("compression", "compression").ok_or("has no compression attribute")?;
    let name = match value {
        // none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A
        [0..=7] => return Ok(()),
        [8] => "DWAA",
        [9] => "DWAB",
        [10 | 11] => "HTJ2K",
        _ => "unknown",
    };
    Err(Refusal::Variant(format!("has {name} compression, which is not read")))
}

fn check_tiles(part: &Part<'_>, limits: &Limits) -> Result<(), Refusal> {
    let Some(value) = part.value("tiles", "tiledesc") else { return Ok(()) };
    let mut cursor = Cursor::new(value);
    let [width, height] = [u32::from_le_bytes(cursor.array()?), u32::from_le_bytes(cursor.array()?)];
    limits.check(width.into(), height.into(), 1)
}

/// The channel list of a part.
fn channels(part: &Part<'_>) -> Result<Vec<ChannelInfo>, Refusal> {
    let value = part.value("channels", "chlist").ok_or("has no channel list")?;
    let mut cursor = Cursor::new(value);
    let mut channels: Vec<ChannelInfo> = Vec::new();
    loop {
        let name = cursor.name()?;
        if name.is_empty() {
            break;
        }
        let name = String::from_utf8_lossy(name).into_owned();
        let kind = SampleKind::of(u32::from_le_bytes(cursor.array()?))?;
        // A flag for lossy compression and three unused bytes.
        cursor.take(4)?;
        let sampling = [i32::from_le_bytes(cursor.array()?), i32::from_le_bytes(cursor.array()?)];
        if sampling != [1, 1] {
            let message =
                format!("has a subsampled channel {name} (luminance and chroma), which is not read");
            return Err(Refusal::Variant(message));
        }
        channels.push(ChannelInfo { name, kind });
    }
    if channels.is_empty() || !cursor.is_at_end() {
        return Err("has a damaged or empty channel list".into());
    }
    Ok(channels)
}
