//! OpenEXR out: reproducible bytes, header entries, values that the file cannot hold.

use heliostat_io::exr_file::{Compression, ExrOptions, SaveReport, decode_exr, encode_exr, write_exr};
use heliostat_io::image_file::Limits;
use heliostat_scene::frame::{Channel, Depth, Frame, Meta};
use heliostat_scene::settings::PixelRect;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

fn channel(name: &str, depth: Depth, values: Vec<f32>) -> Channel {
    Channel { name: name.to_owned(), depth, values }
}

/// A region of 37 by 50 pixels of a picture of 100 by 80, with 6 channels and 14 entries.
fn frame() -> Frame {
    let window = PixelRect { x0: 11, y0: 20, x1: 48, y1: 70 };
    let ramp = |k: f32| (0..37 * 50).map(|i| (i as f32 * k).sin().abs()).collect::<Vec<_>>();
    let mut meta = BTreeMap::from([
        ("comments".to_owned(), Meta::Text("Straße".to_owned())),
        ("owner".to_owned(), Meta::Text(String::new())),
        ("framesPerSecond".to_owned(), Meta::Rational(24000, 1001)),
        ("worldToCamera".to_owned(), Meta::Matrix(std::array::from_fn(|i| i as f32 - 7.5))),
        ("screenWindowCenter".to_owned(), Meta::Vec2([0.25, -0.5])),
        ("heliostat/up".to_owned(), Meta::Vec3([0.0, 1.0, 0.0])),
        ("multiView".to_owned(), Meta::Texts(vec!["left".to_owned(), String::new(), "right".to_owned()])),
        (
            "heliostat/other".to_owned(),
            Meta::Other { kind: "v2i".to_owned(), bytes: vec![1, 0, 0, 0, 2, 0, 0, 0] },
        ),
    ]);
    for i in 0..5 {
        meta.insert(format!("heliostat/number{i}"), Meta::Int(i - 2));
    }
    let long = "a name of more than thirty-one bytes needs a flag in the file".to_owned();
    meta.insert(long, Meta::Float(0.1));
    Frame {
        width: 100,
        height: 80,
        window,
        channels: vec![
            channel("R", Depth::Half, ramp(0.1)),
            channel("G", Depth::Half, ramp(0.2)),
            channel("B", Depth::Half, ramp(0.3)),
            channel("A", Depth::Half, ramp(0.0)),
            channel("Z", Depth::Float, ramp(17.0)),
            channel("object_id.Y", Depth::Float, (0..37 * 50).map(|i| (i % 7) as f32).collect()),
        ],
        meta,
    }
}

const ALL: [Compression; 4] = [Compression::None, Compression::Zips, Compression::Zip, Compression::Piz];

fn encode(frame: &Frame, compression: Compression) -> Vec<u8> {
    encode_exr(frame, &ExrOptions { compression, ..ExrOptions::default() }).expect("a sound frame").0
}

fn decode(bytes: &[u8]) -> Frame {
    decode_exr(Path::new("test.exr"), bytes, &Limits::default()).expect("our own file")
}

/// Names of the attributes, in the order of the file.
fn attribute_names(bytes: &[u8]) -> Vec<String> {
    let mut names = Vec::new();
    let mut rest = &bytes[8..];
    let text = |rest: &mut &[u8]| {
        let end = rest.iter().position(|&b| b == 0).expect("an end");
        let text = String::from_utf8_lossy(&rest[..end]).into_owned();
        *rest = &rest[end + 1..];
        text
    };
    loop {
        let name = text(&mut rest);
        if name.is_empty() {
            return names;
        }
        names.push(name);
        let _kind = text(&mut rest);
        let size = u32::from_le_bytes([rest[0], rest[1], rest[2], rest[3]]) as usize;
        rest = &rest[4 + size..];
    }
}

#[test]
fn the_same_frame_gives_the_same_bytes_on_any_threads() {
    let frame = frame();
    for compression in ALL {
        let first = encode(&frame, compression);
        for _ in 0..20 {
            assert!(encode(&frame, compression) == first, "{compression:?} differs from run to run");
        }
        for threads in [1, 2, 3, 64] {
            let bytes = encode_exr(&frame, &ExrOptions { compression, threads }).unwrap().0;
            assert!(bytes == first, "{compression:?} differs with {threads} threads");
        }
    }
}

#[test]
fn attributes_are_sorted_and_complete() {
    let names = attribute_names(&encode(&frame(), Compression::Zip));
    assert!(names.is_sorted(), "{names:?}");
    for name in ["channels", "chromaticities", "dataWindow", "displayWindow", "software", "worldToCamera"] {
        assert!(names.iter().any(|n| n == name), "no {name}");
    }
    assert!(!names.iter().any(|n| n == "capDate"));
}

