//! Images in: every depth and channel count kept, hostile and foreign files refused with a reason.

use glam::Vec4;
use heliostat_io::exr_file::{ExrOptions, encode_exr};
use heliostat_io::image_file::{Limits, decode_image, read_frame, read_image};
use heliostat_scene::frame::{Channel, Depth, Frame};
use heliostat_scene::image::{Encoding, Image, Samples};
use heliostat_scene::settings::PixelRect;
use image::codecs::hdr::HdrEncoder;
use image::codecs::jpeg::JpegEncoder;
use png::{BitDepth, ColorType};
use std::collections::BTreeMap;
use std::path::Path;

fn read(bytes: &[u8]) -> Result<Image, String> {
    decode_image(Path::new("picture"), bytes, &Limits::default()).map_err(|e| e.to_string())
}

/// A PNG of 2 by 2 pixels.
fn png(color: ColorType, depth: BitDepth, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == ColorType::Indexed {
        encoder.set_palette(vec![255, 0, 0, 0, 255, 0, 0, 0, 255]);
        encoder.set_trns(vec![255, 128]);
    }
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(data).expect("four pixels");
    writer.finish().expect("memory");
    bytes
}

fn jpeg() -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixels: Vec<u8> = (0..64 * 48).flat_map(|i| [(i % 64 * 4) as u8, 128, (i / 64 * 5) as u8]).collect();
    let encoder = JpegEncoder::new_with_quality(&mut bytes, 95);
    image::ImageEncoder::write_image(encoder, &pixels, 64, 48, image::ExtendedColorType::Rgb8)
        .expect("memory");
    bytes
}

fn hdr() -> Vec<u8> {
    let mut bytes = Vec::new();
    // Values that the format holds exactly, in lines long enough for its compression.
    let pixels: Vec<_> = (0..32 * 8).map(|i| image::Rgb([0.5 + (i % 32) as f32 / 8.0, 0.25, 16.0])).collect();
    HdrEncoder::new(&mut bytes).encode(&pixels, 32, 8).expect("memory");
    bytes
}

fn exr(names: &[&str], size: [u32; 2], window: PixelRect, value: impl Fn(usize, usize) -> f32) -> Vec<u8> {
    let pixels = (window.width() * window.height()) as usize;
    let channel = |(i, name): (usize, &&str)| Channel {
        name: (*name).to_owned(),
        depth: Depth::Float,
        values: (0..pixels).map(|p| value(i, p)).collect(),
    };
    let channels = names.iter().enumerate().map(channel).collect();
    let frame = Frame { width: size[0], height: size[1], window, channels, meta: BTreeMap::new() };
    encode_exr(&frame, &ExrOptions::default()).expect("a sound frame").0
}

const WHOLE: PixelRect = PixelRect { x0: 0, y0: 0, x1: 2, y1: 1 };

#[test]
fn png_keeps_depth_and_channels() {
    let eight = |n: u8| (0..4 * n).map(|i| i * 10).collect::<Vec<_>>();
    let sixteen = |n: u16| (0..4 * n).map(|i| i * 1001).collect::<Vec<_>>();
    let big_endian = |v: &[u16]| v.iter().flat_map(|v| v.to_be_bytes()).collect::<Vec<_>>();
    let kinds = [
        (ColorType::Grayscale, 1),
        (ColorType::GrayscaleAlpha, 2),
        (ColorType::Rgb, 3),
        (ColorType::Rgba, 4),
    ];
    for (color, channels) in kinds {
        let image = read(&png(color, BitDepth::Eight, &eight(channels))).unwrap();
        assert_eq!((image.channels, image.encoding), (channels, Encoding::Srgb));
        assert_eq!(image.samples, Samples::U8(eight(channels)));
        let samples = sixteen(channels.into());
        let image = read(&png(color, BitDepth::Sixteen, &big_endian(&samples))).unwrap();
        assert_eq!((image.channels, image.samples), (channels, Samples::U16(samples)));
    }
}

