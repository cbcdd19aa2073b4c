//! Images of other programs, where they are at hand: read right, or refused with a reason.

#![expect(clippy::print_stderr, reason = "says why nothing was tested")]

use heliostat_io::exr_file::read_exr;
use heliostat_io::image_file::{Limits, decode_image, read_frame, read_image};
use heliostat_io::picture::Picture;
use heliostat_scene::frame::{Frame, Meta};
use std::path::{Path, PathBuf};

/// A folder of real files, or nothing.
fn assets(folder: &str) -> Option<PathBuf> {
    let default = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets");
    let root = std::env::var_os("HELIOSTAT_ASSETS").map_or(default, PathBuf::from);
    let folder = root.join(folder);
    if !folder.is_dir() {
        eprintln!("skipped: there is no folder {}", folder.display());
        return None;
    }
    Some(folder)
}

fn files(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, ending, found);
        } else if path.extension().is_some_and(|e| e == ending) {
            found.push(path);
        }
    }
}

fn exr_frame(path: &Path) -> Frame {
    read_exr(path, &Limits::default()).unwrap_or_else(|e| panic!("{e}"))
}

fn picture(path: &Path) -> Picture {
    Picture::of(&read_frame(path, &Limits::default()).unwrap_or_else(|e| panic!("{e}"))).expect("channels")
}

#[test]
fn every_exr_is_read_or_refused_with_a_reason() {
    let Some(folder) = assets("exr") else { return };
    let mut found = Vec::new();
    files(&folder, "exr", &mut found);
    let refused: Vec<_> =
        found.iter().filter_map(|p| read_image(p, &Limits::default()).err()).map(|e| e.to_string()).collect();
    for error in &refused {
        assert!(error.contains("subsampled channel") || error.contains("deep data"), "{error}");
    }
    assert!(found.len() - refused.len() >= 20, "{refused:#?}");
}

/// The pictures beside the files show them in sRGB: on the whole they agree.
#[test]
fn exr_looks_as_the_picture_beside_it() {
    let Some(folder) = assets("exr/openexr-images") else { return };
    for name in ["Chromaticities/Rec709", "ScanLines/Cannon", "LuminanceChroma/Garden"] {
        let [light, shown] = ["exr", "jpg"].map(|e| picture(&folder.join(name).with_extension(e)));
        assert_eq!((light.width, light.height), (shown.width, shown.height), "{name}");
        let [mut distance, mut sum] = [0.0_f32; 2];
        for (a, b) in light.pixels.iter().zip(&shown.pixels) {
            distance += (a.y.clamp(0.0, 1.0) - b.y).abs();
            sum += b.y;
        }
        assert!(distance < 0.03 * sum, "{name}: {}", distance / sum);
    }
}

#[test]
fn other_primaries_become_rec709() {
    let Some(folder) = assets("exr/openexr-images/Chromaticities") else { return };
    let [rec709, xyz] = ["Rec709.exr", "XYZ.exr"].map(|n| picture(&folder.join(n)));
    for (a, b) in rec709.pixels.iter().zip(&xyz.pixels) {
        // Both were rounded to halves, once before and once after the conversion.
        let bound = 0.004 * (1.0 + a.abs().max_element());
        assert!((*a - *b).abs().max_element() < bound, "{a} {b}");
    }
}

#[test]
fn parts_become_channels_of_one_frame() {
    let Some(folder) = assets("exr/openexr-images/Beachball") else { return };
    let [single, multi] = ["singlepart.0001.exr", "multipart.0001.exr"].map(|n| exr_frame(&folder.join(n)));
    assert_eq!((single.width, single.height, single.window), (multi.width, multi.height, multi.window));
    for name in ["R", "A", "left.G", "Z", "left.Z"] {
        let [a, b] = [&single, &multi].map(|f| &f.channel(name).expect(name).values);
        assert!(a == b, "{name} differs");
    }
    assert_eq!(single.meta["multiView"], Meta::Texts(vec!["right".to_owned(), "left".to_owned()]));
}

