//! The pixels of an OpenEXR file as the channels of a frame.
//!
//! Scan lines and tiles (the full resolution of mip maps), one part or several. Channels of parts for another view
//! (eye) than the first are named `view.channel`, as in files of one part; where a name is taken, `part.` goes before.
//! The window of the frame is what all parts together cover of the display window; pixels that a part does not have are
//! 0, pixels outside the display window (overscan) are left out. Integer samples become floats, exact up to 2^24.

use super::header;
use super::layout::{self, PartLayout, SampleKind, Window};
use super::{attributes, chromaticities};
use crate::image_file::{Limits, Refusal, shield};
use crate::parallel::map_in_order;
use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock};
use exr::block::reader::ChunksReader;
use exr::math::Vec2;
use exr::meta::attribute::{ChannelDescription, ChannelList};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData, compute_block_count};
use half::f16;
use heliostat_scene::frame::{Channel, Depth, Frame};
use heliostat_scene::settings::PixelRect;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Cursor;

/// A channel of a part.
struct Planned {
    /// Name in the frame.
    name: String,
    kind: SampleKind,
    /// Index among the channels of the frame, if it is wanted.
    slot: Option<usize>,
}

/// Decodes the channels whose names are `wanted`, in the order of the file.
pub(super) fn decode(bytes: &[u8], limits: &Limits, wanted: &dyn Fn(&str) -> bool) -> Result<Frame, Refusal> {
    let header = header::parse(bytes)?;
    let parts = layout::check(&header, limits)?;
    let plan = plan(&parts, wanted)?;
    let mut frame = empty_frame(&parts, &plan, limits)?;
    let offsets: Vec<_> = parts.iter().map(|part| offset(part, &frame)).collect();
    shield(|| {
        read_pixels(bytes, &parts, |block, channels| {
            let part = block.index.layer;
            place(block, channels, &plan[part], offsets[part], &mut frame);
        })
    })?;
    frame.meta = attributes::read(&header.parts[0]);
    chromaticities::to_rec709(&header.parts[0], &mut frame)?;
    Ok(frame)
}

/// The names of all channels that [`decode`] could give, in the order of the file.
pub(super) fn channel_names(bytes: &[u8], limits: &Limits) -> Result<Vec<String>, Refusal> {
    let parts = layout::check(&header::parse(bytes)?, limits)?;
    Ok(plan(&parts, &|_| true)?.into_iter().flatten().map(|c| c.name).collect())
}

fn plan(parts: &[PartLayout], wanted: &dyn Fn(&str) -> bool) -> Result<Vec<Vec<Planned>>, Refusal> {
    let mut names = BTreeSet::new();
    let mut slots = 0;
    let mut plan = Vec::new();
    for part in parts {
        let mut planned = Vec::new();
        for channel in &part.channels {
            let mut name = channel.name.clone();
            if part.view != parts[0].view {
                name = format!("{}.{name}", part.view);
            }
            if names.contains(&name) {
                name = format!("{}.{name}", part.name);
            }
            if !names.insert(name.clone()) {
                return Err(format!("has two channels {name}").into());
            }
            let slot = wanted(&name).then_some(slots);
            slots += usize::from(slot.is_some());
            planned.push(Planned { name, kind: channel.kind, slot });
        }
        plan.push(planned);
    }
    Ok(plan)
}

/// The frame, all values 0.
fn empty_frame(parts: &[PartLayout], plan: &[Vec<Planned>], limits: &Limits) -> Result<Frame, Refusal> {
    let display = parts[0].display;
    if parts.iter().any(|p| p.display != display) {
        return Err("has parts with different display windows".into());
    }
    let covered = parts[1..].iter().fold(parts[0].data, |window, p| window.union(&p.data));
    let window = relative(&covered.intersect(&display), &display);
    let wanted = plan.iter().flatten().filter(|c| c.slot.is_some());
    let count = u64::from(window.width()) * u64::from(window.height());
    if count > 0 {
        let frame_bytes = 4 * wanted.clone().count() as u64;
        limits.check(window.width().into(), window.height().into(), frame_bytes)?;
    }
    let channel = |c: &Planned| Channel {
        name: c.name.clone(),
        depth: if c.kind == SampleKind::Half { Depth::Half } else { Depth::Float },
        values: vec![0.0; count as usize],
    };
    let [width, height] = display.size().map(|n| n as u32);
    Ok(Frame { width, height, window, channels: wanted.map(channel).collect(), meta: BTreeMap::new() })
}

/// `window` counted from the corner of the display window; no pixels where it is empty.
fn relative(window: &Window, display: &Window) -> PixelRect {
    let [width, height] = window.size().map(|n| n as u32);
    if width == 0 || height == 0 {
        return PixelRect { x0: 0, y0: 0, x1: 0, y1: 0 };
    }
    let [x0, y0] = [0, 1].map(|i| window.min[i].abs_diff(display.min[i]));
    PixelRect { x0, y0, x1: x0 + width, y1: y0 + height }
}