#[test]
fn png_palettes_and_few_bits_are_spread() {
    let image = read(&png(ColorType::Indexed, BitDepth::Eight, &[0, 1, 2, 0])).unwrap();
    let pixels = vec![255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 255, 255, 0, 0, 255];
    assert_eq!((image.channels, image.samples), (4, Samples::U8(pixels)));
    let image = read(&png(ColorType::Grayscale, BitDepth::One, &[0b1000_0000, 0b0100_0000])).unwrap();
    assert_eq!(image.samples, Samples::U8(vec![255, 0, 0, 255]));
    let image = read(&png(ColorType::Grayscale, BitDepth::Four, &[0x0f, 0x3c])).unwrap();
    assert_eq!(image.samples, Samples::U8(vec![0, 255, 51, 204]));
}

#[test]
fn jpeg_comes_close() {
    let image = read(&jpeg()).unwrap();
    assert_eq!((image.width, image.height, image.channels, image.encoding), (64, 48, 3, Encoding::Srgb));
    let Samples::U8(samples) = &image.samples else { panic!("{:?}", image.samples) };
    for (i, pixel) in samples.chunks(3).enumerate() {
        let expected = [(i % 64 * 4) as u8, 128, (i / 64 * 5) as u8];
        assert!(pixel.iter().zip(expected).all(|(a, b)| a.abs_diff(b) < 20), "{i}: {pixel:?} {expected:?}");
    }
}

#[test]
fn hdr_is_float_and_linear_under_both_signatures() {
    let bytes = hdr();
    let other = [b"#?RGBE".as_slice(), &bytes[b"#?RADIANCE".len()..]].concat();
    for bytes in [bytes, other] {
        let image = read(&bytes).unwrap();
        assert_eq!((image.width, image.height, image.channels, image.encoding), (32, 8, 3, Encoding::Linear));
        assert_eq!(image.pixel(5, 7), Vec4::new(1.125, 0.25, 16.0, 1.0));
    }
}

#[test]
fn exr_is_straight_finite_and_covers_the_display_window() {
    let window = PixelRect { x0: 1, y0: 1, x1: 3, y1: 2 };
    // Half covered, and light without coverage.
    let pixels = [[0.4, 0.2, 0.1, 0.5], [3.0, 0.0, 0.0, 0.0]];
    let image = read(&exr(&["R", "G", "B", "A"], [4, 3], window, |c, p| pixels[p][c])).unwrap();
    assert_eq!((image.width, image.height, image.channels, image.encoding), (4, 3, 4, Encoding::Linear));
    assert_eq!(image.pixel(1, 1), Vec4::new(0.8, 0.4, 0.2, 0.5));
    assert_eq!(image.pixel(2, 1), Vec4::new(3.0, 0.0, 0.0, 0.0));
    assert_eq!(image.pixel(0, 0), Vec4::ZERO);
}

#[test]
fn exr_layers_are_chosen_sensibly() {
    let red = |names: &[&str], bright: &str| {
        let image = read(&exr(names, [2, 1], WHOLE, |c, _| if names[c] == bright { 1.0 } else { 0.0 }));
        image.unwrap().pixel(0, 0)
    };
    assert_eq!(red(&["B", "G", "R", "a.B", "a.G", "a.R"], "R"), Vec4::new(1.0, 0.0, 0.0, 1.0));
    assert_eq!(red(&["ViewLayer.B", "ViewLayer.G", "ViewLayer.R", "Z"], "ViewLayer.R").x, 1.0);
    assert_eq!(red(&["Y"], "Y"), Vec4::ONE);
    assert_eq!(red(&["height"], "height"), Vec4::ONE);
    assert_eq!(red(&["A", "Y"], "A"), Vec4::new(0.0, 0.0, 0.0, 1.0));
}