#[test]
fn windows_lie_where_they_should() {
    let Some(folder) = assets("exr") else { return };
    let window = |name: &str| {
        let frame = exr_frame(&folder.join(name));
        let w = frame.window;
        ([frame.width, frame.height], [w.x0, w.y0, w.x1, w.y1])
    };
    // From `exrinfo`: display windows (0 0)-(500 400) with data (30 40)-(429 339); (0 0)-(399 99) beside the data.
    assert_eq!(window("openexr-images/DisplayWindow/t08.exr"), ([501, 401], [30, 40, 430, 340]));
    assert_eq!(window("openexr-images/DisplayWindow/t12.exr"), ([400, 100], [0, 0, 0, 0]));
    let cropped = folder.join("image-rs/cropping - data window differs display window.exr");
    let whole = folder.join("image-rs/cropping - uncropped original.exr");
    let w = exr_frame(&cropped).window;
    let [cropped, whole] = [cropped, whole].map(|p| picture(&p));
    for (i, (a, b)) in cropped.pixels.iter().zip(&whole.pixels).enumerate() {
        let [x, y] = [i as u32 % cropped.width, i as u32 / cropped.width];
        if (w.x0..w.x1).contains(&x) && (w.y0..w.y1).contains(&y) {
            assert_eq!(a, b, "{x} {y}");
        }
    }
}

#[test]
fn every_half_is_read_exactly_and_never_reaches_a_texture() {
    let Some(folder) = assets("exr/openexr-images/TestImages") else { return };
    let path = folder.join("AllHalfValues.exr");
    let frame = exr_frame(&path);
    // 256 by 256 pixels, each of the 65,536 bit patterns once.
    let mut seen: Vec<u16> =
        frame.channels[0].values.iter().map(|v| half::f16::from_f32(*v).to_bits()).collect();
    seen.sort_unstable();
    seen.dedup();
    // Signalling NaNs become quiet ones on the way.
    assert!(seen.len() > 65_536 - 1024 - 1024, "{}", seen.len());
    for name in ["AllHalfValues.exr", "BrightRingsNanInf.exr"] {
        let image = read_image(&folder.join(name), &Limits::default()).unwrap();
        let finite = |i: u32| image.pixel(i % image.width, i / image.width).is_finite();
        assert!((0..image.width * image.height).all(finite), "{name}");
    }
}

/// Tiles, mip maps, RLE, PIZ, B44, parts: flipped bytes and cuts give errors or pictures, never more.
#[test]
fn damaged_files_do_no_harm() {
    let Some(folder) = assets("exr") else { return };
    let limits = Limits { side: 4096, bytes: 1 << 26 };
    let mut found = Vec::new();
    files(&folder, "exr", &mut found);
    let mut state = 7_u64;
    let mut random = move |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    for path in found {
        let file = std::fs::read(&path).unwrap();
        if file.len() > 100_000 {
            continue;
        }
        for round in 0..20 {
            let mut damaged = file.clone();
            let reach = if round % 2 == 0 { file.len().min(800) } else { file.len() };
            for _ in 0..1 + round % 3 {
                damaged[random(reach)] ^= 1 << random(8);
            }
            if round % 5 == 0 {
                damaged.truncate(random(file.len()));
            }
            if let Ok(image) = decode_image(&path, &damaged, &limits) {
                assert!(image.bytes() as u64 <= limits.bytes);
            }
        }
    }
}

#[test]
fn environments_are_read() {
    let Some(folder) = assets("env") else { return };
    for name in ["chinese_garden_1k.hdr", "qwantani_afternoon_puresky_1k.hdr", "OrientationLatLong.exr"] {
        let image = read_image(&folder.join(name), &Limits::default()).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!((image.width, image.height), (1024, 512), "{name}");
    }
}