#[test]
fn what_is_written_comes_back() {
    let frame = frame();
    for compression in ALL {
        let back = decode(&encode(&frame, compression));
        assert_eq!((back.width, back.height, back.window), (frame.width, frame.height, frame.window));
        let mut meta = frame.meta.clone();
        meta.insert("software".to_owned(), back.meta["software"].clone());
        assert_eq!(back.meta, meta);
        assert_eq!(back.channels.len(), frame.channels.len());
        for channel in &frame.channels {
            let got = back.channel(&channel.name).expect("a channel");
            assert_eq!(got.depth, channel.depth);
            for (a, b) in got.values.iter().zip(&channel.values) {
                let stored = if channel.depth == Depth::Half { half::f16::from_f32(*b).to_f32() } else { *b };
                assert_eq!(*a, stored, "{} {compression:?}", channel.name);
            }
        }
    }
}

#[test]
fn written_again_it_is_the_same_file() {
    let first = encode(&frame(), Compression::Zip);
    assert!(encode(&decode(&first), Compression::Zip) == first);
}

#[test]
fn values_beyond_the_type_are_counted() {
    let wild = vec![65504.0, 65520.0, -1e9, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -0.0];
    let window = PixelRect { x0: 0, y0: 0, x1: 8, y1: 1 };
    let channels = vec![channel("R", Depth::Half, wild.clone()), channel("Z", Depth::Float, wild)];
    let frame = Frame { width: 8, height: 1, window, channels, meta: BTreeMap::new() };
    let (bytes, report) = encode_exr(&frame, &ExrOptions::default()).unwrap();
    assert_eq!(report, SaveReport { clamped: 3, replaced: 6 });
    let back = decode(&bytes);
    let max = 65504.0;
    assert_eq!(back.channel("R").unwrap().values, [max, max, -max, 0.0, max, -max, max, -0.0]);
    let z = [65504.0, 65520.0, -1e9, 0.0, f32::MAX, f32::MIN, 1e30, -0.0];
    assert_eq!(back.channel("Z").unwrap().values, z);
}

#[test]
fn contradictions_are_refused_with_the_name_of_the_file() {
    let good = frame();
    type Spoil = fn(&mut Frame);
    let spoils: [(&str, Spoil); 9] = [
        ("two channels R", |f| f.channels[1].name = "R".to_owned()),
        ("does not fill", |f| f.channels[2].values.truncate(3)),
        ("no channels", |f| f.channels.clear()),
        ("no name", |f| f.channels[0].name = String::new()),
        ("no part of a picture", |f| f.window.x1 = 101),
        ("no part of a picture", |f| f.window.x0 = f.window.x1),
        ("reserved", |f| drop(f.meta.insert("dataWindow".to_owned(), Meta::Int(0)))),
        ("too many", |f| f.width = u32::MAX),
        ("no name", |f| {
            let value = Meta::Other { kind: "a\0b".to_owned(), bytes: Vec::new() };
            f.meta.insert("heliostat/x".to_owned(), value);
        }),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for (expected, spoil) in spoils {
        let mut bad = good.clone();
        spoil(&mut bad);
        let error = write_exr(&path, &bad, &ExrOptions::default()).unwrap_err().to_string();
        assert!(error.contains("a.exr: ") && error.contains(expected), "{error}");
        assert!(!path.exists());
    }
}

#[test]
fn one_pixel_and_odd_sizes_work() {
    for (width, height) in [(1, 1), (1, 17), (16, 1), (33, 31)] {
        let window = PixelRect { x0: 0, y0: 0, x1: width, y1: height };
        let values: Vec<_> = (0..width * height).map(|i| i as f32).collect();
        let channels = vec![channel("Y", Depth::Float, values.clone())];
        let frame = Frame { width, height, window, channels, meta: BTreeMap::new() };
        for compression in ALL {
            let back = decode(&encode(&frame, compression));
            assert_eq!(back.channels[0].values, values, "{width} x {height} {compression:?}");
        }
    }
}

/// The reference implementation agrees that the file is sound (where it is installed).
#[test]
#[expect(clippy::print_stderr, reason = "says why nothing was tested")]
fn the_reference_tools_read_it() {
    let folder = tempfile::tempdir().unwrap();
    for compression in ALL {
        let path = folder.path().join(format!("{compression:?}.exr"));
        write_exr(&path, &frame(), &ExrOptions { compression, ..ExrOptions::default() }).unwrap();
        let Ok(output) = Command::new("exrinfo").args(["-s", "-v"]).arg(&path).output() else {
            eprintln!("skipped: exrinfo is not installed");
            return;
        };
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        for expected in ["worldToCamera", "heliostat/number4", "object_id.Y"] {
            assert!(text.contains(expected), "no {expected} in {text}");
        }
    }
}