#[test]
fn sizes_are_checked_before_anything_is_allocated() {
    // Headers that claim 60,000 by 60,000 pixels with nothing behind them.
    let mut big_png = png(ColorType::Rgb, BitDepth::Eight, &[0; 12]);
    big_png[16..24].copy_from_slice(&[0, 0, 0xea, 0x60, 0, 0, 0xea, 0x60]);
    let big_hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n".to_vec();
    let mut big_exr = exr(&["B", "G", "R"], [2, 1], WHOLE, |_, _| 0.0);
    for name in [b"dataWindow\0box2i\0".as_slice(), b"displayWindow\0box2i\0"] {
        let at = big_exr.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 4;
        big_exr[at + 8..at + 16].copy_from_slice(&[0x5f, 0xea, 0, 0, 0x5f, 0xea, 0, 0]);
    }
    for (bytes, is_checksummed) in [(big_png, true), (big_hdr, false), (big_exr, false)] {
        let error = read(&bytes).unwrap_err();
        assert!(is_checksummed || error.contains("60000 x 60000 pixels"), "{error}");
    }
    let small = Limits { side: 63, bytes: 1 << 20 };
    let error = decode_image(Path::new("a.jpg"), &jpeg(), &small).unwrap_err().to_string();
    assert!(error.contains("64 x 48 pixels are more than 63 on a side"), "{error}");
    let few = Limits { side: 64, bytes: 1000 };
    let error = decode_image(Path::new("a.jpg"), &jpeg(), &few).unwrap_err().to_string();
    assert!(error.contains("limit of 1000 bytes"), "{error}");
}

#[test]
fn foreign_files_are_named() {
    let cases: [(&[u8], &str); 6] = [
        (b"", "is empty"),
        (b"GIF89a....", "is a GIF image"),
        (b"version https://git-lfs.github.com/spec/v1\n", "Git LFS"),
        (b"v 0 0 0\n", "no image in a known format"),
        (b"\x89PNG\r\n\x1a\n", "is damaged"),
        (b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n0000", "not read"),
    ];
    for (bytes, expected) in cases {
        let error = read(bytes).unwrap_err();
        assert!(
            error.starts_with("picture: ") && error.contains(expected) && error.contains("; "),
            "{error}"
        );
    }
    let folder = tempfile::tempdir().unwrap();
    assert!(read_image(folder.path(), &Limits::default()).is_err());
    let error = read_image(&folder.path().join("wood.png"), &Limits::default()).unwrap_err().to_string();
    assert!(error.contains("wood.png: file not found"), "{error}");
}

#[test]
fn damage_never_panics_and_cuts_are_noticed() {
    let limits = Limits { side: 4096, bytes: 1 << 22 };
    let rgba: Vec<u8> = (0..16).collect();
    let files = [
        png(ColorType::Rgba, BitDepth::Eight, &rgba),
        png(ColorType::Indexed, BitDepth::Eight, &[0, 1, 2, 9]),
        jpeg(),
        hdr(),
        exr(&["B", "G", "R"], [40, 30], PixelRect { x0: 3, y0: 2, x1: 37, y1: 28 }, |c, p| (c + p) as f32),
    ];
    for file in &files {
        for cut in 0..file.len() - 12 {
            let part = decode_image(Path::new("a"), &file[..cut], &limits);
            assert!(part.is_err(), "{cut} of {} bytes pass", file.len());
        }
        for i in 0..file.len() {
            for bits in [0x01, 0x80, 0xff] {
                let mut damaged = file.clone();
                damaged[i] ^= bits;
                if let Ok(image) = decode_image(Path::new("a"), &damaged, &limits) {
                    assert!(image.bytes() as u64 <= limits.bytes && image.width > 0 && image.height > 0);
                }
            }
        }
    }
}

#[test]
fn every_format_reads_as_a_frame() {
    let folder = tempfile::tempdir().unwrap();
    let grey_alpha = png(ColorType::GrayscaleAlpha, BitDepth::Eight, &[255, 255, 255, 51, 0, 255, 0, 0]);
    let path = folder.path().join("no-ending");
    std::fs::write(&path, grey_alpha).unwrap();
    let frame = read_frame(&path, &Limits::default()).unwrap();
    let values = |name: &str| frame.channel(name).expect("a channel").values.clone();
    // White at alpha 0.2 is 0.2 premultiplied.
    assert_eq!(values("R"), [1.0, 0.2, 0.0, 0.0]);
    assert_eq!(values("A"), [1.0, 0.2, 1.0, 0.0]);
    std::fs::write(&path, exr(&["Z", "R"], [2, 1], WHOLE, |c, _| c as f32)).unwrap();
    let frame = read_frame(&path, &Limits::default()).unwrap();
    assert_eq!(frame.channel("Z").unwrap().values, [0.0, 0.0]);
}
