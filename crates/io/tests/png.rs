//! PNG out: colours, alpha, depth, and the same bytes every time; read back by another decoder.

use glam::Vec4;
use heliostat_io::image_file::{Limits, decode_image, read_frame};
use heliostat_io::png_file::{PngBits, PngOptions, encode_png, write_png};
use heliostat_io::{View, ViewTransform};
use heliostat_scene::color::{linear_to_srgb, srgb_to_linear};
use heliostat_scene::frame::{Channel, Depth, Frame};
use heliostat_scene::image::{Encoding, Image, Samples};
use heliostat_scene::settings::PixelRect;
use std::collections::BTreeMap;
use std::path::Path;

/// A frame of these pixels in a window at `x0`, `y0` of a picture of that size.
fn frame([width, height]: [u32; 2], [x0, y0]: [u32; 2], columns: u32, pixels: &[Vec4]) -> Frame {
    let window = PixelRect { x0, y0, x1: x0 + columns, y1: y0 + pixels.len() as u32 / columns };
    let channel = |(i, name): (usize, &str)| Channel {
        name: name.to_owned(),
        depth: Depth::Half,
        values: pixels.iter().map(|p| p[i]).collect(),
    };
    let channels = ["R", "G", "B", "A"].into_iter().enumerate().map(channel).collect();
    Frame { width, height, window, channels, meta: BTreeMap::new() }
}

fn encode(frame: &Frame, options: &PngOptions) -> Image {
    let bytes = encode_png(frame, options).expect("a frame");
    assert_eq!(bytes, encode_png(frame, options).expect("a frame"), "not reproducible");
    decode_image(Path::new("test.png"), &bytes, &Limits::default()).expect("our own picture")
}

fn bytes(image: &Image) -> &[u8] {
    match &image.samples {
        Samples::U8(bytes) => bytes,
        other => panic!("{other:?}"),
    }
}

#[test]
fn opaque_pictures_have_three_channels_and_srgb_values() {
    let pixels: Vec<_> = (0..=255).map(|i| srgb_to_linear(i as f32 / 255.0)).collect();
    let pixels: Vec<_> = pixels.iter().map(|&v| Vec4::new(v, 1.0 - v, 0.0, 1.0)).collect();
    let image = encode(&frame([16, 16], [0, 0], 16, &pixels), &PngOptions::default());
    assert_eq!((image.width, image.height, image.channels, image.encoding), (16, 16, 3, Encoding::Srgb));
    for (i, pixel) in bytes(&image).chunks(3).enumerate() {
        let complement = linear_to_srgb(1.0 - srgb_to_linear(i as f32 / 255.0)) * 255.0;
        assert_eq!(usize::from(pixel[0]), i);
        assert!((f32::from(pixel[1]) - complement).abs() <= 0.501 && pixel[2] == 0);
    }
}

#[test]
fn sixteen_bits_keep_sixteen_bits() {
    let pixels: Vec<_> = (0..4096).map(|i| Vec4::new(i as f32 / 4096.0, 0.18, 7.0, 1.0)).collect();
    let options = PngOptions { bits: PngBits::Sixteen, ..PngOptions::default() };
    let image = encode(&frame([64, 64], [0, 0], 64, &pixels), &options);
    let Samples::U16(values) = &image.samples else { panic!("{:?}", image.samples) };
    for (pixel, light) in values.chunks(3).zip(&pixels) {
        assert!((f32::from(pixel[0]) - linear_to_srgb(light.x) * 65535.0).abs() <= 0.51);
        assert_eq!(pixel[2], 65535);
    }
}

#[test]
fn alpha_is_straight_and_edges_keep_their_colour() {
    // The same orange at four coverages.
    let orange = Vec4::new(0.8, 0.3, 0.05, 1.0);
    let pixels = [1.0, 0.5, 0.25, 0.0].map(|a| orange * a);
    let image = encode(&frame([2, 2], [0, 0], 2, &pixels), &PngOptions::default());
    assert_eq!(image.channels, 4);
    let rows: Vec<_> = bytes(&image).chunks(4).collect();
    assert_eq!([rows[0][3], rows[1][3], rows[2][3], rows[3][3]], [255, 128, 64, 0]);
    assert_eq!(rows[0][..3], rows[1][..3]);
    assert_eq!(rows[0][..3], rows[2][..3]);
    assert_eq!(rows[3], [0, 0, 0, 0]);
}

