//! The pixels of a frame as compressed blocks of scan lines, made by several threads, the same for any number of them.

use super::{Compression, ExrOptions, SaveReport, zip};
use crate::parallel::map_in_order;
use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock};
use exr::block::{BlockIndex, UncompressedBlock, enumerate_ordered_header_block_indices};
use exr::error::Result;
use exr::math::Vec2;
use exr::meta::BlockDescription;
use exr::meta::attribute::{ChannelDescription, IntegerBounds, LineOrder, SampleType, Text};
use exr::meta::header::{Header, LayerAttributes};
use half::f16;
use heliostat_scene::frame::{Channel, Depth, Frame};
use std::ops::{AddAssign, Range};

impl AddAssign for SaveReport {
    fn add_assign(&mut self, other: Self) {
        self.clamped += other.clamped;
        self.replaced += other.replaced;
    }
}

/// The header that describes the pixels, the blocks from top to bottom, and what had to be changed.
pub(super) fn compress(frame: &Frame, options: &ExrOptions) -> Result<(Header, Vec<Chunk>, SaveReport)> {
    // The order of the file is that of the names.
    let mut channels: Vec<_> = frame.channels.iter().collect();
    channels.sort_by(|a, b| a.name.as_bytes().cmp(b.name.as_bytes()));
    let header = header(frame, &channels, options.compression);
    let blocks: Vec<_> = enumerate_ordered_header_block_indices(std::slice::from_ref(&header))
        .map(|(_, block)| block)
        .collect();
    let one = |block: &BlockIndex| compress_block(frame, &channels, &header, options.compression, *block);
    let done = map_in_order(&blocks, options.threads, one);
    let mut report = SaveReport::default();
    let mut chunks = Vec::with_capacity(blocks.len());
    for block in done {
        let (chunk, changed) = block?;
        chunks.push(chunk);
        report += changed;
    }
    Ok((header, chunks, report))
}

fn header(frame: &Frame, channels: &[&Channel], compression: Compression) -> Header {
    let window = frame.window;
    let describe = |channel: &&Channel| ChannelDescription {
        name: Text::from_slice_unchecked(channel.name.as_bytes()),
        sample_type: match channel.depth {
            Depth::Half => SampleType::F16,
            Depth::Float => SampleType::F32,
        },
        quantize_linearly: false,
        sampling: Vec2(1, 1),
    };
    let compression = match compression {
        Compression::None => exr::compression::Compression::Uncompressed,
        Compression::Zips => exr::compression::Compression::ZIP1,
        Compression::Zip => exr::compression::Compression::ZIP16,
        Compression::Piz => exr::compression::Compression::PIZ,
    };
    let size = Vec2(window.width() as usize, window.height() as usize);
    let attributes = LayerAttributes {
        layer_position: Vec2(window.x0.cast_signed(), window.y0.cast_signed()),
        ..LayerAttributes::default()
    };
    let display = IntegerBounds::new(Vec2(0, 0), Vec2(frame.width as usize, frame.height as usize));
    Header::new(Text::default(), size, channels.iter().map(describe).collect())
        .with_encoding(compression, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_attributes(attributes)
        .with_display_window(display)
}

fn compress_block(
    frame: &Frame,
    channels: &[&Channel],
    header: &Header,
    compression: Compression,
    block: BlockIndex,
) -> Result<(Chunk, SaveReport)> {
    let mut report = SaveReport::default();
    let first = block.pixel_position.1;
    let rows = first..first + block.pixel_size.1;
    if compression == Compression::Piz {
        let data = samples(frame, channels, rows, f16::to_ne_bytes, f32::to_ne_bytes, &mut report);
        let block = UncompressedBlock { index: block, data };
        return Ok((block.compress_to_chunk(std::slice::from_ref(header))?, report));
    }
    let raw = samples(frame, channels, rows, f16::to_le_bytes, f32::to_le_bytes, &mut report);
    let pixels = if compression == Compression::None { raw } else { zip::compress(raw) };
    let y_coordinate = (frame.window.y0 + first as u32).cast_signed();
    let lines = CompressedScanLineBlock { y_coordinate, compressed_pixels_le: pixels };
    Ok((Chunk { layer_index: 0, compressed_block: CompressedBlock::ScanLine(lines) }, report))
}

/// The samples of some rows: row by row, in a row channel by channel.
fn samples(
    frame: &Frame,
    channels: &[&Channel],
    rows: Range<usize>,
    half: impl Fn(f16) -> [u8; 2],
    float: impl Fn(f32) -> [u8; 4],
    report: &mut SaveReport,
) -> Vec<u8> {
    let width = frame.window.width() as usize;
    let mut bytes = Vec::with_capacity(rows.len() * width * 4 * channels.len());
    for row in rows {
        for channel in channels {
            let values = channel.values[row * width..][..width].iter();
            match channel.depth {
                Depth::Half => {
                    let largest = f16::MAX.to_f32();
                    bytes.extend(values.flat_map(|v| half(f16::from_f32(finite(*v, largest, report)))));
                }
                Depth::Float => bytes.extend(values.flat_map(|v| float(finite(*v, f32::MAX, report)))),
            }
        }
    }
    bytes
}

/// The value that stands for `v` in a file where `largest` is the largest value.
fn finite(v: f32, largest: f32, report: &mut SaveReport) -> f32 {
    if v.abs() <= largest {
        return v;
    }
    *(if v.is_finite() { &mut report.clamped } else { &mut report.replaced }) += 1;
    if v.is_nan() { 0.0 } else { largest.copysign(v) }
}