/// What to add to a pixel position in a part to get its position in the window of the frame.
fn offset(part: &PartLayout, frame: &Frame) -> [i64; 2] {
    let corner = [frame.window.x0, frame.window.y0];
    [0, 1].map(|i| i64::from(part.data.min[i]) - i64::from(part.display.min[i]) - i64::from(corner[i]))
}

/// Gives every block of full resolution to `place`.
fn read_pixels(
    bytes: &[u8],
    parts: &[PartLayout],
    mut place: impl FnMut(&UncompressedBlock, &ChannelList),
) -> Result<(), Refusal> {
    /// Blocks that are decompressed together: work for many threads, memory for few.
    const BATCH: usize = 64;
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(explain)?;
    // The limits were checked on our own reading of the header.
    if reader.headers().len() != parts.len() || !reader.headers().iter().zip(parts).all(agree) {
        return Err("has a contradictory header".into());
    }
    let full_resolution = Vec2(0, 0);
    let mut chunks =
        reader.filter_chunks(false, |_, tile, _| tile.level_index == full_resolution).map_err(explain)?;
    let meta = chunks.meta_data().clone();
    let mut seen = BTreeSet::new();
    loop {
        let batch = chunks.by_ref().take(BATCH).collect::<Result<Vec<_>, _>>().map_err(explain)?;
        if batch.is_empty() {
            return Ok(());
        }
        for block in map_in_order(&batch, 0, |chunk| decompress(chunk, &meta)) {
            let block = block?;
            let Vec2(x, y) = block.index.pixel_position;
            if !seen.insert((block.index.layer, x, y)) {
                return Err("has the same block twice".into());
            }
            place(&block, &meta.headers[block.index.layer].channels);
        }
    }
}

/// Whether the decoder has read the same size and channels from a header as we have.
fn agree((theirs, ours): (&Header, &PartLayout)) -> bool {
    let name = |c: &ChannelDescription| String::from_utf8_lossy(c.name.bytes()).into_owned();
    let names = theirs.channels.list.iter().map(name);
    ours.data.size() == [theirs.layer_size.0 as u64, theirs.layer_size.1 as u64]
        && names.eq(ours.channels.iter().map(|c| c.name.clone()))
}

fn explain(error: exr::error::Error) -> Refusal {
    match error {
        exr::error::Error::NotSupported(what) => {
            Refusal::Variant(format!("is in a variant that is not read: {what}"))
        }
        error => Refusal::Damaged(format!("is damaged: {error}")),
    }
}

fn decompress(chunk: &Chunk, meta: &MetaData) -> Result<UncompressedBlock, Refusal> {
    let header = meta.headers.get(chunk.layer_index).ok_or("has a block of a missing part")?;
    if !is_inside(chunk, header) {
        return Err("has a block outside its picture".into());
    }
    UncompressedBlock::decompress_chunk(chunk.clone(), meta, false).map_err(explain)
}

/// Whether a tile exists in the full resolution; the decoder would panic on wild numbers. (It checks scan lines itself.)
fn is_inside(chunk: &Chunk, header: &Header) -> bool {
    match (&chunk.compressed_block, header.blocks) {
        (CompressedBlock::Tile(block), BlockDescription::Tiles(tiles)) => {
            let Vec2(columns, rows) = Vec2(
                compute_block_count(header.layer_size.0, tiles.tile_size.0),
                compute_block_count(header.layer_size.1, tiles.tile_size.1),
            );
            let at = block.coordinates;
            at.level_index == Vec2(0, 0) && at.tile_index.0 < columns && at.tile_index.1 < rows
        }
        (CompressedBlock::ScanLine(_), BlockDescription::ScanLines) => true,
        _ => false,
    }
}

/// Copies what the frame wants of a block.
fn place(
    block: &UncompressedBlock,
    channels: &ChannelList,
    plan: &[Planned],
    offset: [i64; 2],
    frame: &mut Frame,
) {
    let [width, height] = [frame.window.width(), frame.window.height()].map(i64::from);
    for line in block.lines(channels) {
        let planned = &plan[line.location.channel];
        let Vec2(x, y) = line.location.position;
        let (left, row) = (x as i64 + offset[0], y as i64 + offset[1]);
        let Some(slot) = planned.slot.filter(|_| (0..height).contains(&row)) else { continue };
        let values = &mut frame.channels[slot].values[(row * width) as usize..][..width as usize];
        // Samples left of the window are skipped, those right of it end the zip.
        let skipped = (-left).max(0) as usize;
        let out = &mut values[left.clamp(0, width) as usize..];
        match planned.kind {
            SampleKind::Half => copy(line.value, skipped, out, |b| f16::from_ne_bytes(b).to_f32()),
            SampleKind::Float => copy(line.value, skipped, out, f32::from_ne_bytes),
            SampleKind::Uint => copy(line.value, skipped, out, |b| u32::from_ne_bytes(b) as f32),
        }
    }
}

fn copy<const N: usize>(bytes: &[u8], skipped: usize, out: &mut [f32], value: impl Fn([u8; N]) -> f32) {
    let (samples, _) = bytes.as_chunks::<N>();
    for (out, sample) in out.iter_mut().zip(samples.iter().skip(skipped)) {
        *out = value(*sample);
    }
}