#[test]
fn light_without_coverage_and_wild_values_do_not_explode() {
    let pixels = [
        Vec4::new(0.5, 0.25, 0.0, 0.0),
        Vec4::new(1e-3, 0.0, 0.0, 1e-30),
        Vec4::new(-0.2, 1.3, f32::NAN, 1.01),
        Vec4::new(f32::INFINITY, 0.0, 1e30, -0.1),
    ];
    for transform in ViewTransform::ALL {
        let options = PngOptions { view: View { transform, exposure: 0.0 }, ..PngOptions::default() };
        let image = encode(&frame([2, 2], [0, 0], 2, &pixels), &options);
        let rows: Vec<_> = bytes(&image).chunks(4).map(<[u8]>::to_vec).collect();
        assert_eq!([rows[0][3], rows[1][3], rows[2][3], rows[3][3]], [0, 0, 255, 0]);
    }
    let image = encode(&frame([2, 2], [0, 0], 2, &pixels), &PngOptions::default());
    // sRGB of 0.5 is 187.5, of 0.25 is 136.96.
    assert_eq!(bytes(&image)[..4], [188, 137, 0, 0]);
    assert_eq!(bytes(&image)[8..12], [0, 255, 0, 255]);
}

#[test]
fn a_region_lies_at_its_place_in_the_whole_picture() {
    let white = [Vec4::ONE; 6];
    let image = encode(&frame([7, 5], [2, 1], 3, &white), &PngOptions::default());
    assert_eq!((image.width, image.height), (7, 5));
    for y in 0..5 {
        for x in 0..7 {
            let inside = (2..5).contains(&x) && (1..3).contains(&y);
            assert_eq!(image.pixel(x, y), if inside { Vec4::ONE } else { Vec4::ZERO }, "{x} {y}");
        }
    }
}

#[test]
fn a_layer_is_shown_by_name_or_missed_by_name() {
    let mut frame = frame([1, 1], [0, 0], 1, &[Vec4::new(0.0, 0.0, 0.0, 1.0)]);
    let depth = Channel { name: "Z".to_owned(), depth: Depth::Float, values: vec![1.0] };
    let normal =
        ["N.X", "N.Y", "N.Z"].map(|n| Channel { name: n.to_owned(), values: vec![1.0], ..depth.clone() });
    frame.channels.push(depth);
    frame.channels.extend(normal);
    for layer in ["Z", "N"] {
        let options = PngOptions { layer: Some(layer.to_owned()), ..PngOptions::default() };
        assert_eq!(bytes(&encode(&frame, &options)), [255; 3], "{layer}");
    }
    assert_eq!(bytes(&encode(&frame, &PngOptions::default())), [0; 3]);
    let options = PngOptions { layer: Some("albedo".to_owned()), ..PngOptions::default() };
    let error = encode_png(&frame, &options).unwrap_err();
    assert!(error.contains("`albedo`") && error.contains("N.X"), "{error}");
}

#[test]
fn the_file_says_srgb_and_reads_back_as_a_frame() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let pixels = [Vec4::new(0.5, 0.1, 0.02, 0.5), Vec4::new(1.0, 0.5, 0.0, 1.0)];
    write_png(&path, &frame([2, 1], [0, 0], 2, &pixels), &PngOptions::default()).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    assert!(bytes.windows(5).any(|w| w == b"sRGB\0"));
    let back = read_frame(&path, &Limits::default()).unwrap();
    for (channel, i) in back.channels.iter().zip(0..) {
        for (value, pixel) in channel.values.iter().zip(pixels) {
            assert!((value - pixel[i]).abs() < 0.006, "{}: {value} {}", channel.name, pixel[i]);
        }
    }
}
